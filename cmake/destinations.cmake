# Where things go, in catkin's layout with or without catkin: programs that rosrun and launch files start in
# lib/concave_distance, data in share/concave_distance. After catkin_package(), which has set CATKIN_*_DESTINATION.
if(NOT CONCAVE_DISTANCE_WITH_ROS)
  set(CATKIN_DEVEL_PREFIX ${CMAKE_CURRENT_BINARY_DIR}/devel)
  set(CATKIN_PACKAGE_LIB_DESTINATION lib)
  set(CATKIN_PACKAGE_BIN_DESTINATION lib/concave_distance)
  set(CATKIN_PACKAGE_INCLUDE_DESTINATION include/concave_distance)
  set(CATKIN_PACKAGE_SHARE_DESTINATION share/concave_distance)
  set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_LIB_DESTINATION})
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
endif()

# Installed programs find the libraries beside them wherever the prefix is moved to.
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/..")
