# Finds tinyxml2 for the target tinyxml2::tinyxml2; the package of Ubuntu 20.04 brings no configuration for CMake.
find_package(tinyxml2 QUIET CONFIG)
if(NOT TARGET tinyxml2::tinyxml2)
  find_path(TINYXML2_HEADERS tinyxml2.h)
  find_library(TINYXML2_LIBRARY tinyxml2)
  if(NOT TINYXML2_HEADERS OR NOT TINYXML2_LIBRARY)
    message(FATAL_ERROR "tinyxml2 was not found (libtinyxml2-dev)")
  endif()
  add_library(tinyxml2::tinyxml2 UNKNOWN IMPORTED)
  set_target_properties(tinyxml2::tinyxml2 PROPERTIES
    IMPORTED_LOCATION ${TINYXML2_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${TINYXML2_HEADERS})
endif()
