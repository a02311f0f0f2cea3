#!/usr/bin/env python3
"""Moves one joint of a robot and prints its nearest pair at every step, without ROS.

  nearest_place.py robot.urdf [folder with its meshes ...]
"""
import sys

import concave_distance as cd
import numpy as np

robot = cd.load_robot(sys.argv[1], mesh_folders=sys.argv[2:], cutoff=0.5, skip_overlapping_pairs=True)
for where, message in robot.problems:
    print("{}: {}".format(where, message))
for warning in robot.warnings:
    print(warning)
tracker = cd.SceneTracker(robot)
positions = np.tile(robot.rest_positions, (50, 1))
joint = positions.shape[1] // 2
positions[:, joint] = np.linspace(0.0, 1.0, 50)
for step, poses in enumerate(robot.poses_of_bodies(positions)):
    answers = tracker.update(poses, 0.02 * step)
    nearest = np.nanargmin(answers.rows["distance"])
    print("{} {:+.2f}: {} {:.4f} m, {} niches".format(robot.position_names[joint], positions[step, joint],
                                                      answers.pairs[nearest], answers.rows["distance"][nearest],
                                                      len(answers.niches_of(nearest))))
