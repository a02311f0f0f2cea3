#pragma once

// These programs move the bodies of the demo scenes.
//
// It takes a path of joints or poses from a CSV file, a marker dragged in rviz, or the joints of a URDF.
// It gives transforms on /tf or joint states, at a rate, forth and back.
// It keeps the path and where on it the program is.
// joint_player plays joint angles, pose_player poses of one frame, marker_mover follows the mouse,
// robot_mover swings each joint of any robot. They read their parameters by demo_parameters.h and end when
// one is wrong. Nothing in other folders includes from here.
