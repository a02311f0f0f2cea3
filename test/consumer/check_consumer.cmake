# Configures, builds and runs the consumer package against a devel space or against an installed copy; any failure
# is fatal. cmake -D<name>=<value> ... -P check_consumer.cmake with
#   BUILD_DIRECTORY     of concave_distance, built
#   WORK_DIRECTORY      emptied first; everything is done inside it
#   SPACE               devel or install
#   DEVEL_SPACE         the devel space's directory
#   USES_CATKIN         ON or OFF
#   GENERATOR, CXX_COMPILER, PYTHON: as concave_distance was configured
function(run_or_fail)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message(STATUS "${ARGV}\n${output}")
  set(output "${output}" PARENT_SCOPE)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed with ${result}: ${ARGV}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIRECTORY})
file(MAKE_DIRECTORY ${WORK_DIRECTORY})
if(SPACE STREQUAL "install")
  # Hidden: roslaunch looks for launch files in every folder of the package that is not, the build's too.
  set(prefix ${WORK_DIRECTORY}/.prefix)
  run_or_fail(${CMAKE_COMMAND} --install ${BUILD_DIRECTORY} --prefix ${prefix})
  string(REGEX MATCHALL "-- (Installing|Up-to-date): [^\n]+" installed "${output}")
  list(FILTER installed EXCLUDE REGEX ": ${prefix}/")
  if(installed)
    message(FATAL_ERROR "files were installed outside of the prefix: ${installed}")
  endif()
else()
  set(prefix ${DEVEL_SPACE})
endif()

set(consumer_build ${WORK_DIRECTORY}/build)
run_or_fail(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/package -B ${consumer_build} -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_PREFIX_PATH=${prefix} -DPYTHON_EXECUTABLE=${PYTHON}
  -DPython3_EXECUTABLE=${PYTHON} -DCONSUMER_USES_CATKIN=${USES_CATKIN})
# A concave_distance found elsewhere on the machine would prove nothing.
file(STRINGS ${consumer_build}/CMakeCache.txt found REGEX "^concave_distance_DIR:")
if(NOT found MATCHES "=${prefix}/")
  message(FATAL_ERROR "the consumer found another concave_distance: ${found}, expected one below ${prefix}")
endif()
run_or_fail(${CMAKE_COMMAND} --build ${consumer_build})
run_or_fail(${consumer_build}/bin/consumer)

# A program whose Eigen types are aligned otherwise must not link.
if(NOT USES_CATKIN AND NOT IS_NATIVE AND CMAKE_HOST_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(avx_build ${WORK_DIRECTORY}/avx)
  run_or_fail(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/package -B ${avx_build} -G ${GENERATOR}
    -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_PREFIX_PATH=${prefix} -DPYTHON_EXECUTABLE=${PYTHON}
    -DPython3_EXECUTABLE=${PYTHON} -DCONSUMER_USES_CATKIN=OFF -DCMAKE_CXX_FLAGS=-mavx)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${avx_build}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(result EQUAL 0 OR NOT output MATCHES "EigenAlignmentOfTheLibrary<32>")
    message(FATAL_ERROR "a program compiled with -mavx was linked: ${output}")
  endif()
endif()
