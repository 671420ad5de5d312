# Installs the build to a fresh folder, then configures, builds and runs the consumer project against it.
#   cmake -D BUILD=... -D SOURCE=... -D WORK=... -P run.cmake
foreach(step
    "rm;-rf;${WORK}"
    "${CMAKE_COMMAND};--install;${BUILD};--prefix;${WORK}/prefix"
    "${CMAKE_COMMAND};-S;${SOURCE};-B;${WORK}/build;-G;Ninja;-DCMAKE_BUILD_TYPE=Release;-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    "${CMAKE_COMMAND};--build;${WORK}/build"
    "${WORK}/build/consumer")
  execute_process(COMMAND ${step} RESULT_VARIABLE failed OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(failed)
    message(FATAL_ERROR "${step}\n${out}")
  endif()
endforeach()
message("${out}")
