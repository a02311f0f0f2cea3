# rosrun does not look below a package's folder `build`, where a build without a workspace puts the programs; it finds
# these links. roslaunch finds the programs themselves and does not look into hidden folders.
if(CONCAVE_DISTANCE_WITH_ROS AND PROJECT_BINARY_DIR STREQUAL "${PROJECT_SOURCE_DIR}/build")
  set(rosrun_links ${PROJECT_SOURCE_DIR}/.rosrun)
  file(REMOVE_RECURSE ${rosrun_links})
  file(MAKE_DIRECTORY ${rosrun_links})
  foreach(program IN ITEMS clearance_query distance_bag distance_query evaluate mesh_tool simulate thesis_tool
      distance_node simulation_node velocity_guard)
    file(CREATE_LINK ../build/devel/lib/concave_distance/${program} ${rosrun_links}/${program} SYMBOLIC RESULT ignored)
  endforeach()
endif()
