# The ctest test "install": see CMakeLists.txt.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message("${output}")
    message(FATAL_ERROR "exit code ${result}: ${command}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -G Ninja -S ${PROGRAM} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/sphere)
# A level-3 icosphere has 1,280 triangles, and framed as it is it covers a good part of 256 x 256 pixels.
if(NOT output MATCHES "^1280 triangles cover ([0-9]+) of 65536 pixels\n$" OR CMAKE_MATCH_1 LESS 10000 OR CMAKE_MATCH_1 GREATER 60000)
  message(FATAL_ERROR "unexpected output of the program: ${output}")
endif()
run(${WORK}/prefix/bin/tessera --version)
message(STATUS "installed, found, built, run")
