# The target concave_distance_demos: only what the demos and own_robot.launch start (scripts/demo.sh).
if(CONCAVE_DISTANCE_WITH_ROS)
  add_custom_target(concave_distance_demos DEPENDS
    distance_node simulation_node velocity_guard
    ${PROJECT_NAME}_generate_messages_cpp ${PROJECT_NAME}_generate_messages_py ${PROJECT_NAME}_gencfg)
endif()
