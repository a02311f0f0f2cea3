#!/usr/bin/env python3
"""Every function of the Python module with hostile values in the place of each argument: an answer, an Error with its texts or a
TypeError, and the interpreter goes on."""
import faulthandler
import os
import resource
import tempfile
import unittest

import concave_distance as cd
import numpy as np

LONGEST_MESSAGE = 200000
NAN, INF = float("nan"), float("inf")
POSE = np.array([2.0, 0, 0, 0, 0, 0, 1])


class Evil:
    """Every question to it raises."""

    def __array__(self, *_, **__):
        raise ValueError("evil")

    __float__ = __index__ = __str__ = __iter__ = __hash__ = __getitem__ = __bool__ = __array__

    def __len__(self):
        return 2**62


def many(count=3):
    return np.tile(POSE, (count, 1))


def values(folder, joints):
    numbers = [None, True, 0, -1, 1, 2**31, 2**63, 2**64, 10**400, -10**400, 1.5, NAN, INF, -INF, 1e308, 5e-324,
               np.float64(1), np.int8(-3), np.datetime64("now")]
    texts = ["", "x", "a\0b", "\ud800", b"x", "a" * 100000, "/dev/zero", "/proc/self/mem", "/", "none.yaml",
             os.path.join(folder, "scene.yaml"), os.path.join(folder, "robot.urdf")]
    objects = [[], [[]], {}, (), Evil(), object(), cd, cd.Error, cd.Status.OK, lambda *_: 1 / 0, range(7), iter([1, 2]),
               memoryview(b"abcdefgh"), [np.zeros(3), np.zeros(4)], [None], ["\ud800"], {"a": 1}, {"\ud800": "x"}]
    poses = [np.zeros(0), np.zeros((0, 7)), np.zeros((0, 4, 4)), np.zeros((3, 0)), np.full((2, 7), NAN),
             np.full((2, 7), 1e308), POSE, POSE[None], many()[:, ::-1], np.asfortranarray(many()), np.tile(POSE, (3, 2))[:, ::2],
             many().astype(">f8"), many().astype("f2"), many().astype(np.longdouble), many().astype(complex),
             np.broadcast_to(POSE, (5, 7)), np.lib.stride_tricks.as_strided(POSE, (4, 7), (0, 8)),
             np.ma.masked_array(many(), mask=True), np.eye(4), np.eye(4)[None], np.tile(np.eye(4), (2, 1, 1)),
             np.eye(4).T[::-1], np.zeros((2, 2, 7)), np.zeros((1,) * 20), np.zeros((2, 7), dtype=bool)]
    others = [np.array([1, 2], dtype=object), np.array(["a"]), np.zeros((2,), dtype=[("x", "f8")]), np.zeros((2, joints)),
              np.zeros(joints), np.full(joints, NAN), np.full(joints, 1e308), np.zeros((2, joints), dtype="m8[s]"),
              np.zeros((3, 3)), [[0, 1, 2]], np.array([[0, 1, 2]], dtype=np.int64), np.array([[0, 1, -1]]),
              np.array([[0, 1, 2**40]]), np.array([[0.5, 1, 2]]), np.array([[NAN, 1, 2]]), np.full((3, 3), NAN),
              np.full((3, 3), 1e308), np.full((1, 3), 2**64 - 1, dtype=np.uint64)]
    return numbers + texts + objects + poses + others


def calls(folder):
    """Each function with good arguments and the names of further ones."""
    box, ball = cd.make_box((1, 1, 1)), cd.make_sphere(0.5)
    scene = cd.load_scene(os.path.join(folder, "scene.yaml"))
    robot = cd.load_robot(os.path.join(folder, "robot.urdf"))
    still = np.zeros(len(robot.position_names))
    pair, scene_tracker, robot_tracker = cd.PairTracker(box, ball), cd.SceneTracker(scene), cd.SceneTracker(robot)
    robot_tracker.update(robot.poses_of_bodies(still), 0.0)
    parameters = [one["name"] for one in cd.parameters()]
    files = ["package_folders", "mesh_folders", "strict"]
    motion = ["times", "start", "roots", "bodies", "tolerance", "threshold", "time_budget", "sample_limit", "threads",
              "each_pair", "niches", "progress"]
    yield "load_body", cd.load_body, ["none.stl"], ["scale", "max_edge_length"]
    yield "make_body", cd.make_body, [np.eye(3), [[0, 1, 2]]], ["name", "weld_tolerance", "orient"]
    yield "make_box", cd.make_box, [(1, 1, 1)], ["name"]
    yield "make_sphere", cd.make_sphere, [1.0], ["name", "chord_error"]
    yield "make_cylinder", cd.make_cylinder, [1.0, 1.0], ["name", "chord_error"]
    yield "make_capsule", cd.make_capsule, [1.0, 1.0], ["name", "chord_error"]
    yield "solve_each", cd.solve_each, [box, ball, POSE], ["name", "threads"]
    yield "PairTracker", cd.PairTracker, [box, ball], ["name"] + parameters
    yield "PairTracker.update", pair.update, [POSE], ["times"]
    yield "PairTracker.solve", pair.solve, [POSE], []
    yield "PairTracker.set_parameters", pair.set_parameters, [], parameters
    yield "Answers.niches_of", pair.solve(many()).niches_of, [0], []
    yield "load_scene", cd.load_scene, [os.path.join(folder, "scene.yaml")], files + ["descriptions", "geometry", "cutoff"]
    yield "load_robot", cd.load_robot, [os.path.join(folder, "robot.urdf")], files + ["srdf", "geometry", "automatic_cutoff", "cutoff"]
    yield "Scene.poses_of_bodies", robot.poses_of_bodies, [still], ["roots"]
    yield "SceneTracker", cd.SceneTracker, [scene], ["threads", "pairs", "time_budgets"]
    yield "SceneTracker.update", scene_tracker.update, [np.tile(np.eye(4), (2, 1, 1)), 0.0], ["niches_wanted", "moved"]
    yield "SceneTracker.nearest", robot_tracker.nearest, [robot.poses_of_bodies(still[None])], []
    yield "ConstraintRows", cd.ConstraintRows, [robot], ["distance", "capacity", "tilt"]
    yield "ConstraintRows.update", cd.ConstraintRows(robot).update, [robot_tracker, still], ["roots"]
    yield "find_clearance", cd.find_clearance, [robot, np.tile(still, (2, 1))], motion + [
        "velocities", "accelerations", "joints"]
    yield "find_clearance_of_body", cd.find_clearance_of_body, [scene, "b", many(2)], motion


def shown(value):
    return type(value).__name__ if isinstance(value, Evil) else ("%s %.60r" % (type(value).__name__, value)).replace("\n", " ")


def problem_of(function, arguments, keywords, value):
    """What is wrong with the outcome of a call, or None."""
    try:
        function(*arguments, **keywords)
    except cd.Error as error:
        if not (error.what and error.remedy and str(error)):
            return "an Error without its texts: %s" % error
        if len(str(error)) > LONGEST_MESSAGE:
            return "a message of %d characters" % len(str(error))
    except (TypeError, IndexError):
        pass
    except Exception as error:
        if not isinstance(value, Evil) and not isinstance(error, ZeroDivisionError):
            return "%s: %.200s" % (type(error).__name__, error)
    return None


SCENE = """bodies:
  - {name: a, frame: world, box: {size: [1, 1, 1]}}
  - {name: b, frame: b, box: {size: [1, 1, 1]}}
pairs:
  - {between: [a, b]}
"""
ROBOT = """<robot name="arm">
  <link name="base"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="middle"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <link name="tip"><collision><geometry><sphere radius="0.2"/></geometry></collision></link>
  <joint name="slide" type="prismatic"><parent link="base"/><child link="middle"/><origin xyz="2 0 0"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="turn" type="revolute"><parent link="middle"/><child link="tip"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>
"""


class Arguments(unittest.TestCase):
    def test_hostile_values_end_in_an_answer_or_an_error(self):
        problems = []
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("scene.yaml", SCENE), ("robot.urdf", ROBOT)):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            for label, function, good, further in calls(folder):
                for place in list(range(len(good))) + further:
                    for value in values(folder, 2):
                        arguments, keywords = list(good), {"time_budget": 0.2} if label.startswith("find_clearance") else {}
                        if isinstance(place, int):
                            arguments[place] = value
                        else:
                            keywords[place] = value
                        problem = problem_of(function, arguments, keywords, value)
                        if problem:
                            problems.append("%s(%s = %s): %s" % (label, place, shown(value), problem))
        self.assertEqual(problems, [])

    def test_calls_and_their_errors_leave_no_memory_behind(self):
        tracker, pose = cd.PairTracker(cd.make_box((1, 1, 1)), cd.make_sphere(0.5)), POSE[None]

        def act(count):
            for _ in range(count):
                tracker.solve(pose)
                for wrong in (lambda: tracker.solve("here"), lambda: cd.make_box((1, 1, -1))):
                    with self.assertRaises(cd.Error):
                        wrong()
        act(2000)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        act(10000)
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 10000)  # kB

    def test_a_forked_process_solves(self):
        box, ball, poses = cd.make_box((1, 1, 1)), cd.make_sphere(0.5), many(2000)
        cd.solve_each(box, ball, poses)
        child = os.fork()
        if child == 0:
            os._exit(0 if np.all(np.isfinite(cd.PairTracker(box, ball).solve(poses).rows["distance"])) else 1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)


if __name__ == "__main__":
    faulthandler.enable()
    unittest.main()
