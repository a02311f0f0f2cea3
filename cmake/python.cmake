# The Python package: where pybind11 and Python's headers are found. Before messages.cmake, whose generators write an
# empty __init__.py for the messages unless the package brings its own.
find_package(Python3 QUIET COMPONENTS Interpreter Development)
set(pybind11_FOUND FALSE)
if(Python3_Development_FOUND)
  find_package(pybind11 2.4 CONFIG QUIET)
endif()
# Not an option(), which would keep OFF from a configuration before pybind11 was installed (scripts/demo.sh).
if(NOT DEFINED CONCAVE_DISTANCE_WITH_PYTHON)
  set(CONCAVE_DISTANCE_WITH_PYTHON ${pybind11_FOUND})
endif()
if(CONCAVE_DISTANCE_WITH_PYTHON AND NOT pybind11_FOUND)
  message(FATAL_ERROR "CONCAVE_DISTANCE_WITH_PYTHON is ON, but Python's headers or pybind11 2.4 were not found "
    "(python3-dev, pybind11-dev: scripts/install_dependencies.sh build; or `pip install pybind11` and "
    "-Dpybind11_DIR=`python3 -m pybind11 --cmakedir`)")
endif()
if(CONCAVE_DISTANCE_WITH_PYTHON)
  # What catkin_python_setup() would set, which needs a setup.py.
  set(concave_distance_CATKIN_PYTHON_SETUP_HAS_PACKAGE_INIT TRUE)
elseif(NOT pybind11_FOUND)
  message(STATUS "No Python package is built: Python's headers or pybind11 2.4 were not found (python3-dev, pybind11-dev)")
endif()
