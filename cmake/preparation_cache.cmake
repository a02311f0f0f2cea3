# The preparation cache's keys hold a fingerprint of the sources that make bodies ready and of how they are compiled.
get_target_property(sources concave_distance_numeric_objects SOURCES)
get_target_property(loading_sources concave_distance_loading_objects SOURCES)
list(APPEND sources ${loading_sources})
set(fingerprinted)
foreach(source IN LISTS sources)
  if(source MATCHES "/src/(base|mesh|search/grid)/")
    list(APPEND fingerprinted ${source})
  endif()
endforeach()
get_property(mesh_readers GLOBAL PROPERTY CONCAVE_DISTANCE_MESH_READERS)
list(APPEND fingerprinted ${mesh_readers})
file(GLOB_RECURSE headers CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/include/concave_distance/base/*.h
  ${PROJECT_SOURCE_DIR}/include/concave_distance/mesh/*.h
  ${PROJECT_SOURCE_DIR}/src/base/*.h
  ${PROJECT_SOURCE_DIR}/src/mesh/*.h
  ${PROJECT_SOURCE_DIR}/src/search/grid/*.h)
list(APPEND fingerprinted ${headers})
list(SORT fingerprinted)
string(REPLACE ";" "|" files "${fingerprinted}")
set(fingerprint ${PROJECT_BINARY_DIR}/preparation_fingerprint.h)
add_custom_command(OUTPUT ${fingerprint}
  COMMAND ${CMAKE_COMMAND} "-DFILES=${files}" "-DOUTPUT=${fingerprint}"
    "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_CXX_FLAGS} ${CMAKE_BUILD_TYPE} ${CONCAVE_DISTANCE_NATIVE} ${EIGEN3_VERSION_STRING} ${assimp_VERSION} ${pugixml_VERSION}"
    -P ${PROJECT_SOURCE_DIR}/cmake/preparation_fingerprint.cmake
  DEPENDS ${fingerprinted} ${PROJECT_SOURCE_DIR}/cmake/preparation_fingerprint.cmake
  COMMENT "Fingerprint of the sources that make bodies ready"
  VERBATIM)
target_sources(concave_distance_numeric_objects PRIVATE ${fingerprint})
target_include_directories(concave_distance_numeric_objects PRIVATE ${PROJECT_BINARY_DIR})
