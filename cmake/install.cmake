# What is installed, in components (cmake --install build --component library):
#   library   headers, concave_distance_core and concave_distance_loading, what find_package and pkg-config need
#   tools     clearance_query, distance_query, mesh_tool, simulate, programs of the thesis where they are built, and the robots and scenes they are tried with
#   node      (with ROS) the node, nodelet, distance_bag (with the Python package), messages, launch files
# Each brings the licence. Files of the exported targets are for the devel space (or build tree) too.
set(concave_distance_config_destination ${CONCAVE_DISTANCE_SHARE_DESTINATION}/cmake)

install(TARGETS concave_distance_core concave_distance_loading EXPORT concave_distance-targets
  ARCHIVE DESTINATION ${CONCAVE_DISTANCE_LIB_DESTINATION} COMPONENT library
  LIBRARY DESTINATION ${CONCAVE_DISTANCE_LIB_DESTINATION} COMPONENT library
  RUNTIME DESTINATION ${CONCAVE_DISTANCE_BIN_DESTINATION} COMPONENT library)
install(TARGETS mesh_import_worker RUNTIME DESTINATION ${CONCAVE_DISTANCE_BIN_DESTINATION} COMPONENT library)
install(TARGETS concave_distance_internal
  LIBRARY DESTINATION ${CONCAVE_DISTANCE_LIB_DESTINATION} COMPONENT tools)
export(EXPORT concave_distance-targets NAMESPACE concave_distance::
  FILE ${CONCAVE_DISTANCE_DEVEL_SPACE}/${concave_distance_config_destination}/concave_distance-targets.cmake)
install(EXPORT concave_distance-targets NAMESPACE concave_distance::
  DESTINATION ${concave_distance_config_destination} COMPONENT library)
install(DIRECTORY include/concave_distance/ DESTINATION ${CONCAVE_DISTANCE_INCLUDE_DESTINATION} COMPONENT library)
install(FILES LICENSE DESTINATION ${CONCAVE_DISTANCE_SHARE_DESTINATION} COMPONENT library)

# pkg-config, for builds without CMake.
configure_file(cmake/concave_distance.pc.in
  ${CONCAVE_DISTANCE_DEVEL_SPACE}/${CONCAVE_DISTANCE_LIB_DESTINATION}/pkgconfig/concave_distance_loading.pc @ONLY)
install(FILES ${CONCAVE_DISTANCE_DEVEL_SPACE}/${CONCAVE_DISTANCE_LIB_DESTINATION}/pkgconfig/concave_distance_loading.pc
  DESTINATION ${CONCAVE_DISTANCE_LIB_DESTINATION}/pkgconfig COMPONENT library)

# Without catkin the config file is the extras file itself.
if(NOT CONCAVE_DISTANCE_WITH_ROS)
  #catkin_lint: ignore missing_file
  include(CMakePackageConfigHelpers)
  set(concave_distance_config_directory ${CONCAVE_DISTANCE_DEVEL_SPACE}/${concave_distance_config_destination})
  configure_file(cmake/concave_distance-extras.cmake.in
    ${concave_distance_config_directory}/concave_distanceConfig.cmake @ONLY)
  write_basic_package_version_file(${concave_distance_config_directory}/concave_distanceConfigVersion.cmake
    COMPATIBILITY SameMajorVersion)
  install(FILES
    ${concave_distance_config_directory}/concave_distanceConfig.cmake
    ${concave_distance_config_directory}/concave_distanceConfigVersion.cmake
    DESTINATION ${concave_distance_config_destination} COMPONENT library)
endif()

install(TARGETS clearance_query distance_query mesh_tool simulate
  RUNTIME DESTINATION ${CONCAVE_DISTANCE_BIN_DESTINATION} COMPONENT tools)
foreach(program evaluate thesis_tool)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CONCAVE_DISTANCE_BIN_DESTINATION} COMPONENT tools)
  endif()
endforeach()
install(DIRECTORY config meshes urdf DESTINATION ${CONCAVE_DISTANCE_SHARE_DESTINATION} COMPONENT tools)
if(CONCAVE_DISTANCE_WITH_ROS)
  install(DIRECTORY launch DESTINATION ${CONCAVE_DISTANCE_SHARE_DESTINATION} COMPONENT node)
  catkin_install_python(PROGRAMS scripts/follow_rows.py scripts/move_crowd.py scripts/pick_parts.py scripts/plot_distances.py scripts/show_distances.py
    scripts/simulate_camera.py scripts/view_robot.py src/ros/bridges/cob_bridge.py src/ros/bridges/moveit_bridge.py
    src/ros/demo/joint_player.py src/ros/demo/marker_mover.py src/ros/demo/pose_player.py src/ros/demo/robot_mover.py
    DESTINATION ${CONCAVE_DISTANCE_BIN_DESTINATION})
  install(FILES scripts/row_program.py DESTINATION ${CONCAVE_DISTANCE_BIN_DESTINATION} COMPONENT node)
  # Modules of the bridges and the demos, which look for them beside themselves; in no component, as the programs.
  install(FILES
    src/ros/bridges/bridge_problems.py
    src/ros/bridges/cob_messages.py
    src/ros/bridges/distance_node_client.py
    src/ros/bridges/distance_node_scene.py
    src/ros/bridges/message_definitions.py
    src/ros/bridges/obstacle_distances.py
    src/ros/bridges/octomap_relay.py
    src/ros/bridges/planning_scene_messages.py
    src/ros/bridges/planning_scene_source.py
    src/ros/bridges/planning_scene_state.py
    src/ros/bridges/planning_scene_values.py
    src/ros/bridges/registered_obstacles.py
    src/ros/bridges/rigid_transforms.py
    src/ros/bridges/scene_operations.py
    src/ros/demo/demo_motion.py
    DESTINATION ${CONCAVE_DISTANCE_BIN_DESTINATION})
endif()
