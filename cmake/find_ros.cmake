# Looks for catkin and for the ROS packages that the node needs.
# Sets CONCAVE_DISTANCE_ROS_FOUND; when it is OFF the core, the tools and their tests are built alone.
set(CONCAVE_DISTANCE_ROS_PACKAGES
  diagnostic_updater
  dynamic_reconfigure
  geometry_msgs
  message_generation
  nodelet
  pluginlib
  roscpp
  rosgraph_msgs
  roslib
  sensor_msgs
  shape_msgs
  std_msgs
  std_srvs
  tf2
  tf2_eigen
  tf2_ros
  topic_tools
  trajectory_msgs
  visualization_msgs)

set(CONCAVE_DISTANCE_ROS_FOUND OFF)
set(CONCAVE_DISTANCE_ROS_MISSING catkin)
# catkin leaves files in the install prefix even of a project that only looks for it.
if(DEFINED CONCAVE_DISTANCE_WITH_ROS AND NOT CONCAVE_DISTANCE_WITH_ROS)
  return()
endif()
# Tests run in the environment that catkin writes down here; it leaves out folders that are not there yet.
if(NOT CONCAVE_DISTANCE_IN_WORKSPACE)
  file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/devel/lib/python3/dist-packages")
endif()
# catkin's setup files are installed to the prefix that was configured, whatever `cmake --install --prefix` says: they
# are left out where nobody has named one.
if(NOT CONCAVE_DISTANCE_IN_WORKSPACE AND NOT DEFINED CATKIN_INSTALL_INTO_PREFIX_ROOT
    AND CMAKE_INSTALL_PREFIX STREQUAL "/usr/local")
  set(CATKIN_INSTALL_INTO_PREFIX_ROOT OFF)
endif()
find_package(catkin QUIET)
if(catkin_FOUND)
  find_package(catkin QUIET COMPONENTS ${CONCAVE_DISTANCE_ROS_PACKAGES})
  set(CONCAVE_DISTANCE_ROS_MISSING "")
  foreach(ros_package IN LISTS CONCAVE_DISTANCE_ROS_PACKAGES)
    if(NOT ${ros_package}_FOUND)
      list(APPEND CONCAVE_DISTANCE_ROS_MISSING ${ros_package})
    endif()
  endforeach()
  if(CONCAVE_DISTANCE_ROS_MISSING)
    message(STATUS "No node is built: these ROS packages were not found: ${CONCAVE_DISTANCE_ROS_MISSING}")
  else()
    set(CONCAVE_DISTANCE_ROS_FOUND ON)
  endif()
else()
  message(STATUS "No node is built: catkin was not found")
endif()
