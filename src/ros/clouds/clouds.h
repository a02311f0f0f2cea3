#pragma once

// This folder makes bodies of what sensors see.
//
// It takes messages of sensor_msgs/PointCloud2 and octomap_msgs/Octomap on the topics that a scene's clouds
// name, each of any size and content, and tf at their stamps.
// It gives the scene's body of a cloud the surface of the voxels that are occupied, without the points on the
// robot, and the stamp of the message; what cannot be used is refused with its reason, and the last one goes
// on until it is too old. It keeps the last message of each cloud that has not been used yet: while one is
// made, those between are passed over. Begin with cloud_receiver.h (one cloud's thread), then cloud_message.h
// (what is read of a message), octomap_message.h (maps) and cloud_voxels.h (what a body is made of). Nothing
// here is in the way of a cycle.
