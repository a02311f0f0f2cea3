"""The Python module under hostile arguments, threads and lifetimes, each in an interpreter of its own."""

import os
import sys
import sysconfig
import tempfile

import processes
from arena import REPOSITORY
from attacks import Group, expect, shortened

group = Group("python", beside=True)
MODULE = "../python3/dist-packages/concave_distance/_concave_distance" + sysconfig.get_config_var("EXT_SUFFIX")
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
BEGIN = """import gc, sys, threading, weakref
import numpy as np
import concave_distance as cd
poses = np.tile([2.0, 0, 0, 0, 0, 0, 1], (50, 1))
poses[:, 0] += np.linspace(0, 1, 50)
box, ball = cd.make_box((1, 1, 1)), cd.make_sphere(0.5)
"""


def run(arena, arguments, seconds, largest_mb=1500.0):
    folder = tempfile.mkdtemp(dir=arena.folder, prefix="python_")
    for name, text in (("scene.yaml", SCENE), ("robot.urdf", ROBOT)):
        arena.write(os.path.join(folder, name), text)
    output = os.path.join(folder, "output")
    status, text, peak = processes.run(
        [sys.executable] + [word.replace("FOLDER", folder) for word in arguments], seconds * arena.patience,
        arena.environment, arena.address_space_gb, output, cwd=folder, largest_mb=largest_mb * arena.memory_factor)
    expect(status is not None, "it was ended (time or %.0f MB): %s" % (peak, shortened(text[-400:])))
    expect(status == 0, "%s: %s" % ("it ended with status %d" % status, shortened(text[-600:], 500)))


def probe(function, **options):
    group.add("arguments_of_" + function, lambda arena: run(
        arena, [os.path.join(REPOSITORY, "test", "faults", "python_probe.py"), "FOLDER", function], 180.0), deadline=240.0,
        program=MODULE, **options)


for name in ("load_body", "make_body", "make_box", "make_sphere", "make_cylinder", "make_capsule", "solve_each", "PairTracker",
             "PairTracker.update", "PairTracker.solve", "PairTracker.set_parameters", "Answers.niches_of", "load_scene",
             "load_robot", "Scene.poses_of_bodies", "SceneTracker", "SceneTracker.update", "SceneTracker.nearest",
             "ConstraintRows", "ConstraintRows.update", "find_clearance", "find_clearance_of_body"):
    probe(name, fast=name == "PairTracker.solve")


def program(name, text, seconds=60.0):
    group.add(name, lambda arena: run(arena, ["-X", "faulthandler", "-c", BEGIN + text], seconds), deadline=2.0 * seconds,
              program=MODULE)


program("owners_that_are_gone", """
tracker = cd.PairTracker(box, ball)
before = tracker.solve(poses)
expected = before.rows["distance"].copy()
rows, niches, part, vertices = before.rows, before.niches, before.niches_of(7), ball.vertices
scene = cd.load_scene("scene.yaml", cache="off")
scene_tracker = cd.SceneTracker(scene)
answers = scene_tracker.update(np.tile(np.eye(4), (2, 1, 1)) + np.array([[0, 0, 0, 3], [0] * 4, [0] * 4, [0] * 4]) *
                               np.array([0, 1])[:, None, None], 0.0)
pairs, states = answers.rows, answers.states
robot = cd.load_robot("robot.urdf", cache="off")
moving = cd.SceneTracker(robot)
moving.update(robot.poses_of_bodies([0.0, 0.0]), 0.0)
made = cd.ConstraintRows(robot, distance=3.0).update(moving, [0.0, 0.0])
jacobian, slots = made.jacobian, made.rows
keep_jacobian, keep_slots = jacobian.copy(), slots.copy()
found = cd.find_clearance(robot, [[0.0, 0.0], [0.5, 1.0]], niches=True)
point, table = found.point_a, found.pairs
keep = [np.copy(one) for one in (point, table, vertices, pairs, states, niches, part)]
del before, box, ball, tracker, scene, scene_tracker, answers, robot, moving, made, found
gc.collect()
noise = [np.random.rand(1000) for _ in range(2000)]
assert np.array_equal(rows["distance"], expected)
keep += [keep_jacobian, keep_slots]
for one, other in zip(keep, (point, table, vertices, pairs, states, niches, part, jacobian, slots)):
    assert repr(one.tolist()) == repr(other.tolist())
""")
program("classes_without_their_init", """
for kind in (cd.BodyMesh, cd.Answers, cd.SceneAnswers, cd.Scene, cd.Constraints, cd.Clearance, cd.RepairReport, cd.PairTracker,
             cd.SceneTracker, cd.ConstraintRows):
    try:
        kind()
        raise AssertionError(kind)
    except TypeError:
        pass
    class Heir(kind):
        def __init__(self):
            pass
    for use in (lambda: cd.PairTracker(Heir(), ball), lambda: cd.SceneTracker(Heir()), lambda: Heir()):
        try:
            use()
        except (TypeError, cd.Error):
            pass
""")
program("copies_and_pickles", """
import copy, pickle
tracker = cd.PairTracker(box, ball)
for one in (box, tracker, tracker.solve(poses), cd.load_scene("scene.yaml", cache="off")):
    for act in (copy.copy, copy.deepcopy, pickle.dumps):
        try:
            act(one)
        except (TypeError, cd.Error):
            pass
assert pickle.loads(pickle.dumps(tracker.solve(poses).rows)).shape == (50,)
""")
program("twenty_threads_with_all_at_once", """
robot = cd.load_robot("robot.urdf", cache="off")
tracker, moving, constraints = cd.PairTracker(box, ball), cd.SceneTracker(robot), cd.ConstraintRows(robot, distance=3.0)
moving.update(robot.poses_of_bodies([0.0, 0.0]), 0.0)
problems = []
right = cd.PairTracker(box, ball).solve(poses).rows["distance"]
def work(seed):
    source = np.random.default_rng(seed)
    for index in range(60):
        try:
            act = source.integers(8)
            if act == 0:
                found = tracker.solve(poses).rows["distance"]  # at accuracy nodes between nodes of the grid
                assert np.all((found > right - 1e-3) & (found < right + 0.5)), found - right
            elif act == 1:
                tracker.set_parameters(accuracy=["nodes", "refined", "certified"][source.integers(3)])
            elif act == 2:
                tracker.restart()
            elif act == 3:
                moving.update(robot.poses_of_bodies([0.0, 0.0]), float(index))
            elif act == 4:
                constraints.update(moving, [0.0, 0.0])
            elif act == 5:
                moving.restart()
            elif act == 6:
                gc.collect()
                cd.make_sphere(0.5, chord_error=0.01 + 0.1 * source.random())
            else:
                tracker.parameters, moving.nearest(robot.poses_of_bodies(np.zeros((3, 2))))
        except cd.Error as error:
            if error.where not in ("time", "tracker"):
                problems.append(error)
        except Exception as error:
            problems.append(error)
threads = [threading.Thread(target=work, args=(seed,)) for seed in range(20)]
[one.start() for one in threads]
[one.join() for one in threads]
assert not problems, problems[:3]
""", seconds=150.0)
program("arrays_changed_by_another_thread", """
tracker, ends = cd.PairTracker(box, ball), []
def spoil():
    while not ends:
        poses[:] = np.random.rand(50, 7)
thread = threading.Thread(target=spoil)
thread.start()
for _ in range(200):
    rows = tracker.solve(poses).rows
    assert np.all((rows["status"] == cd.Status.INVALID_POSE) | np.isfinite(rows["distance"]))
ends.append(1)
thread.join()
""")
program("progress_that_calls_back", """
robot = cd.load_robot("robot.urdf", cache="off")
tracker = cd.SceneTracker(robot)
def progress(*_):
    tracker.update(robot.poses_of_bodies([0.0, 0.0]), 0.0)
    cd.find_clearance(robot, [[0.0, 0.0], [0.1, 0.1]], time_budget=0.1)
    raise KeyError("mine")
waypoints = np.random.default_rng(1).uniform(-0.9, 0.9, (400, 2))
try:
    cd.find_clearance(robot, waypoints, tolerance=1e-12, progress=progress, time_budget=5.0)
except KeyError:
    pass
""")
program("end_while_threads_solve", """
many = np.tile(poses, (2000, 1))
for _ in range(4):
    threading.Thread(target=lambda: cd.PairTracker(box, ball).solve(many), daemon=True).start()
""")
program("fork_after_solving", """
import os
cd.solve_each(box, ball, np.tile(poses, (50, 1)))
child = os.fork()
if child == 0:
    tracker = cd.PairTracker(box, ball)
    os._exit(0 if np.all(np.isfinite(tracker.solve(poses).rows["distance"])) else 1)
assert os.waitpid(child, 0)[1] == 0
""")
program("memory_of_a_hundred_thousand_calls", """
import resource
tracker = cd.PairTracker(box, ball)
def act(count):
    for index in range(count):
        tracker.solve(poses[:1])
        try:
            tracker.solve("here")
        except cd.Error:
            pass
        try:
            cd.make_box((1, 1, -1))
        except cd.Error:
            pass
act(2000)
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
act(30000)
grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
assert grown < 20000, "%d kB more" % grown
""", seconds=90.0)
