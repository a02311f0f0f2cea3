# The option CONCAVE_DISTANCE_WITH_PYTHON with and without pybind11, in a build without ROS; any failure is fatal.
# cmake -D<name>=<value> ... -P check_python_option.cmake with
#   SOURCE_DIRECTORY    of concave_distance
#   WORK_DIRECTORY      emptied first
#   GENERATOR, CXX_COMPILER, PYTHON: as concave_distance was configured
function(configure result_name output_name)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIRECTORY} -B ${WORK_DIRECTORY} -G ${GENERATOR}
    -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DPYTHON_EXECUTABLE=${PYTHON} -DPython3_EXECUTABLE=${PYTHON}
    -DCONCAVE_DISTANCE_WITH_ROS=OFF -DCONCAVE_DISTANCE_BUILD_TESTS=OFF -DCONCAVE_DISTANCE_BUILD_BENCHMARKS=OFF
    ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  set(${result_name} ${result} PARENT_SCOPE)
  set(${output_name} "${output}" PARENT_SCOPE)
endfunction()
function(require_target is_there)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIRECTORY} --target help OUTPUT_VARIABLE targets)
  if(is_there AND NOT targets MATCHES "concave_distance_python")
    message(FATAL_ERROR "the Python package has no target")
  elseif(NOT is_there AND targets MATCHES "concave_distance_python")
    message(FATAL_ERROR "the Python package has a target")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIRECTORY})
configure(result output -DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON)
if(NOT result EQUAL 0 OR NOT output MATCHES "No Python package is built: .*pybind11-dev")
  message(FATAL_ERROR "without pybind11: ${result}, ${output}")
endif()
require_target(FALSE)

configure(result output -DCMAKE_DISABLE_FIND_PACKAGE_pybind11=OFF)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "with pybind11 that was installed later: ${result}, ${output}")
endif()
require_target(TRUE)

configure(result output -DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON -DCONCAVE_DISTANCE_WITH_PYTHON=ON)
if(result EQUAL 0 OR NOT output MATCHES "CONCAVE_DISTANCE_WITH_PYTHON is ON, but .*pybind11-dev")
  message(FATAL_ERROR "asked for without pybind11: ${result}, ${output}")
endif()

configure(result output -DCMAKE_DISABLE_FIND_PACKAGE_pybind11=OFF)
if(NOT result EQUAL 0 OR output MATCHES "No Python package")
  message(FATAL_ERROR "with pybind11: ${result}, ${output}")
endif()
require_target(TRUE)
