#!/usr/bin/env python3
"""From a URDF to rows for a controller: what the joint velocities do to every place where two links could touch next.

  rows_of_robot.py robot.urdf [folder with its meshes ...]
"""
import sys

import concave_distance as cd
import numpy as np

robot = cd.load_robot(sys.argv[1], mesh_folders=sys.argv[2:], cutoff=0.3, skip_overlapping_pairs=True)
tracker = cd.SceneTracker(robot)
constraints = cd.ConstraintRows(robot, distance=0.2, capacity=32)
positions = robot.rest_positions
for step in range(200):
    tracker.update(robot.poses_of_bodies(positions), 0.02 * step)
    rows = constraints.update(tracker, positions)
    velocities = np.full(len(robot.velocity_names), 0.5)
    # Each row in turn takes from the velocities what would close its place faster than 2/s of its distance.
    for value, gradient in zip(rows.rows["value"], rows.jacobian):
        excess = -2.0 * (value - 0.003) - gradient @ velocities
        if excess > 0.0:
            velocities += excess * gradient / max(gradient @ gradient, 1e-9)
    positions += 0.02 * velocities
used = rows.rows["state"] == cd.SlotState.USED
print("{} rows, {:.4f} m left at the nearest place".format(used.sum(), rows.rows["value"][used].min()))
