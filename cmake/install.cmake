# What is installed, and the exported target, for the devel space (or build tree) and for the install space.
set(concave_distance_config_destination ${CONCAVE_DISTANCE_SHARE_DESTINATION}/cmake)

install(TARGETS concave_distance_core EXPORT concave_distance-targets
  ARCHIVE DESTINATION ${CONCAVE_DISTANCE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CONCAVE_DISTANCE_LIB_DESTINATION}
  RUNTIME DESTINATION ${CONCAVE_DISTANCE_BIN_DESTINATION})
export(EXPORT concave_distance-targets NAMESPACE concave_distance::
  FILE ${CONCAVE_DISTANCE_DEVEL_SPACE}/${concave_distance_config_destination}/concave_distance-targets.cmake)
install(EXPORT concave_distance-targets NAMESPACE concave_distance::
  DESTINATION ${concave_distance_config_destination})
# The libraries of the node and of the thesis are not exported, and their headers are not installed.
install(DIRECTORY include/concave_distance/ DESTINATION ${CONCAVE_DISTANCE_INCLUDE_DESTINATION}
  PATTERN ros EXCLUDE PATTERN thesis EXCLUDE)

# Without catkin the config file is the extras file itself.
if(NOT CONCAVE_DISTANCE_WITH_ROS)
  #catkin_lint: ignore missing_file
  include(CMakePackageConfigHelpers)
  set(concave_distance_config_directory ${CONCAVE_DISTANCE_DEVEL_SPACE}/${concave_distance_config_destination})
  configure_file(cmake/concave_distance-extras.cmake.in
    ${concave_distance_config_directory}/concave_distanceConfig.cmake @ONLY)
  write_basic_package_version_file(${concave_distance_config_directory}/concave_distanceConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES
    ${concave_distance_config_directory}/concave_distanceConfig.cmake
    ${concave_distance_config_directory}/concave_distanceConfigVersion.cmake
    DESTINATION ${concave_distance_config_destination})
  install(FILES package.xml DESTINATION ${CONCAVE_DISTANCE_SHARE_DESTINATION})
endif()

install(TARGETS distance_query evaluate mesh_tool simulate RUNTIME DESTINATION ${CONCAVE_DISTANCE_BIN_DESTINATION})
foreach(folder config launch meshes urdf)
  if(IS_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/${folder}")
    install(DIRECTORY ${folder} DESTINATION ${CONCAVE_DISTANCE_SHARE_DESTINATION})
  endif()
endforeach()
if(CONCAVE_DISTANCE_WITH_ROS)
  catkin_install_python(PROGRAMS scripts/show_distances.py DESTINATION ${CONCAVE_DISTANCE_BIN_DESTINATION})
endif()
