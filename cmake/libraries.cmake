# The libraries. Sources are compiled once, into two object libraries that the folders below src add to:
#   concave_distance_numeric_objects   everything but files: Eigen and TBB are all they need
#   concave_distance_loading_objects   mesh files, scene files, URDF and SRDF
# Made from them, and installed:
#   concave_distance_core      for users: bodies, pairs, effects, tracking of scenes, simulation
#   concave_distance_loading   for users: what is read from files; brings the core
#   concave_distance_internal  for the programs, the node and the tests of this package, with all symbols
# Users' libraries export what the installed headers declare (cmake/*.map) and may be static (BUILD_SHARED_LIBS=OFF).
option(BUILD_SHARED_LIBS "Build concave_distance_core and concave_distance_loading as shared libraries" ON)

add_library(concave_distance_headers INTERFACE)
target_compile_features(concave_distance_headers INTERFACE cxx_std_17)
target_include_directories(concave_distance_headers INTERFACE
  ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
target_link_libraries(concave_distance_headers INTERFACE Eigen3::Eigen)
if(CONCAVE_DISTANCE_NATIVE)
  target_compile_options(concave_distance_headers INTERFACE -march=native)
endif()

add_library(concave_distance_numeric_objects OBJECT)
target_link_libraries(concave_distance_numeric_objects
  PRIVATE concave_distance_headers concave_distance_warnings ${CONCAVE_DISTANCE_NUMERIC_LIBRARIES})
add_library(concave_distance_loading_objects OBJECT)
target_link_libraries(concave_distance_loading_objects
  PRIVATE concave_distance_headers concave_distance_warnings ${CONCAVE_DISTANCE_LOADING_LIBRARIES})
set_target_properties(concave_distance_numeric_objects concave_distance_loading_objects PROPERTIES
  POSITION_INDEPENDENT_CODE ON)
# Nobody replaces functions of these libraries by others of the same name: calls within them may be inlined.
target_compile_options(concave_distance_numeric_objects PRIVATE -fno-semantic-interposition)

# Most of a source's compile time is reading headers. Off by default: sources are then compiled one by one, as
# clang-tidy reads them, and each has to include what it uses.
option(CONCAVE_DISTANCE_FAST_BUILD "Precompile headers and compile several sources at a time" OFF)
if(CONCAVE_DISTANCE_FAST_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # A tenth of the time for a tenth more memory: the compiler clears up after itself less often.
  add_compile_options(--param=ggc-min-heapsize=1000000)
endif()
set(CONCAVE_DISTANCE_HEADERS_TO_PRECOMPILE
  <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <optional>
  <string> <vector>)
# concave_distance_compile_fast(<target> [headers ...]): with these headers precompiled too.
function(concave_distance_compile_fast target)
  if(CONCAVE_DISTANCE_FAST_BUILD)
    target_precompile_headers(${target} PRIVATE ${CONCAVE_DISTANCE_HEADERS_TO_PRECOMPILE} ${ARGN})
  endif()
endfunction()
# concave_distance_compile_together(<target>): for sources that include much and compile to little.
function(concave_distance_compile_together target)
  if(CONCAVE_DISTANCE_FAST_BUILD)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
  endif()
endfunction()
# concave_distance_compile_fast_like(<target> <other>): with the precompiled headers of a target with the same options.
function(concave_distance_compile_fast_like target other)
  if(CONCAVE_DISTANCE_FAST_BUILD)
    target_precompile_headers(${target} REUSE_FROM ${other})
  endif()
endfunction()
concave_distance_compile_fast(concave_distance_numeric_objects)
concave_distance_compile_together(concave_distance_numeric_objects)
concave_distance_compile_fast(concave_distance_loading_objects)
concave_distance_compile_together(concave_distance_loading_objects)

function(concave_distance_public_library name)
  add_library(concave_distance::concave_distance_${name} ALIAS concave_distance_${name})
  target_compile_features(concave_distance_${name} PUBLIC cxx_std_17)
  target_include_directories(concave_distance_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(concave_distance_${name} PUBLIC Eigen3::Eigen)
  set_target_properties(concave_distance_${name} PROPERTIES
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  if(CONCAVE_DISTANCE_NATIVE)
    target_compile_options(concave_distance_${name} PUBLIC -march=native)
  endif()
endfunction()

add_library(concave_distance_core $<TARGET_OBJECTS:concave_distance_numeric_objects>)
concave_distance_public_library(core)
target_link_libraries(concave_distance_core PRIVATE ${CONCAVE_DISTANCE_NUMERIC_LIBRARIES})
add_library(concave_distance_loading $<TARGET_OBJECTS:concave_distance_loading_objects>)
concave_distance_public_library(loading)
target_link_libraries(concave_distance_loading
  PUBLIC concave_distance_core PRIVATE ${CONCAVE_DISTANCE_LOADING_LIBRARIES})
if(BUILD_SHARED_LIBS)
  foreach(name core loading)
    set(map ${PROJECT_SOURCE_DIR}/cmake/${name}_symbols.map)
    target_link_options(concave_distance_${name} PRIVATE -Wl,--version-script=${map} -Wl,--no-undefined)
    set_target_properties(concave_distance_${name} PROPERTIES LINK_DEPENDS ${map})
  endforeach()
endif()

add_library(concave_distance_internal SHARED
  $<TARGET_OBJECTS:concave_distance_numeric_objects> $<TARGET_OBJECTS:concave_distance_loading_objects>)
target_link_libraries(concave_distance_internal
  PUBLIC concave_distance_headers
  PRIVATE ${CONCAVE_DISTANCE_NUMERIC_LIBRARIES} ${CONCAVE_DISTANCE_LOADING_LIBRARIES})
