# install(): libraries, headers and a package. `find_package(blendwright)` gives the components
#   core      kernel, parametric, verify: needs Eigen, TBB, Highway, Ceres at link time only
#   exchange  brep, exchange, app: also OpenCASCADE, VTK, nlohmann_json
include(CMakePackageConfigHelpers)
set(blendwright_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/blendwright)
configure_package_config_file(${PROJECT_SOURCE_DIR}/kernel/cmake/blendwrightConfig.cmake.in
  ${PROJECT_BINARY_DIR}/blendwrightConfig.cmake INSTALL_DESTINATION ${blendwright_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/blendwrightConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/blendwrightConfig.cmake ${PROJECT_BINARY_DIR}/blendwrightConfigVersion.cmake
  DESTINATION ${blendwright_package_dir})
install(EXPORT blendwright_core NAMESPACE blendwright:: FILE blendwright-core.cmake DESTINATION ${blendwright_package_dir})
install(EXPORT blendwright_exchange NAMESPACE blendwright:: FILE blendwright-exchange.cmake
  DESTINATION ${blendwright_package_dir})
