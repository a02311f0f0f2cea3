#pragma once

// This folder gives a controller a scale for its velocities, from what the rows of a distance node say.
//
// It takes the topic `constraints`, the command (joint velocities, a twist, or none), parameters, and from tf
// where the frame of a twist is. It gives the scale and the reason for it. It keeps the last rows and the
// last command. The law is kinematics/velocity_guard.h and knows no ROS. Begin with guard_server.h;
// message_places.h turns messages into what the law reads, guard_words.h what it says into words.
