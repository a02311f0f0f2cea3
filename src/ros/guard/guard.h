#pragma once

// This folder puts a velocity guard between who commands a robot and the robot.
//
// It takes the topic `constraints`, commands (joint velocities or a twist), parameters, and from tf where the
// frame of a twist is. It gives the scale, what it decided and why, and the commands scaled with it; zeros
// for commands that are wrong or do not come. It keeps the last rows and the last command. The law is
// kinematics/velocity_guard.h and knows no ROS. Begin with guard_server.h; message_places.h turns messages
// into what the law reads, guard_words.h what it says into words.
