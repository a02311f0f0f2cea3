#!/usr/bin/env python3
"""Clearance of motions in Python, beside closed forms and beside samples of the motion."""
import os
import signal
import tempfile
import unittest

import concave_distance as cd
import numpy as np
from slide_robot import SLIDE

PACKAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")

SCENE = """
bodies:
  - {name: near, frame: world, sphere: {radius: 0.3}}
  - {name: far, sphere: {radius: 0.2}}
pairs:
  - {between: [near, far], name: spheres}
"""


def load_text(load, text, suffix):
    with tempfile.NamedTemporaryFile("w", suffix=suffix) as file:
        file.write(text)
        file.flush()
        return load(file.name, strict=True)


class Alarm(Exception):
    pass


class Clearance(unittest.TestCase):
    def setUp(self):
        self.slide = load_text(cd.load_robot, SLIDE, ".urdf")
        self.spheres = load_text(cd.load_scene, SCENE, ".yaml")

    def test_a_slide_has_that_of_the_closed_form(self):
        found = cd.find_clearance(self.slide, [[-1.0], [1.0]], [2.0, 4.0], tolerance=1e-6, threshold=0.6, niches=True)
        self.assertEqual(found.status, cd.ClearanceStatus.OK)
        self.assertAlmostEqual(found.distance, 0.55, delta=1e-6)
        self.assertTrue(0.55 - 1.1e-6 <= found.lower_bound <= 0.55)
        self.assertAlmostEqual(found.time, 3.0, delta=2e-3)
        self.assertEqual(found.bodies, ("base", "ball"))
        np.testing.assert_allclose(found.point_a, [0, 0, 0.1], atol=1e-3)
        np.testing.assert_allclose(found.point_b, [0, 0, 0.65], atol=3e-3)
        np.testing.assert_allclose(found.world_from_a, np.eye(4), atol=1e-12)
        self.assertEqual(found.solution.rows["distance"][0], found.distance)
        self.assertEqual(found.solution.niches["id"].size, 1)
        begin = 3.0 - np.sqrt(0.75 ** 2 - 0.7 ** 2)
        self.assertLessEqual(found.proven_until, begin)
        self.assertGreaterEqual(found.first_below, begin)
        self.assertAlmostEqual(found.proven_until, begin, delta=1e-2)
        self.assertAlmostEqual(found.first_below, begin, delta=1e-2)
        self.assertEqual(found.first_below_bodies, ("base", "ball"))
        self.assertEqual(found.pairs.shape, (1,))
        self.assertEqual(found.pairs["distance"][0], found.distance)
        self.assertEqual((found.not_located, found.outside_limits), ([], []))
        self.assertGreater(found.queries, 0)

    def test_a_body_that_passes(self):
        poses = np.array([[-2.0, 0.8, 0, 0, 0, 0, 1], [2.0, 0.8, 0, 0, 0, 0, 1]])
        for given in (poses, np.asfortranarray(poses), poses.tolist()):
            found = cd.find_clearance_of_body(self.spheres, "far", given, tolerance=1e-6)
            self.assertAlmostEqual(found.distance, 0.3, delta=1e-6)
            self.assertAlmostEqual(found.time, 0.5, delta=2e-3)
            self.assertTrue(np.isnan(found.first_below))
            self.assertIsNone(found.first_below_bodies)
            self.assertIsNone(found.solution)
        lost = load_text(cd.load_scene, SCENE.replace("frame: world, ", ""), ".yaml")
        unknown = cd.find_clearance_of_body(lost, "far", poses)
        self.assertEqual((unknown.status, unknown.not_located), (cd.ClearanceStatus.NO_PAIRS, ["near"]))
        self.assertTrue(np.isnan(unknown.distance))
        self.assertIsNone(unknown.bodies)
        where = np.full((2, 7), np.nan)
        where[0] = [0, 0.1, 0, 0, 0, 0, 1]
        moved = cd.find_clearance_of_body(self.spheres, "far", poses, bodies=where, tolerance=1e-6)
        self.assertAlmostEqual(moved.distance, 0.2, delta=1e-6)
        poses[:, 1] = 0.4
        hit = cd.find_clearance_of_body(self.spheres, "far", poses)
        self.assertEqual((hit.status, hit.distance, hit.lower_bound), (cd.ClearanceStatus.PENETRATING, 0.0, 0.0))
        begin = 0.5 - np.sqrt(0.5 ** 2 - 0.4 ** 2) / 4.0
        self.assertLessEqual(hit.proven_until, begin)
        self.assertAlmostEqual(hit.first_below, begin, delta=1e-2)

    def test_no_sample_of_a_motion_is_nearer(self):
        robot = cd.load_robot(os.path.join(PACKAGE, "urdf", "kr5.urdf"), strict=True,
                              mesh_folders=[os.path.join(PACKAGE, "meshes")])
        tracker = cd.SceneTracker(robot)
        random = np.random.default_rng(2)
        for _ in range(3):
            ends = random.uniform(-0.8, 0.8, (2, len(robot.position_names)))
            found = cd.find_clearance(robot, ends, tolerance=1e-4, each_pair=True)
            share = np.linspace(0.0, 1.0, 201)[:, None]
            samples = tracker.nearest(robot.poses_of_bodies(ends[0] + share * (ends[1] - ends[0])))["distance"]
            self.assertGreaterEqual(samples.min(), found.lower_bound)
            self.assertLessEqual(found.distance, samples.min() + 1e-4)
            self.assertLessEqual(found.distance - found.lower_bound, 1.0001e-4)
            at = robot.poses_of_bodies(ends[0] + found.time * (ends[1] - ends[0]))
            self.assertAlmostEqual(tracker.nearest(at[None])["distance"][0], found.distance, delta=1e-9)
            self.assertAlmostEqual(np.nanmin(found.pairs["lower_bound"]), found.lower_bound, delta=1e-12)

    def test_progress_and_exceptions_that_end_it(self):
        calls = []

        def note(*now):
            calls.append(now)
            if len(calls) == 3:
                raise Alarm

        def ring(*_):
            raise Alarm

        random = np.random.default_rng(2)
        robot = cd.load_robot(os.path.join(PACKAGE, "urdf", "kr5.urdf"), mesh_folders=[os.path.join(PACKAGE, "meshes")])
        waypoints = random.uniform(-0.8, 0.8, (2000, len(robot.position_names)))  # takes long
        with self.assertRaises(Alarm):
            cd.find_clearance(robot, waypoints, tolerance=1e-6, each_pair=True, progress=note)
        self.assertEqual(len(calls), 3)
        for before, (fraction, distance, bound, queries) in zip([(0.0, np.inf, 0.0, 0)] + calls, calls):
            self.assertTrue(before[0] <= fraction <= 1.0 and distance <= before[1] and queries >= before[3])
            self.assertTrue(np.isnan(bound) or bound <= distance)
        handler = signal.signal(signal.SIGALRM, ring)
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.3)
            with self.assertRaises(Alarm):
                cd.find_clearance(robot, waypoints, tolerance=1e-6, each_pair=True)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, handler)
        ended = cd.find_clearance(robot, waypoints, tolerance=1e-6, each_pair=True, time_budget=0.05)
        self.assertEqual(ended.status, cd.ClearanceStatus.BUDGET_EXHAUSTED)
        self.assertTrue(np.isnan(ended.lower_bound) or ended.lower_bound <= ended.distance)

    def test_errors(self):
        slide, spheres = self.slide, self.spheres
        pose = [2.0, 0, 0, 0, 0, 0, 1]
        for what, call in (
                ("(2,)", lambda: cd.find_clearance(slide, [0.0, 1.0])),
                ("finite", lambda: cd.find_clearance(slide, [[0.0], [np.nan]])),
                ("type", lambda: cd.find_clearance(slide, [["a"]])),
                ("ascend", lambda: cd.find_clearance(slide, [[0.0], [1.0]], [1.0, 1.0])),
                ("elbow", lambda: cd.find_clearance(slide, [[0.0], [1.0]], joints=["elbow"])),
                ("several rows", lambda: cd.find_clearance(slide, [[0.0], [1.0]], start=[[0.0], [1.0]])),
                ("tolerance", lambda: cd.find_clearance(slide, [[0.0], [1.0]], tolerance=-1.0)),
                ("hammer", lambda: cd.find_clearance_of_body(spheres, "hammer", [pose, pose])),
                ("waypoint 1", lambda: cd.find_clearance_of_body(spheres, "far", [pose, 2 * np.array(pose)])),
                ("1 poses for 2", lambda: cd.find_clearance_of_body(spheres, "far", [pose, pose], bodies=[pose]))):
            with self.subTest(what=what):
                with self.assertRaises(cd.Error) as caught:
                    call()
                self.assertIn(what, str(caught.exception))
                self.assertTrue(caught.exception.remedy)


if __name__ == "__main__":
    unittest.main()
