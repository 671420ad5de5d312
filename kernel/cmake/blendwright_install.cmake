# install(): libraries, headers and a package that `find_package(blendwright)` finds.
