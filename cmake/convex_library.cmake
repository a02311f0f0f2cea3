# concave_distance_convex: the room partition/ and the tree builder of continuous/. Their exact constructions are CGAL's
# (GPL-3), their quadratic programs ALGLIB's (GPL-2 or later), their GJK is FCL's (BSD): a library of its own, so that
# concave_distance_core and the node stay BSD-3-Clause. A program that links it is under the GPL as a whole.
find_package(CGAL QUIET)
find_package(fcl QUIET)
find_path(CONCAVE_DISTANCE_ALGLIB_HEADERS optimization.h PATH_SUFFIXES libalglib)
find_library(CONCAVE_DISTANCE_ALGLIB alglib)
mark_as_advanced(CONCAVE_DISTANCE_ALGLIB_HEADERS CONCAVE_DISTANCE_ALGLIB)

set(concave_distance_convex_missing)
foreach(library CGAL fcl)
  if(NOT ${library}_FOUND)
    list(APPEND concave_distance_convex_missing ${library})
  endif()
endforeach()
if(NOT CONCAVE_DISTANCE_ALGLIB_HEADERS OR NOT CONCAVE_DISTANCE_ALGLIB)
  list(APPEND concave_distance_convex_missing ALGLIB)
endif()
if(concave_distance_convex_missing)
  set(concave_distance_convex_default OFF)
  if(NOT DEFINED CACHE{CONCAVE_DISTANCE_WITH_CGAL})
    set(CONCAVE_DISTANCE_CONVEX_WAS_MISSING ON CACHE INTERNAL "WITH_CGAL is OFF because libraries were not found")
  endif()
  message(STATUS "No convex partition is built: not found: ${concave_distance_convex_missing}")
else()
  set(concave_distance_convex_default ON)
  # Choose the default again if the libraries were installed after the first configuration (scripts/demo.sh).
  if(CONCAVE_DISTANCE_CONVEX_WAS_MISSING)
    unset(CONCAVE_DISTANCE_WITH_CGAL CACHE)
    unset(CONCAVE_DISTANCE_CONVEX_WAS_MISSING CACHE)
  endif()
endif()
option(CONCAVE_DISTANCE_WITH_CGAL "Build convex partition and constraint trees (GPL)" ${concave_distance_convex_default})
if(CONCAVE_DISTANCE_WITH_CGAL AND concave_distance_convex_missing)
  message(FATAL_ERROR "CONCAVE_DISTANCE_WITH_CGAL is ON, but these were not found: ${concave_distance_convex_missing} "
    "(scripts/install_dependencies.sh build)")
endif()

if(CONCAVE_DISTANCE_WITH_CGAL)
  add_library(concave_distance_convex SHARED)
  add_library(concave_distance::concave_distance_convex ALIAS concave_distance_convex)
  target_link_libraries(concave_distance_convex
    PUBLIC concave_distance_core
    PRIVATE concave_distance_warnings CGAL::CGAL fcl ${CONCAVE_DISTANCE_ALGLIB})
  # Their headers warn where ours may not.
  target_include_directories(concave_distance_convex SYSTEM PRIVATE ${CONCAVE_DISTANCE_ALGLIB_HEADERS})
  foreach(room partition continuous/construction)
    if(EXISTS "${PROJECT_SOURCE_DIR}/src/${room}/CMakeLists.txt")
      add_subdirectory(src/${room})
    endif()
  endforeach()
endif()
