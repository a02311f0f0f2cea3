# What the convex partition and the building of constraint trees (thesis/src) need. Their exact constructions are CGAL's
# (GPL-3), their quadratic programs ALGLIB's (GPL-2 or later), their GJK is FCL's (BSD): programs that link them,
# evaluate, thesis_tool, tests and benchmarks, are under the GPL as a whole. The core and the node stay BSD-3-Clause.
find_package(CGAL QUIET)
find_package(fcl QUIET)
find_path(CONCAVE_DISTANCE_ALGLIB_HEADERS optimization.h PATH_SUFFIXES libalglib)
find_library(CONCAVE_DISTANCE_ALGLIB alglib)
mark_as_advanced(CONCAVE_DISTANCE_ALGLIB_HEADERS CONCAVE_DISTANCE_ALGLIB)

set(concave_distance_gpl_missing)
foreach(library CGAL fcl)
  if(NOT ${library}_FOUND)
    list(APPEND concave_distance_gpl_missing ${library})
  endif()
endforeach()
if(NOT CONCAVE_DISTANCE_ALGLIB_HEADERS OR NOT CONCAVE_DISTANCE_ALGLIB)
  list(APPEND concave_distance_gpl_missing ALGLIB)
endif()
# Not an option(), which would keep OFF from a configuration before the libraries were installed.
if(NOT DEFINED CONCAVE_DISTANCE_WITH_CGAL)
  if(concave_distance_gpl_missing)
    set(CONCAVE_DISTANCE_WITH_CGAL OFF)
    message(STATUS "No convex partition is built: not found: ${concave_distance_gpl_missing}")
  else()
    set(CONCAVE_DISTANCE_WITH_CGAL ON)
  endif()
endif()
if(CONCAVE_DISTANCE_WITH_CGAL AND concave_distance_gpl_missing)
  message(FATAL_ERROR "CONCAVE_DISTANCE_WITH_CGAL is ON, but these were not found: ${concave_distance_gpl_missing} "
    "(scripts/install_dependencies.sh build)")
endif()
