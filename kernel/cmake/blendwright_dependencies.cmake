# Every outside library, and what it is for. All come from Debian packages.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)      # linear algebra; the only public dependency
find_package(TBB REQUIRED)                       # threads
find_package(hwy REQUIRED)                       # SIMD with run-time dispatch (grid evaluation)
find_package(Boost 1.74 REQUIRED)                # R-tree of boxes (many bodies); headers only
find_package(Ceres REQUIRED)                     # least squares (correspondence, fits)
find_package(nlohmann_json 3.11 REQUIRED)        # job files and reports
find_package(CLI11 REQUIRED)                     # the command line
find_package(OpenCASCADE REQUIRED)               # B-rep and STEP
find_package(VTK REQUIRED COMPONENTS             # mesh files and pictures; each further component may want more packages
  CommonCore CommonDataModel CommonExecutionModel FiltersCore IOXML IOImage
  RenderingCore RenderingOpenGL2 RenderingFreeType
  RenderingUI FiltersGeometry)                   # the viewer's window only
if(BLENDWRIGHT_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
if(BLENDWRIGHT_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
