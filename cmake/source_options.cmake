# Options of single sources of the libraries, set where the libraries are defined: CMake 3.16 takes them from no other
# folder.

# Sums of two doubles are exact, and a vertex has the same bits wherever it is computed, only where no product is fused
# into a sum: with CONCAVE_DISTANCE_NATIVE, and on processors that always have fused multiply-add, a compiler does so.
# A precompiled header would bring its own flags.
set_source_files_properties(
  ${PROJECT_SOURCE_DIR}/src/base/exact_orientation.cpp
  ${PROJECT_SOURCE_DIR}/src/distance/kernels/triangle_crossing.cpp
  ${PROJECT_SOURCE_DIR}/src/interference/working_frame.cpp
  PROPERTIES COMPILE_OPTIONS -ffp-contract=off SKIP_PRECOMPILE_HEADERS ON)

set_source_files_properties(${PROJECT_SOURCE_DIR}/src/base/versions.cpp
  PROPERTIES COMPILE_DEFINITIONS CONCAVE_DISTANCE_VERSION="${PROJECT_VERSION}")
set_source_files_properties(${PROJECT_SOURCE_DIR}/src/mesh/import/import_process.cpp PROPERTIES COMPILE_DEFINITIONS
  CONCAVE_DISTANCE_INSTALLED_WORKER="${CMAKE_INSTALL_PREFIX}/lib/concave_distance/mesh_import_worker")
