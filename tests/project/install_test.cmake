# Installs the build into a scratch prefix, builds tests/project/consumer against it, runs it.
set(scratch ${BUILD}/install-test)
file(REMOVE_RECURSE ${scratch})
foreach(command
    "${CMAKE_COMMAND};--install;${BUILD};--prefix;${scratch}/prefix"
    "${CMAKE_COMMAND};-S;${SOURCE}/tests/project/consumer;-B;${scratch}/build;-DCMAKE_PREFIX_PATH=${scratch}/prefix;-DCMAKE_CXX_COMPILER=${CXX};-DCMAKE_CXX_FLAGS=${FLAGS}"
    "${CMAKE_COMMAND};--build;${scratch}/build"
    "${scratch}/build/consumer")
  execute_process(COMMAND ${command} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
endforeach()
