# One helper for libraries, so that a module's CMakeLists is a list of files.
#
#   blendwright_module(name COMPONENT core|exchange LINK ... PRIVATE_LINK ...)   declares the static library blendwright::name
#   blendwright_sources(name PUBLIC a.hpp ... SOURCES a.cpp ...)   adds files, from any folder below
#
# PUBLIC headers are installed and must compile alone; any other header is private.
find_program(BLENDWRIGHT_CCACHE ccache)
if(BLENDWRIGHT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${BLENDWRIGHT_CCACHE})
endif()

# What every target of the project is compiled with.
add_library(blendwright_flags INTERFACE)
target_compile_features(blendwright_flags INTERFACE cxx_std_20)
target_compile_options(blendwright_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off
  $<$<BOOL:${BLENDWRIGHT_WERROR}>:-Werror>)
if(BLENDWRIGHT_SANITIZE)
  target_compile_options(blendwright_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(blendwright_flags INTERFACE -fsanitize=address,undefined)
endif()

function(blendwright_module name)
  cmake_parse_arguments(M "" "COMPONENT" "LINK;PRIVATE_LINK" ${ARGN})
  add_library(blendwright_${name} STATIC)
  add_library(blendwright::${name} ALIAS blendwright_${name})
  target_compile_features(blendwright_${name} PUBLIC cxx_std_20)
  target_include_directories(blendwright_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/blendwright>)
  target_link_libraries(blendwright_${name} PUBLIC ${M_LINK} PRIVATE ${M_PRIVATE_LINK} $<BUILD_INTERFACE:blendwright_flags>)
  set_target_properties(blendwright_${name} PROPERTIES
    EXPORT_NAME ${name} VERIFY_INTERFACE_HEADER_SETS ON POSITION_INDEPENDENT_CODE ON)
  target_sources(blendwright_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR})  # named before install()
  install(TARGETS blendwright_${name} EXPORT blendwright_${M_COMPONENT}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} FILE_SET HEADERS DESTINATION include/blendwright)
endfunction()

function(blendwright_sources name)
  cmake_parse_arguments(M "" "" "PUBLIC;SOURCES" ${ARGN})
  list(TRANSFORM M_PUBLIC PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  list(TRANSFORM M_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  target_sources(blendwright_${name} PRIVATE ${M_SOURCES}
    PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${M_PUBLIC})
endfunction()

# A GoogleTest executable; every test in it carries LABELS.
function(blendwright_test name)
  cmake_parse_arguments(T "" "" "SOURCES;LINK;LABELS" ${ARGN})
  add_executable(${name} ${T_SOURCES})
  target_link_libraries(${name} PRIVATE ${T_LINK} blendwright_flags GTest::gmock GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  # The test framework's templates are most of a test's compile time; at -O1 they take half as long.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_compile_definitions(${name} PRIVATE BLENDWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  gtest_discover_tests(${name} PROPERTIES LABELS "${T_LABELS}" DISCOVERY_TIMEOUT 60)
endfunction()
