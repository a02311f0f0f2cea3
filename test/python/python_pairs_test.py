#!/usr/bin/env python3
"""Bodies and pairs in Python, beside closed forms and beside distance_query."""
import csv
import gc
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import concave_distance as cd
import numpy as np

MESHES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "meshes", "thesis")


def random_poses(count, reach):
    """(n, 7) and the same as (n, 4, 4), by the textbook's formula."""
    random = np.random.default_rng(7)
    q = random.normal(size=(count, 4))
    q /= np.linalg.norm(q, axis=1)[:, None]
    positions = random.uniform(-reach, reach, (count, 3))
    x, y, z, w = q.T
    matrices = np.zeros((count, 4, 4))
    matrices[:, :3, :3] = np.moveaxis(np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]), 2, 0)
    matrices[:, :3, 3] = positions
    matrices[:, 3, 3] = 1.0
    return np.c_[positions, q], matrices


def insertion():
    return [cd.load_body(os.path.join(MESHES, name)) for name in ("fixture.stl", "battery.stl")]


class Bodies(unittest.TestCase):
    def test_primitives_have_the_measures_of_closed_forms(self):
        box = cd.make_box((1, 2, 3))
        self.assertAlmostEqual(box.volume, 6.0)
        self.assertAlmostEqual(box.area, 22.0)
        self.assertAlmostEqual(box.diameter, np.sqrt(14.0))
        self.assertEqual(box.shells, 1)
        self.assertAlmostEqual(cd.make_sphere(0.5).volume, np.pi / 6)
        self.assertAlmostEqual(cd.make_cylinder(0.5, 2.0).volume, np.pi / 2)
        self.assertAlmostEqual(cd.make_capsule(0.5, 2.0).volume, np.pi / 2 + np.pi / 6)

    def test_triangles_are_repaired(self):
        box = cd.make_box((1, 2, 3))
        soup = box.vertices[box.triangles.ravel()]
        corners = np.arange(len(soup)).reshape(-1, 3)
        corners[0] = corners[0, ::-1]
        body = cd.make_body(soup, corners, "soup")
        self.assertEqual(body.name, "soup")
        self.assertEqual(len(body.vertices), 8)
        self.assertEqual(body.repair.turned_triangles, 1)
        self.assertEqual(body.repair.vertices_in, 36)
        self.assertAlmostEqual(body.volume, 6.0)
        self.assertTrue(np.isnan(cd.make_body(soup, corners[:-1]).volume))

    def test_scale(self):
        path = os.path.join(MESHES, "battery.stl")
        whole, small = cd.load_body(path), cd.load_body(path, 0.1)
        self.assertAlmostEqual(small.volume, whole.volume * 1e-3, delta=1e-7 * whole.volume)

    def test_errors_say_where_what_and_remedy(self):
        box = cd.make_box((1, 1, 1))
        nodes, corners = np.zeros((3, 3)), [[0, 1, 3]]
        for where, what, call in (
                ("/nowhere.stl", "no such file", lambda: cd.load_body("/nowhere.stl")),
                ("box", "-1", lambda: cd.make_box((1, 1, -1))),
                ("triangles", "row 0", lambda: cd.make_body(nodes, corners)),
                ("vertices", "(n, 3)", lambda: cd.make_body([1, 2, 3], corners)),
                ("PairTracker", "'acuracy'", lambda: cd.PairTracker(box, box, acuracy="nodes")),
                ("PairTracker.accuracy", "'exact'", lambda: cd.PairTracker(box, box, accuracy="exact")),
                ("PairTracker.accuracy", "ud800", lambda: cd.PairTracker(box, box, accuracy="\ud800")),
                ("PairTracker.seed", "-1", lambda: cd.PairTracker(box, box, seed=-1)),
                ("PairTracker.cutoff", "True", lambda: cd.PairTracker(box, box, cutoff=True)),
                ("PairTracker.hidden", "1", lambda: cd.PairTracker(box, box, hidden=1)),
                ("PairTracker.least_prominence", "None", lambda: cd.PairTracker(box, box, least_prominence=None)),
                ("margin_b", "larger than the body", lambda: cd.PairTracker(box, box, margin_b=5.0)),
                ("poses", "(3, 5)", lambda: cd.PairTracker(box, box).solve(np.zeros((3, 5)))),
                ("poses", "type", lambda: cd.PairTracker(box, box).solve("here")),
                ("poses", "type", lambda: cd.PairTracker(box, box).solve(np.eye(4) * 1j)),
                ("poses", "type", lambda: cd.PairTracker(box, box).solve(np.array([None] * 7))),
                ("poses", "type", lambda: cd.PairTracker(box, box).solve(None)),
                ("poses", "type", lambda: cd.solve_each(box, box, np.ones((1, 7), dtype="datetime64[s]"))),
                ("poses", "(1, 1, 1, 7)", lambda: cd.PairTracker(box, box).solve(np.zeros((1, 1, 1, 7)))),
                ("poses", "()", lambda: cd.PairTracker(box, box).solve(7.0)),
                ("times", "not finite", lambda: cd.PairTracker(box, box).update(np.zeros((1, 7)), [np.nan])),
                ("times", "1 for 2", lambda: cd.PairTracker(box, box).update(np.zeros((2, 7)), [0.0]))):
            with self.subTest(where=where, what=what):
                with self.assertRaises(cd.Error) as caught:
                    call()
                self.assertEqual(caught.exception.where, where)
                self.assertIn(what, caught.exception.what)
                self.assertTrue(caught.exception.remedy)
                self.assertIn(caught.exception.remedy, str(caught.exception))


class Pairs(unittest.TestCase):
    def test_spheres_have_the_distance_of_their_centres(self):
        quaternions, matrices = random_poses(200, 2.0)
        tracker = cd.PairTracker(cd.make_sphere(0.3), cd.make_sphere(0.2))
        expected = np.maximum(np.linalg.norm(quaternions[:, :3], axis=1) - 0.5, 0.0)
        for answers in (tracker.solve(quaternions), tracker.solve(matrices), tracker.update(matrices),
                        tracker.solve(np.asfortranarray(matrices)), tracker.solve(matrices.tolist()),
                        tracker.solve(np.repeat(quaternions, 2, axis=1)[:, ::2]), tracker.solve(quaternions.astype(">f8")),
                        cd.solve_each(tracker.body_a, tracker.body_b, quaternions, threads=2)):
            self.assertEqual(len(answers), 200)
            np.testing.assert_allclose(answers.rows["distance"], expected, atol=1e-12)
            apart = answers.rows["status"] == cd.Status.OK
            np.testing.assert_array_equal(apart, expected > 0.0)
            directions = quaternions[apart, :3] / np.linalg.norm(quaternions[apart, :3], axis=1)[:, None]
            np.testing.assert_allclose(answers.rows["point_a"][apart], 0.3 * directions, atol=1e-9)
            np.testing.assert_allclose(answers.rows["normal"][apart], directions, atol=1e-9)

    def test_what_is_no_pose_spoils_no_other(self):
        poses = np.tile([2.0, 0, 0, 0, 0, 0, 1], (4, 1))
        poses[1, 6] = 2.0
        poses[2, 0] = np.nan
        answers = cd.PairTracker(cd.make_sphere(0.3), cd.make_sphere(0.2)).update(poses)
        status = [cd.Status(code).name for code in answers.rows["status"]]
        self.assertEqual(status, ["OK", "INVALID_POSE", "INVALID_POSE", "OK"])
        np.testing.assert_array_equal(np.isnan(answers.rows["distance"]), [False, True, True, False])
        transposed = np.eye(4)
        transposed[3, 0] = 2.0
        tracker = cd.PairTracker(cd.make_sphere(0.3), cd.make_sphere(0.2))
        self.assertEqual(tracker.solve(transposed).rows["status"][0], cd.Status.INVALID_POSE)
        for none in (tracker.solve(np.zeros((0, 7))), tracker.update(np.zeros((0, 4, 4)), []),
                     cd.solve_each(tracker.body_a, tracker.body_b, np.zeros((0, 7)))):
            self.assertEqual((len(none), none.niches.size, none.niche_offsets.tolist()), (0, 0, [0]))

    def test_a_motion_keeps_ids_and_has_speeds(self):
        poses = np.tile(np.eye(4), (5, 1, 1))
        poses[:, 0, 3] = 2.0 - 0.1 * np.arange(5)
        tracker = cd.PairTracker(cd.make_sphere(0.3), cd.make_sphere(0.2))
        answers = tracker.update(poses, 0.5 * np.arange(5))
        np.testing.assert_allclose(answers.rows["closing_speed"][1:], 0.2, atol=1e-9)
        self.assertEqual(set(answers.niches["id"]), {1})
        self.assertEqual(answers.niches["id"].size, 5)
        self.assertTrue(np.isnan(tracker.update(poses).rows["closing_speed"][1]))
        tracker.restart()
        self.assertEqual(tracker.update(poses[0]).niches["id"][0], 1)

    def test_margins_are_subtracted(self):
        pose = [0.6, 0, 0, 0, 0, 0, 1]
        tracker = cd.PairTracker(cd.make_sphere(0.3), cd.make_sphere(0.2), margin_a=0.02, margin_b=0.03)
        self.assertAlmostEqual(tracker.solve(pose).rows["distance"][0], 0.05)
        tracker.set_parameters(margin_b=0.1)
        row = tracker.solve(pose).rows[0]
        self.assertAlmostEqual(row["signed_distance"], -0.02)
        self.assertEqual(row["status"], cd.Status.PENETRATING)
        with self.assertRaises(cd.Error):
            tracker.set_parameters(margin_a=0.0, margin_b=-1.0)
        self.assertEqual(tracker.parameters["margin_a"], 0.02)
        self.assertEqual(tracker.parameters["margin_b"], 0.1)

    def test_parameters_come_back_as_they_were_given(self):
        box = cd.make_box((1, 1, 1))
        given = {"accuracy": "refined", "cutoff": 0.5, "seed": 2**64 - 1, "hidden": True, "time_budget": None}
        self.assertEqual({name: cd.PairTracker(box, box, **given).parameters[name] for name in given}, given)
        with_numpy = cd.PairTracker(box, box, cutoff=np.float32(0.5), seed=np.int32(3), hidden=np.bool_(True))
        self.assertEqual([with_numpy.parameters[name] for name in ("cutoff", "seed", "hidden")], [0.5, 3, True])
        self.assertIsNone(cd.PairTracker(box, box, cutoff=np.inf).parameters["cutoff"])
        self.assertIsNone(cd.PairTracker(box, box, cutoff="none").parameters["cutoff"])

    def test_bodies_outlive_their_names(self):
        bodies = [cd.make_sphere(0.3), cd.make_sphere(0.2)]
        tracker = cd.PairTracker(*bodies)
        repair = tracker.body_a.repair
        results = []
        poses = random_poses(2000, 2.0)[0]
        thread = threading.Thread(target=lambda solve: results.append(solve(poses)), args=(tracker.solve,))
        thread.start()
        del bodies, tracker
        gc.collect()
        thread.join()
        self.assertEqual(len(results[0]), 2000)
        self.assertEqual(repair.shells, 1)

    def test_arrays_outlive_their_answers(self):
        tracker = cd.PairTracker(cd.make_sphere(0.3), cd.make_sphere(0.2))
        rows = tracker.solve(random_poses(1000, 2.0)[0]).rows["distance"]
        before = rows.copy()
        gc.collect()
        for _ in range(10):
            tracker.solve(random_poses(1000, 3.0)[0])
        np.testing.assert_array_equal(rows, before)


class Niches(unittest.TestCase):
    def test_what_a_niche_has(self):
        # A cube above a plate in parallel, then tilted about y: a patch, then an edge.
        tracker = cd.PairTracker(cd.make_box((1, 1, 0.1)), cd.make_box((0.2, 0.2, 0.2)))
        angle = 0.5 * np.arcsin(0.3)
        answers = tracker.solve([[0, 0, 0.3, 0, 0, 0, 1], [0, 0, 0.3, 0, np.sin(angle), 0, np.cos(angle)]])
        nearest = answers.niches[answers.niche_offsets[:2]]
        self.assertEqual(nearest["kind"].tolist(), [cd.NicheKind.PATCH, cd.NicheKind.SEGMENT])
        np.testing.assert_allclose(nearest["extent"], [0.2 * np.sqrt(2.0), 0.2], atol=1e-6)
        np.testing.assert_array_equal(nearest["distance"], answers.rows["distance"])
        self.assertEqual(set(answers.niches["outward"]), {cd.Outwardness.OUTWARD})
        self.assertTrue(np.all(answers.niches["visible"]))
        self.assertLessEqual(set(answers.niches["origin"]), set(cd.NicheOrigin))
        self.assertEqual(set(answers.niches["signed_state"]), {cd.SignedState.NOT_ASKED})
        np.testing.assert_allclose(nearest["normal"], [[0, 0, 1]] * 2, atol=1e-9)

    def test_origin_and_birth_over_cycles(self):
        poses = np.tile([0.0, 0, 0.3, 0, 0, 0, 1], (5, 1))
        poses[:, 0] = 0.01 * np.arange(5)
        answers = cd.PairTracker(*insertion()).update(poses)
        seen = set()
        for index in range(5):
            for niche in answers.niches_of(index):
                self.assertEqual(niche["origin"] == cd.NicheOrigin.INHERITED, niche["id"] in seen)
            seen.update(answers.niches_of(index)["id"])
        self.assertGreater(len(seen), 3)
        self.assertGreater(len(set(answers.niches["birth_cycle"])), 0)
        self.assertTrue(np.all(np.diff(np.unique(answers.niches[["id", "birth_cycle"]])["id"]) > 0))

    def test_one_signed_value_through_contact(self):
        cubes = [cd.make_box((1, 1, 1)), cd.make_box((0.4, 0.4, 0.4))]
        poses = np.tile([0.0, 0, 0, 0, 0, 0, 1], (9, 1))
        poses[:, 0] = 0.9 - 0.05 * np.arange(9)
        tracker = cd.PairTracker(*cubes, signed_values=True)
        answers = tracker.update(poses)
        nearest = answers.niches[answers.niche_offsets[:-1]]
        np.testing.assert_allclose(nearest["signed_distance"], poses[:, 0] - 0.7, atol=1e-8)
        self.assertEqual(set(nearest["signed_state"]), {cd.SignedState.KNOWN})
        np.testing.assert_allclose(nearest["signed_gradient"], [[1, 0, 0]] * 9, atol=1e-6)
        np.testing.assert_array_equal(answers.rows["distance"][poses[:, 0] < 0.69], 0.0)

    def test_prominence_beside_the_least(self):
        answers = cd.PairTracker(*insertion(), prominence_limit=1.0).solve([0.0, 0, 0.3, 0, 0, 0, 1])
        self.assertEqual(answers.niches["prominence"][0], np.inf)
        measured = answers.niches["prominence"][1:]
        self.assertTrue(np.all(measured[~np.isnan(measured)] >= 0.01))
        self.assertTrue(np.any(~np.isnan(measured)))


class BesideTheTool(unittest.TestCase):
    def query(self, poses, *options):
        with tempfile.TemporaryDirectory() as folder:
            names = [os.path.join(folder, name) for name in ("poses.csv", "out.csv", "niches.csv")]
            with open(names[0], "w", encoding="utf-8") as file:
                file.write("t,x,y,z,qx,qy,qz,qw\n")
                for index, pose in enumerate(poses):
                    file.write(",".join([repr(0.1 * index)] + [repr(float(number)) for number in pose]) + "\n")
            subprocess.run([os.path.join(os.environ["CONCAVE_DISTANCE_PROGRAMS"], "distance_query"), "--mesh-a",
                            os.path.join(MESHES, "fixture.stl"), "--mesh-b", os.path.join(MESHES, "battery.stl"),
                            "--poses", names[0], "--output", names[1], "--niches-output", names[2], *options],
                           check=True, stderr=subprocess.DEVNULL)
            tables = []
            for name in names[1:]:
                with open(name, encoding="utf-8") as file:
                    tables.append(list(csv.DictReader(file)))
            return tables

    def test_answers_are_those_of_distance_query(self):
        poses = np.tile([0.0, 0, 0.3, 0, 0, 0, 1], (8, 1))
        poses[:, 2] -= 0.02 * np.arange(8)
        for tracking in (False, True):
            rows, niches = self.query(poses, *(["--tracking"] if tracking else []))
            tracker = cd.PairTracker(*insertion(), name="distance_query", largest_niche_count=1000)
            answers = tracker.update(poses, 0.1 * np.arange(8)) if tracking else tracker.solve(poses)
            self.assertEqual([float(row["distance"]) for row in rows], answers.rows["distance"].tolist())
            self.assertEqual([int(row["niche_count"]) for row in rows], np.diff(answers.niche_offsets).tolist())
            self.assertEqual([float(row["distance"]) for row in niches], answers.niches["distance"].tolist())
            self.assertGreater(len(niches), 50)
            for column in ("bx", "by", "bz"):
                self.assertEqual([float(row[column]) for row in niches],
                                 answers.niches["point_b"][:, "xyz".index(column[1])].tolist())
            if tracking:
                self.assertEqual([int(row["niche"]) for row in niches], answers.niches["id"].tolist())
            for index in range(8):
                listed = answers.niches_of(index)["distance"]
                self.assertEqual(listed[0], answers.rows["distance"][index])
                self.assertTrue(np.all(np.diff(listed) >= 0.0))
            self.assertEqual(answers.niches_of(-1).size, answers.niche_offsets[8] - answers.niche_offsets[7])
            with self.assertRaises(IndexError):
                answers.niches_of(8)


class Threads(unittest.TestCase):
    def test_the_lock_is_released_while_poses_are_solved(self):
        tracker = cd.PairTracker(*insertion())
        poses = np.tile([0.0, 0, 0.3, 0, 0, 0, 1], (50, 1))
        poses[:, 2] -= 0.001 * np.arange(50)
        states = []
        between = 0
        # Without a forced change of threads, this one runs only while the other has given up the lock.
        interval = sys.getswitchinterval()
        sys.setswitchinterval(1000.0)
        try:
            def work():
                states.append("begun")
                tracker.solve(poses)
                states.append("ended")
            thread = threading.Thread(target=work)
            thread.start()
            while states[-1:] != ["ended"]:
                between += states[-1:] == ["begun"]
                time.sleep(1e-4)
            thread.join()
        finally:
            sys.setswitchinterval(interval)
        self.assertGreater(between, 0)

    def test_calls_from_several_threads_wait_for_each_other(self):
        tracker = cd.PairTracker(cd.make_sphere(0.3), cd.make_sphere(0.2))
        poses = random_poses(2000, 2.0)[0]
        expected = tracker.solve(poses).rows["distance"]
        results = []
        threads = [threading.Thread(target=lambda: results.append(tracker.solve(poses).rows["distance"]))
                   for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(results), 4)
        for result in results:
            np.testing.assert_array_equal(result, expected)

    def test_a_signal_ends_a_call(self):
        class Alarm(Exception):
            pass

        def ring(*_):
            raise Alarm

        tracker = cd.PairTracker(*insertion())
        poses = np.tile([0.0, 0, 0.3, 0, 0, 0, 1], (100000, 1))  # takes many minutes
        moving = poses + np.outer(np.random.default_rng(3).random(100000), [0, 0, 1e-3, 0, 0, 0, 0])
        for call in (lambda: tracker.solve(poses), lambda: tracker.update(moving),
                     lambda: cd.solve_each(tracker.body_a, tracker.body_b, poses)):
            before = signal.signal(signal.SIGALRM, ring)
            try:
                signal.setitimer(signal.ITIMER_REAL, 0.3)
                with self.assertRaises(Alarm):
                    call()
            finally:
                signal.setitimer(signal.ITIMER_REAL, 0.0)
                signal.signal(signal.SIGALRM, before)
            self.assertEqual(tracker.solve(poses[:1]).rows["status"][0], cd.Status.OK)

    def test_an_interrupt_ends_a_call(self):
        tracker = cd.PairTracker(*insertion())
        timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            tracker.solve(np.tile([0.0, 0, 0.3, 0, 0, 0, 1], (100000, 1)))
        timer.join()

    def test_a_program_may_end_while_threads_solve(self):
        """As one with callbacks of ROS does: its threads do not hold it up."""
        for call in ("tracker.solve(poses)", "tracker.update(poses)", "cd.solve_each(box, ball, poses)"):
            program = """
import threading
import concave_distance as cd
import numpy as np
box, ball = cd.make_box((1, 1, 1)), cd.make_sphere(0.5)
poses = np.tile([2.0, 0, 0, 0, 0, 0, 1], (1000000, 1))
poses[:, 1] = np.linspace(0, 1, 1000000)
began = threading.Event()
def solve():
    tracker = cd.PairTracker(box, ball)
    began.set()
    %s
threading.Thread(target=solve, daemon=True).start()
began.wait()
""" % call
            ended = subprocess.run([sys.executable, "-c", program], stderr=subprocess.PIPE, timeout=120, check=False)
            self.assertEqual((ended.returncode, ended.stderr), (0, b""), call)


if __name__ == "__main__":
    unittest.main()
