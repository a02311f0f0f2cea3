#!/usr/bin/env python3
"""Scenes and robots in Python, beside closed forms."""
import os
import signal
import tempfile
import unittest

import concave_distance as cd
import numpy as np
from slide_robot import SLIDE

SCENE = """
bodies:
  - {name: near, sphere: {radius: 0.3}}
  - {name: far, sphere: {radius: 0.2}}
pairs:
  - {between: [near, far], name: spheres}
"""


class Scenes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, text):
        path = os.path.join(self.folder.name, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def test_a_scene_file(self):
        scene = cd.load_scene(self.write("scene.yaml", SCENE), strict=True)
        self.assertEqual(scene.body_names, ["near", "far"])
        self.assertEqual(scene.problems, [])
        tracker = cd.SceneTracker(scene, threads=1)
        poses = np.array([[0.0, 0, 0, 0, 0, 0, 1], [2.0, 0, 0, 0, 0, 0, 1]])
        for step in range(3):
            poses[1, 0] = 2.0 - 0.1 * step
            answers = tracker.update(poses, 0.5 * step)
            self.assertEqual(answers.pairs, ["spheres"])
            self.assertEqual(answers.states[0], cd.PairState.SOLVED)
            self.assertAlmostEqual(answers.rows["distance"][0], 1.5 - 0.1 * step)
            self.assertEqual(answers.niches_of(0)["id"].tolist(), [1])
        self.assertAlmostEqual(answers.rows["closing_speed"][0], 0.2)
        self.assertEqual(tracker.update(poses, 2.0, niches_wanted=False).niches.size, 0)
        poses[0] = np.nan
        answers = tracker.update(poses, 3.0)
        self.assertEqual(answers.states[0], cd.PairState.NOT_LOCATED)
        self.assertTrue(np.isnan(answers.rows["distance"][0]))
        poses[0] = [0.5, 0, 0, 0, 0, 0, 1]
        for time in (3.0, 1.0, np.nan):
            with self.assertRaises(cd.Error) as caught:
                tracker.update(poses, time)
            self.assertEqual(caught.exception.where, "time")
        tracker.restart()
        self.assertAlmostEqual(tracker.update(poses, 1.0).rows["distance"][0], 0.8)

    def test_a_cutoff_gives_a_bound(self):
        scene = cd.load_scene(self.write("scene.yaml", SCENE), cutoff=1.0)
        answers = cd.SceneTracker(scene).update([[0.0, 0, 0, 0, 0, 0, 1], [5.0, 0, 0, 0, 0, 0, 1]], 0.0)
        self.assertEqual(answers.states[0], cd.PairState.BEYOND_CUTOFF)
        self.assertGreater(answers.bounds[0], 1.0)
        self.assertLessEqual(answers.bounds[0], 4.5)

    def test_pairs_of_bodies_that_moved_are_solved(self):
        scene = cd.load_scene(self.write("scene.yaml", SCENE), strict=True)
        self.assertEqual(scene.body_frames, ["near", "far"])
        np.testing.assert_array_equal(scene.poses_in_frames, np.tile(np.eye(4), (2, 1, 1)))
        tracker = cd.SceneTracker(scene, threads=1)
        poses = np.array([[0.0, 0, 0, 0, 0, 0, 1], [2.0, 0, 0, 0, 0, 0, 1]])
        self.assertEqual(tracker.update(poses, 0.0, moved=[True, False]).pairs, ["spheres"])
        poses[1, 0] = 1.9
        self.assertEqual(tracker.update(poses, 0.5, moved=[False, False]).pairs, [])
        answers = tracker.update(poses, 1.0, moved=[False, True])
        self.assertAlmostEqual(answers.rows["closing_speed"][0], 0.1)
        self.assertEqual(answers.rows["accuracy"][0], 2)
        self.assertEqual((answers.rows["triangle_a"][0], answers.warnings[0], answers.beyond), (-1, 0, 0))
        poses[0] = np.nan
        self.assertEqual(tracker.update(poses, 2.0, moved=[False, True]).pairs, [], "it waits for the other pose")
        self.assertEqual(tracker.update(poses, 3.0, moved=[True, True]).states[0], cd.PairState.NOT_LOCATED)
        with self.assertRaises(cd.Error) as caught:
            tracker.update(poses, 4.0, moved=[True])
        self.assertEqual(caught.exception.where, "moved")

    def test_pairs_that_are_named_are_solved_without_budgets(self):
        scene = cd.load_scene(self.write("scene.yaml", "defaults: {time_budget: 1e-9}\n" + SCENE), warning_distance=2.0)
        poses = [[0.0, 0, 0, 0, 0, 0, 1], [2.0, 0, 0, 0, 0, 0, 1]]
        answers = cd.SceneTracker(scene, pairs=["sph*"], time_budgets=False).update(poses, 0.0)
        self.assertEqual((answers.rows["status"][0], answers.warnings[0]), (cd.Status.OK, 1))
        answers = cd.SceneTracker(scene, pairs=["other"]).update(poses, 0.0)
        self.assertEqual(answers.states[0], cd.PairState.NOT_WATCHED)

    def test_names_of_descriptions(self):
        path = self.write("robots.yaml", "robots:\n  - description: one\n  - {description: two, semantic_description: three, name: r}\n")
        self.assertEqual(cd.descriptions_of_scene(path), ["one", "two", "three"])

    def test_joint_positions(self):
        robot = cd.load_robot(self.write("robot.urdf", SLIDE), strict=True)
        self.assertEqual(robot.position_names, ["slide"])
        self.assertEqual(robot.rest_positions.tolist(), [0.0])
        positions = np.linspace(-1.0, 1.0, 21)[:, None]
        poses = robot.poses_of_bodies(positions)
        self.assertEqual(poses.shape, (21, len(robot.body_names), 4, 4))
        np.testing.assert_array_equal(robot.poses_of_bodies(positions[3]), poses[3])
        ball = robot.body_names.index("ball")
        np.testing.assert_allclose(poses[:, ball, :3, 3], np.c_[positions, 0 * positions, 0 * positions + 0.7])
        tracker = cd.SceneTracker(robot)
        for step, (position, cycle) in enumerate(zip(positions[:, 0], poses)):
            answers = tracker.update(cycle, step)
            self.assertEqual(answers.pairs, ["base/ball"])
            self.assertAlmostEqual(answers.rows["distance"][0], np.hypot(position, 0.7) - 0.15)

    def test_the_nearest_of_many_joint_positions(self):
        package = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
        robot = cd.load_robot(os.path.join(package, "urdf", "kr5.urdf"), strict=True,
                              mesh_folders=[os.path.join(package, "meshes")])
        positions = np.random.default_rng(5).uniform(-1.5, 1.5, (100, len(robot.position_names)))
        poses = robot.poses_of_bodies(positions)
        tracker, one_by_one = cd.SceneTracker(robot), cd.SceneTracker(robot)
        rows = tracker.nearest(poses)
        self.assertEqual(rows.shape, (100,))
        for step, row in enumerate(rows):
            answers = one_by_one.update(poses[step], step, niches_wanted=False)
            least = np.nanmin(answers.rows["distance"])
            self.assertAlmostEqual(row["distance"], least, delta=1e-12)
            self.assertTrue(row["is_minimum"])
            self.assertLessEqual(row["lower_bound"], least)
            self.assertGreaterEqual(row["lower_bound"], least - 1e-9)
            if least == 0.0:
                self.assertEqual(row["status"], cd.Status.PENETRATING)
                continue
            pair = "/".join(robot.body_names[row[body]] for body in ("body_a", "body_b"))
            self.assertAlmostEqual(answers.rows["distance"][answers.pairs.index(pair)], least, delta=1e-12)
            self.assertAlmostEqual(np.linalg.norm(row["point_b"] - row["point_a"]), least, delta=1e-9)
            np.testing.assert_allclose(row["point_a"] + least * row["normal"], row["point_b"], atol=1e-7)
        self.assertGreater(np.count_nonzero(rows["distance"]), 20)
        poses[3, 1] = np.nan
        unknown = tracker.nearest(poses[:4])
        self.assertEqual(unknown["is_minimum"].tolist()[:3], [True] * 3)
        self.assertTrue(unknown["distance"][3] == 0.0 or not unknown["is_minimum"][3])
        self.assertEqual(tracker.nearest(np.zeros((0, len(robot.body_names), 7))).size, 0)

    def test_the_nearest_beyond_a_cutoff_has_a_bound(self):
        scene = cd.load_scene(self.write("scene.yaml", SCENE), cutoff=1.0)
        row = cd.SceneTracker(scene).nearest([[[0.0, 0, 0, 0, 0, 0, 1], [5.0, 0, 0, 0, 0, 0, 1]]])[0]
        self.assertTrue(np.isnan(row["distance"]))
        self.assertTrue(1.0 < row["lower_bound"] <= 4.5)
        self.assertEqual((row["body_a"], row["is_minimum"]), (-1, False))

    def test_a_signal_ends_a_cycle(self):
        class Alarm(Exception):
            pass

        def ring(*_):
            raise Alarm

        meshes = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "meshes", "thesis")
        bodies = ["  - {{name: b{}, mesh: {}/{}.stl}}".format(index, meshes, ("fixture", "battery")[index % 2])
                  for index in range(40)]
        pairs = ["  - {{between: [b{}, b{}]}}".format(a, b) for a in range(40) for b in range(a)]
        text = "bodies:\n" + "\n".join(bodies) + "\npairs:\n" + "\n".join(pairs) + "\n"
        scene = cd.load_scene(self.write("many.yaml", text), strict=True)
        tracker = cd.SceneTracker(scene, threads=1)
        poses = np.tile([0.0, 0, 0, 0, 0, 0, 1], (40, 1))
        poses[:, :3] = 0.7 * np.argwhere(np.ones((4, 4, 3)))[:40]
        many = np.tile(poses, (1000, 1, 1))
        many[:, 0, 0] += 0.01 * np.arange(1000)
        before = signal.signal(signal.SIGALRM, ring)
        try:
            for time, call in enumerate((lambda: tracker.update(poses, 0.0), lambda: tracker.nearest(many))):
                signal.setitimer(signal.ITIMER_REAL, 0.15)
                with self.assertRaises(Alarm):
                    call()
                for again in (0.3, 0.6):
                    states = tracker.update(poses, time + again, niches_wanted=False).states
                    self.assertEqual(set(states), {cd.PairState.SOLVED})
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, before)

    def test_a_robot_of_visual_geometry(self):
        visual = self.write("visual.urdf", SLIDE.replace("collision>", "visual>"))
        bare = cd.load_robot(visual)
        self.assertEqual(bare.body_names, [])
        self.assertIn("set geometry to visual", bare.warnings[0])
        robot = cd.load_robot(visual, geometry="visual")
        self.assertEqual(robot.body_names, cd.load_robot(self.write("robot.urdf", SLIDE)).body_names)
        self.assertEqual(robot.warnings, [])

    def test_links_that_always_overlap_are_named_or_left_out(self):
        swallowing = self.write("swallowing.urdf", SLIDE.replace('radius="0.1"', 'radius="3"'))
        self.assertIn("or set skip_overlapping_pairs", cd.load_robot(swallowing).warnings[0])
        skipped = cd.load_robot(swallowing, skip_overlapping_pairs=True)
        self.assertEqual(skipped.warnings, [])

    def test_messages_name_keywords_of_python(self):
        text = SLIDE.replace('<sphere radius="0.1"/>', '<mesh filename="package://nowhere/box.stl"/>', 1)
        path = self.write("mesh.urdf", text)
        _, message = cd.load_robot(path).problems[0]
        self.assertIn("name the folder that holds the meshes in mesh_folders", message)
        with self.assertRaises(cd.Error) as caught:
            cd.load_robot(path, strict=True)
        self.assertIn("in mesh_folders", str(caught.exception))

    def test_messages_keep_paths_with_a_tilde(self):
        with self.assertRaises(cd.Error) as caught:
            cd.load_scene("~ann/cell.yaml")
        self.assertIn("~ann/cell.yaml", str(caught.exception))

    def test_none_is_no_scene(self):
        for make in (cd.SceneTracker, cd.ConstraintRows):
            with self.assertRaises(TypeError):
                make(None)

    def test_files_that_are_none(self):
        for path in ("/", "/dev/zero"):
            for load in (lambda: cd.load_robot(path), lambda: cd.load_robot(self.write("robot.urdf", SLIDE), path)):
                with self.assertRaises(cd.Error) as caught:
                    load()
                self.assertEqual(caught.exception.where, path)

    def test_errors(self):
        scene = cd.load_scene(self.write("scene.yaml", SCENE))
        robot = cd.load_robot(self.write("robot.urdf", SLIDE))
        wrong = self.write("wrong.yaml", SCENE.replace("radius: 0.3", "radios: 0.3"))
        no_pose = np.tile([0.0, 0, 0, 0, 0, 0, 1], (2, 1))
        no_pose[1, 6] = 3.0
        for where, what, call in (
                ("scene file", "nowhere.yaml", lambda: cd.load_scene("nowhere.yaml")),
                ("nowhere.urdf", "cannot be read", lambda: cd.load_robot("nowhere.urdf")),
                ("wrong.yaml", "'radius' is missing", lambda: cd.load_scene(wrong, strict=True)),
                ("geometry", "'both'", lambda: cd.load_robot(self.write("robot.urdf", SLIDE), geometry="both")),
                ("load_scene", "'margin_a'", lambda: cd.load_scene(wrong, margin_a=0.1)),
                ("poses", "1 for 2", lambda: cd.SceneTracker(scene).update(np.eye(4), 0.0)),
                ("poses", "'far'", lambda: cd.SceneTracker(scene).update(no_pose, 0.0)),
                ("poses", "'far'", lambda: cd.SceneTracker(scene).nearest(no_pose[None])),
                ("poses", "2 for 2", lambda: cd.SceneTracker(scene).nearest(no_pose)),
                ("poses", "(1, 1, 2, 7)", lambda: cd.SceneTracker(scene).nearest(no_pose[None, None])),
                ("positions", "(3, 2)", lambda: robot.poses_of_bodies(np.zeros((3, 2)))),
                ("", "finite", lambda: robot.poses_of_bodies([np.nan]))):
            with self.subTest(where=where, what=what):
                with self.assertRaises(cd.Error) as caught:
                    call()
                self.assertIn(where, caught.exception.where)
                self.assertIn(what, str(caught.exception))
                self.assertTrue(caught.exception.remedy)


if __name__ == "__main__":
    unittest.main()
