#!/usr/bin/env python3
"""The view that view_robot.py gives rviz: what stands in it, computed by projecting the bodies' corners."""
import itertools
import math
import os
import sys
import types
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
sys.dont_write_bytecode = True
for name in ("rospkg", "rospy", "tf2_ros", "concave_distance", "concave_distance.srv"):
    sys.modules[name] = types.ModuleType(name)
sys.modules["concave_distance.srv"].ListBodies = object
import view_robot  # noqa: E402
import yaml  # noqa: E402

CONFIG = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "config", "own_robot.rviz")
ROBOTS = {
    "gripper": [((0, 0, 0.02 * k), 0.03) for k in range(4)],
    "arm": [((0.1 * k, 0.2, 0.3 * k), 0.4) for k in range(6)],
    "humanoid": [((0, 0.4 * side, 0.2 * k), 0.35) for side in (-2, -1, 0, 1, 2) for k in range(8)],
    "gantry": [((3.0 * k - 10, 5, 6), 3.0) for k in range(10)],
    "crane": [((2, 2, 8.0 * k), 9.0) for k in range(10)] + [((70, 2, 75), 12.0)],
    "one body": [((100, -50, 3), 0.8)],
}


def farthest_angle(view, bodies):
    """Largest angle up or down from the view's centre at which a corner appears; behind the camera: pi."""
    yaw, pitch = view["Yaw"], view["Pitch"]
    back = [math.cos(yaw) * math.cos(pitch), math.sin(yaw) * math.cos(pitch), math.sin(pitch)]
    up = [-math.cos(yaw) * math.sin(pitch), -math.sin(yaw) * math.sin(pitch), math.cos(pitch)]
    focus = [view["Focal Point"][axis] for axis in "XYZ"]
    largest = 0.0
    for position, diameter in bodies:
        half = 0.5 * diameter / math.sqrt(3.0)  # a cube of this diameter
        for signs in itertools.product((-1, 1), repeat=3):
            offset = [position[k] + signs[k] * half - focus[k] for k in range(3)]
            depth = view["Distance"] - sum(a * b for a, b in zip(back, offset))
            height = sum(a * b for a, b in zip(up, offset))
            largest = max(largest, math.pi if depth <= view["Near Clip Distance"] else abs(math.atan2(height, depth)))
    return largest


class ViewRobot(unittest.TestCase):
    def fitted(self, bodies):
        with open(CONFIG) as stream:
            config = yaml.safe_load(stream)
        view_robot.fit(config, bodies)
        return config["Visualization Manager"]

    def test_every_robot_is_in_the_picture_and_fills_much_of_it(self):
        for name, bodies in ROBOTS.items():
            view = self.fitted(bodies)["Views"]["Current"]
            angle = farthest_angle(view, bodies)
            self.assertLess(angle, 0.5 * view["Field of View"], name)
            self.assertGreater(angle, 0.15 * view["Field of View"], name)

    def test_the_view_before_cut_large_robots_off(self):
        with open(CONFIG) as stream:
            view = yaml.safe_load(stream)["Visualization Manager"]["Views"]["Current"]
        self.assertGreater(farthest_angle(view, ROBOTS["crane"]), 0.5 * view["Field of View"])

    def test_the_grid_lies_under_the_robot_and_has_round_cells_of_its_size(self):
        for name, bodies in ROBOTS.items():
            displays = self.fitted(bodies)["Displays"]
            grid = next(display for display in displays if display["Class"] == "rviz/Grid")
            self.assertLess(grid["Offset"]["Z"], min(position[2] for position, _ in bodies), name)
            cell = grid["Cell Size"]
            self.assertIn(round(cell / 10.0 ** math.floor(math.log10(cell)), 6), (1.0, 2.5, 5.0), name)
            size = view_robot.fitted_view(bodies, 0.9, 0.35, 0.785)[2]
            self.assertLess(cell, size / 7.9, name)
            self.assertGreater(cell, size / 21.0, name)


if __name__ == "__main__":
    unittest.main()
