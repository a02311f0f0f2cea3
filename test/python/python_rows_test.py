#!/usr/bin/env python3
"""Constraint rows in Python, beside closed forms and differences of distances."""
import os
import tempfile
import threading
import unittest

import concave_distance as cd
import numpy as np
from slide_robot import SLIDE

PACKAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")

# The robot stands above an obstacle that others move.
CELL = """
robots:
  - description: robot_description
bodies:
  - {name: obstacle, frame: world, sphere: {radius: 0.2}}
pairs:
  - {between: [ball, obstacle], name: to_obstacle}
"""


def load_slide():
    with tempfile.NamedTemporaryFile("w", suffix=".urdf") as file:
        file.write(SLIDE)
        file.flush()
        return cd.load_robot(file.name, strict=True)


def load_cell():
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(CELL)
        file.flush()
        return cd.load_scene(file.name, strict=True, descriptions={"robot_description": SLIDE})


def load_wam():
    return cd.load_robot(os.path.join(PACKAGE, "urdf", "wam.urdf"), mesh_folders=[os.path.join(PACKAGE, "meshes")],
                         strict=True)


class Rows(unittest.TestCase):
    def test_a_slide_has_the_row_of_the_closed_form(self):
        robot = load_slide()
        self.assertEqual(robot.robot_names, ["slide"])
        self.assertEqual(robot.velocity_names, ["slide"])
        tracker, constraints = cd.SceneTracker(robot), cd.ConstraintRows(robot, distance=2.0, capacity=4)
        for step, x in enumerate((0.3, 0.2, -0.1)):
            tracker.update(robot.poses_of_bodies([x]), step)
            made = constraints.update(tracker, [x])
            self.assertEqual(len(made), 4)
            self.assertEqual(made.jacobian.shape, (4, 1))
            self.assertEqual(made.pairs, ["base/ball", "", "", ""])
            self.assertEqual(made.rows["state"].tolist(), [cd.SlotState.USED] + [cd.SlotState.FREE] * 3)
            self.assertEqual(made.overflow, 0)
            row, length = made.rows[0], np.hypot(x, 0.7)
            direction = np.array([x, 0, 0.7]) / length
            self.assertAlmostEqual(row["value"], length - 0.15, delta=1e-9)
            self.assertLessEqual(row["lower_bound"], row["value"])
            self.assertAlmostEqual(made.jacobian[0, 0], x / length, delta=1e-9)
            self.assertEqual([robot.body_names[row[body]] for body in ("body_a", "body_b")], ["base", "ball"])
            self.assertEqual((row["age"], row["niche_id"], row["is_overlapping"]), (step, 1, False))
            np.testing.assert_allclose(row["normal"], direction, atol=1e-9)
            np.testing.assert_allclose(row["point_a"], 0.1 * direction, atol=1e-9)
            np.testing.assert_allclose(row["point_b"], (length - 0.05) * direction, atol=1e-9)
            np.testing.assert_allclose(row["point_b_in_frame"], -0.05 * direction, atol=1e-9)
            self.assertFalse(np.any(made.jacobian[1:]))
            self.assertTrue(np.all(np.isnan(made.rows["value"][1:])))

    def test_other_bodies_and_roots_make_the_drift(self):
        scene = load_cell()
        tracker, constraints = cd.SceneTracker(scene), cd.ConstraintRows(scene, distance=2.0, capacity=2)
        obstacle = scene.body_names.index("obstacle")
        for step in range(3):
            root = np.eye(4)[None].copy()
            root[0, 0, 3] = 0.02 * step
            poses = scene.poses_of_bodies([0.0], root)
            poses[obstacle, 0, 3] = 2.0 - 0.05 * step
            poses[obstacle, 2, 3] = 0.7
            answers = tracker.update(poses, 0.1 * step)
            self.assertEqual(answers.pairs, ["to_obstacle"])
            self.assertEqual(answers.bodies.tolist(), [[scene.body_names.index("ball"), obstacle]])
            row = constraints.update(tracker, [0.0], root)
            self.assertAlmostEqual(row.rows["value"][0], 1.75 - 0.07 * step)
            self.assertAlmostEqual(row.jacobian[0, 0], -1.0)
            if step == 0:
                self.assertTrue(np.isnan(row.rows["drift"][0]))
            else:
                self.assertAlmostEqual(row.rows["drift"][0], 0.7)
                self.assertAlmostEqual(row.rows["drift_a"][0], 0.2)
                self.assertAlmostEqual(row.rows["drift_b"][0], 0.5)

    def test_rows_are_the_differences_of_distances(self):
        robot = load_wam()
        tracker, constraints = cd.SceneTracker(robot), cd.ConstraintRows(robot, distance=0.3, capacity=256)
        random = np.random.default_rng(11)
        step, time, compared, at_changes = 1e-6, 0.0, 0, 0

        def cycle(positions):
            nonlocal time
            time += 1.0
            answers = tracker.update(robot.poses_of_bodies(positions), time)
            return {(pair, niche["id"]): niche for index, pair in enumerate(answers.pairs)
                    for niche in answers.niches_of(index)}

        for _ in range(6):
            positions = random.uniform(-1.0, 1.0, len(robot.position_names))
            here = cycle(positions)
            made = constraints.update(tracker, positions)
            self.assertEqual(made.overflow, 0)
            moved = [(cycle(positions + offset), cycle(positions - offset))
                     for offset in step * np.eye(len(positions))]
            for slot in np.flatnonzero(made.rows["state"] == cd.SlotState.USED):
                row = made.rows[slot]
                key = (made.pairs[slot], row["niche_id"])
                if here[key]["kind"] != cd.NicheKind.POINT or row["value"] != here[key]["signed_distance"]:
                    continue  # rows of corners
                for gradient, (after, before) in zip(made.jacobian[slot], moved):
                    if key not in after or key not in before:
                        continue
                    ahead = (after[key]["distance"] - row["value"]) / step
                    behind = (row["value"] - before[key]["distance"]) / step
                    if abs(ahead - behind) > 1e-4:
                        at_changes += 1  # the niche changes its features there
                        continue
                    compared += 1
                    self.assertAlmostEqual(gradient, 0.5 * (ahead + behind), delta=1e-6)
        self.assertGreater(compared, 200)
        self.assertLess(at_changes, 0.05 * compared)

    def test_slots_are_kept_while_niches_live(self):
        robot = load_wam()
        tracker, constraints = cd.SceneTracker(robot), cd.ConstraintRows(robot, distance=0.2, capacity=128)
        positions = np.tile(robot.rest_positions, (40, 1)) + 0.02 * np.arange(40)[:, None]
        before, kept, begun = {}, 0, 0
        for step, poses in enumerate(robot.poses_of_bodies(positions)):
            tracker.update(poses, 0.02 * step)
            made = constraints.update(tracker, positions[step])
            now = {slot: (made.pairs[slot], made.rows["niche_id"][slot], made.rows["age"][slot])
                   for slot in np.flatnonzero(made.rows["state"] == cd.SlotState.USED)}
            for slot, (pair, niche, age) in now.items():
                if age == 0:
                    begun += 1
                    continue
                self.assertEqual(before[slot], (pair, niche, age - 1))
                kept += 1
            before = now
        self.assertGreater(kept, 5 * begun)
        self.assertGreater(begun, 0)
        constraints.reset()
        made = constraints.update(tracker, positions[-1])
        values = made.rows["value"][made.rows["state"] == cd.SlotState.USED]
        self.assertTrue(np.all(np.diff(values) >= 0.0))
        self.assertFalse(np.any(made.rows["age"]))

    def test_the_farthest_have_no_slot(self):
        robot = load_wam()
        tracker = cd.SceneTracker(robot)
        tracker.update(robot.poses_of_bodies(robot.rest_positions), 0.0)
        every = cd.ConstraintRows(robot, distance=0.3, capacity=500).update(tracker, robot.rest_positions)
        nearest = cd.ConstraintRows(robot, distance=0.3, capacity=2).update(tracker, robot.rest_positions)
        values = np.sort(every.rows["value"][every.rows["state"] == cd.SlotState.USED])
        self.assertGreater(len(values), 2)
        self.assertEqual(nearest.overflow, len(values) - 2)
        left = nearest.unlisted[nearest.unlisted["reason"] == cd.UnlistedReason.NO_SLOT]
        self.assertGreater(left.size, 0)
        self.assertEqual(nearest.reach.shape, (nearest.unlisted.size, len(robot.velocity_names)))
        self.assertTrue(np.all(nearest.reach >= 0.0))
        self.assertFalse(np.any(every.unlisted["reason"] == cd.UnlistedReason.NO_SLOT))
        np.testing.assert_array_equal(np.sort(nearest.rows["value"]), values[:2])

    def test_errors(self):
        robot, other = load_slide(), load_slide()
        tracker = cd.SceneTracker(robot)
        tracker.update(robot.poses_of_bodies([0.1]), 0.0)
        rows = cd.ConstraintRows(robot)
        turned = np.eye(4)[None] * 2.0
        for where, what, call in (
                ("constraint_distance", "-1", lambda: cd.ConstraintRows(robot, distance=-1.0)),
                ("constraint_distance", "nan", lambda: cd.ConstraintRows(robot, distance=np.nan)),
                ("constraint_capacity", "0", lambda: cd.ConstraintRows(robot, capacity=0)),
                ("tracker", "another scene", lambda: cd.ConstraintRows(other).update(tracker, [0.1])),
                ("tracker", "no cycle", lambda: rows.update(cd.SceneTracker(robot), [0.1])),
                ("positions", "'carriage'", lambda: rows.update(tracker, [0.2])),
                ("positions", "(2,)", lambda: rows.update(tracker, [0.1, 0.2])),
                ("positions", "several", lambda: rows.update(tracker, [[0.1], [0.2]])),
                ("slide", "finite", lambda: rows.update(tracker, [np.nan])),
                ("roots", "2 for 1", lambda: rows.update(tracker, [0.1], np.tile(np.eye(4), (2, 1, 1)))),
                ("roots", "'slide'", lambda: rows.update(tracker, [0.1], turned)),
                ("positions", "type", lambda: robot.poses_of_bodies(["near"]))):
            with self.subTest(where=where, what=what):
                with self.assertRaises(cd.Error) as caught:
                    call()
                self.assertIn(where, caught.exception.where)
                self.assertIn(what, str(caught.exception))
                self.assertTrue(caught.exception.remedy)
        self.assertEqual(rows.update(tracker, [0.1]).rows["state"].max(), cd.SlotState.FREE)

    def test_rows_and_cycles_in_threads(self):
        robot = load_slide()
        tracker, constraints = cd.SceneTracker(robot), cd.ConstraintRows(robot, distance=2.0, capacity=2)
        poses = robot.poses_of_bodies([0.3])
        tracker.update(poses, 0.0)
        made, problems = [], []

        def work(call):
            try:
                for index in range(200):
                    made.append(call(index))
            except Exception as problem:  # noqa: B902  (whatever it is, the test reports it)
                problems.append(problem)

        threads = [threading.Thread(target=work, args=(lambda index: tracker.update(poses, 1.0 + index),)),
                   threading.Thread(target=work, args=(lambda _: constraints.update(tracker, [0.3]),)),
                   threading.Thread(target=work, args=(lambda _: constraints.update(tracker, [0.3]),))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(problems, [])
        expected = np.hypot(0.3, 0.7) - 0.15
        values = [one.rows["value"][0] for one in made if isinstance(one, cd.Constraints)]
        np.testing.assert_allclose(values, np.full(400, expected), atol=1e-9)


if __name__ == "__main__":
    unittest.main()
