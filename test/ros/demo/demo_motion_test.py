#!/usr/bin/env python3
"""The paths that the demos play."""
import math
import os
import sys
import unittest

import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "../../../src/ros/demo"))

from demo_motion import JointPath, PosePath, quaternion_of, to_and_fro  # noqa: E402

PERIOD = 4.0


def wave(count):
    times = numpy.linspace(0.0, PERIOD, count + 1)
    angles = 2.0 * math.pi * times / PERIOD
    return numpy.column_stack((times, numpy.sin(angles), numpy.cos(angles)))


class Joints(unittest.TestCase):
    def test_a_path_passes_through_its_waypoints_and_repeats(self):
        table = wave(8)
        path = JointPath(table)
        for row in table:
            for time in (row[0], row[0] + PERIOD, row[0] + 10.0 * PERIOD):
                self.assertLess(abs(path.at(time) - row[1:]).max(), 1e-12)

    def test_a_path_follows_a_smooth_curve_to_fourth_order(self):
        # The error of a cubic spline: 5/384 h^4 max|f''''| (Hall and Meyer 1976).
        bound = 5.0 / 384.0 * (PERIOD / 32 * math.pi / 2.0) ** 4
        path = JointPath(wave(32))
        for time in numpy.arange(0.0, PERIOD, 0.004):
            self.assertLess(abs(path.at(time)[0] - math.sin(math.pi * time / 2.0)), bound)

    def test_a_path_must_close_and_begin_at_zero(self):
        for table in (wave(2), wave(8)[:-1], wave(8) + [1.0, 0.0, 0.0]):
            self.assertRaises(SystemExit, JointPath, table)


class Poses(unittest.TestCase):
    def test_a_path_is_straight_and_turns_steadily_the_shorter_way(self):
        for sign in (1.0, -1.0):
            turned = [sign * part for part in quaternion_of(0.0, 0.0, 1.0)]
            path = PosePath(numpy.array([[1, 0, 0, 0, 0, 0, 0, 1], [3, 2, 0, 0, *turned]], float))
            position, turn = path.at(1.5)
            self.assertLess(abs(position - [0.5, 0.0, 0.0]).max(), 1e-15)
            self.assertLess(abs(turn - quaternion_of(0.0, 0.0, 0.25)).max(), 1e-14)
            self.assertEqual(list(path.at(0.0)[0]), [0.0, 0.0, 0.0])
            self.assertEqual(list(path.at(9.0)[0]), [2.0, 0.0, 0.0])

    def test_quaternions_are_those_of_turns_about_fixed_axes(self):
        roll, pitch, yaw = 0.3, -0.8, 2.1

        def about(axis, angle):
            parts = [0.0, 0.0, 0.0, math.cos(0.5 * angle)]
            parts[axis] = math.sin(0.5 * angle)
            return parts

        def product(p, q):
            vector = p[3] * numpy.array(q[:3]) + q[3] * numpy.array(p[:3]) + numpy.cross(p[:3], q[:3])
            return [*vector, p[3] * q[3] - numpy.dot(p[:3], q[:3])]
        expected = product(about(2, yaw), product(about(1, pitch), about(0, roll)))
        self.assertLess(max(abs(a - b) for a, b in zip(quaternion_of(roll, pitch, yaw), expected)), 1e-15)

    def test_to_and_fro_rests_at_either_end(self):
        for elapsed, time in ((0.0, 0.0), (7.0, 7.0), (20.5, 20.0), (22.0, 19.0), (41.5, 0.0), (49.0, 7.0)):
            self.assertEqual(to_and_fro(elapsed, 20.0, 1.0), time)


if __name__ == "__main__":
    unittest.main()
