#!/usr/bin/env python3
"""The sum of planning scene messages, beside a plain model: random diffs, whole scenes between them, lost messages."""
import math
import unittest

from plain_scene import (
    FRAME, LINKS, NONE, UNIT, PlainScene, RandomDiffs, are_equal, frames, matrix, times)
from planning_scene_state import PlanningSceneState
from planning_scene_values import (
    ADD, APPEND, MOVE, REMOVE, AllowedContacts, AttachedMessage, ObjectMessage, SceneMessage, Shape)

BALL, BOX = Shape("sphere", (0.1,)), Shape("box", (1.0, 2.0, 3.0))


def at(x, y=0.0, z=0.0):
    return ((x, y, z), NONE[1])


def add(name, *shapes, **fields):
    fields.setdefault("pose", NONE)
    fields.setdefault("operation", ADD)
    return ObjectMessage(id=name, frame=FRAME, shapes=tuple(shape for shape, _ in shapes),
                         shape_poses=tuple(pose for _, pose in shapes), **fields)


def diff(*objects, **fields):
    return SceneMessage(objects=objects, transforms=frames(), **fields)


def in_world(item):
    frame = matrix(LINKS[item.frame]) if item.frame in LINKS else UNIT
    return [(shape, times(times(frame, matrix(item.pose)), matrix(pose)))
            for shape, pose in zip(item.shapes, item.shape_poses)]


class SumOfDiffs(unittest.TestCase):
    def assertSame(self, state, model, step):
        self.assertEqual(sorted(state.world), sorted(model.placed()), step)
        for name, shapes in model.placed().items():
            self.assertShapes(in_world(state.world[name]), shapes, (step, name))
        self.assertEqual(sorted(state.attached), sorted(model.held()), step)
        for name, (link, touch, shapes) in model.held().items():
            item = state.attached[name]
            self.assertEqual((item.link, item.touch_links), (link, touch), (step, name))
            self.assertShapes(in_world(item), shapes, (step, name))
        self.assertEqual((state.contacts.pairs, state.contacts.defaults), (model.contacts, model.defaults), step)
        self.assertEqual((state.padding, state.colors), (model.padding, model.colors), step)

    def assertShapes(self, found, wanted, where):
        self.assertEqual([shape for shape, _ in found], [shape for shape, _ in wanted], where)
        for (_, one), (_, other) in zip(found, wanted):
            self.assertTrue(are_equal(one, other), (where, one, other))

    def follow(self, seed, has_pose, gets=lambda step, draws: True, asks=lambda step: False):
        """A thousand random diffs. gets: whether the state gets that of a step; asks: whether it gets the whole scene
        after it. Compares after each step from which on nothing is missing. Returns the counts of what was compared."""
        draws, model, state = RandomDiffs(seed, has_pose), PlainScene(), PlanningSceneState()
        state.use(SceneMessage(transforms=frames()))
        compared, is_complete = [0, 0, 0], True
        for step in range(1000):
            message = draws.diff()
            model.use(message)
            if gets(step, draws):
                state.use(message)
            else:
                is_complete = False
            if asks(step):
                whole = model.whole()
                model.use(whole)
                state.use(whole)
                is_complete = True
            if is_complete:
                self.assertSame(state, model, step)
                compared = [a + b for a, b in zip(compared, (1, len(model.world), len(model.attached)))]
        return compared

    def test_a_thousand_diffs_give_the_sum(self):
        for seed, has_pose in ((1, True), (2, False)):
            steps, objects, attached = self.follow(seed, has_pose)
            self.assertEqual(steps, 1000)
            self.assertGreater(objects, 1000)
            self.assertGreater(attached, 300)

    def test_a_whole_scene_between_diffs_changes_nothing(self):
        for seed, has_pose in ((3, True), (4, False)):
            self.assertEqual(self.follow(seed, has_pose, asks=lambda step: step % 7 == 0)[0], 1000)

    def test_after_a_late_start_a_whole_scene_is_enough(self):
        self.assertEqual(self.follow(5, True, lambda step, draws: step > 500, lambda step: step == 500)[0], 500)

    def test_after_lost_messages_a_whole_scene_is_enough(self):
        steps = self.follow(6, True, lambda step, draws: draws.random.random() > 0.05, lambda step: step % 20 == 19)[0]
        self.assertTrue(100 < steps < 1000, steps)

    def test_diffs_that_arrive_again_after_the_whole_scene_do_no_harm(self):
        # MoveIt publishes changed objects complete; such diffs may be on their way while get_planning_scene answers.
        draws, model, state = RandomDiffs(7), PlainScene(), PlanningSceneState()
        for _ in range(100):
            late = []
            for _ in range(5):
                before = model.whole()
                model.use(draws.diff())
                late.append(published(before, model.whole()))
            for message in [model.whole()] + late:
                state.use(message)
            state.colors = model.colors  # A late removal takes the colour, which no later diff repeats.
            self.assertSame(state, model, "again")


def published(before, after):
    """The diff that MoveIt publishes of a change."""
    had, has = {one.id: one for one in before.objects}, {one.id: one for one in after.objects}
    held = {one.object.id for one in after.attached}  # Attaching takes an object of the world of the same name.
    gone = tuple(ObjectMessage(name, REMOVE, FRAME) for name in had if name not in has)
    return SceneMessage(objects=gone + tuple(one for name, one in has.items()
                                              if had.get(name) != one or name in held),
                        attached=after.attached, has_joints=True, robot_state_is_diff=False,
                        contacts=after.contacts, padding=after.padding, colors=after.colors)


class Rules(unittest.TestCase):
    def setUp(self):
        self.state = PlanningSceneState()

    def test_a_remove_without_id_takes_all_but_what_is_attached(self):
        self.state.use(diff(add("a", (BALL, NONE)), add("b", (BOX, NONE)), robot_state_is_diff=True, attached=(
            AttachedMessage("wrist", ObjectMessage("c", ADD, "wrist", NONE, (BALL,), (NONE,))),)))
        self.state.use(diff(ObjectMessage("", REMOVE)))
        self.assertEqual((list(self.state.world), list(self.state.attached)), ([], ["c"]))

    def test_a_single_shape_gives_its_pose_to_the_object_that_has_none(self):
        for pose in (None, NONE):
            self.state.use(diff(add("a", (BALL, at(1.0)), pose=pose)))
            self.state.use(diff(ObjectMessage("a", MOVE, FRAME, at(5.0))))
            self.assertEqual(in_world(self.state.world["a"])[0][1][0][3], 5.0)

    def test_with_a_pose_of_its_own_an_object_carries_its_shapes(self):
        self.state.use(diff(add("a", (BALL, at(1.0)), pose=at(2.0))))
        self.state.use(diff(ObjectMessage("a", MOVE, FRAME, at(5.0))))
        self.assertEqual(in_world(self.state.world["a"])[0][1][0][3], 6.0)

    def test_an_append_stands_where_its_message_says(self):
        self.state.use(diff(add("a", (BALL, at(1.0)))))
        self.state.use(diff(add("a", (BOX, at(3.0)), operation=APPEND)))
        self.assertEqual([place[0][3] for _, place in in_world(self.state.world["a"])], [1.0, 3.0])

    def test_a_full_robot_state_replaces_what_is_attached(self):
        cup = AttachedMessage("wrist", ObjectMessage("cup", ADD, "wrist", NONE, (BALL,), (NONE,)))
        self.state.use(diff(attached=(cup,), robot_state_is_diff=True))
        self.state.use(diff(has_joints=True, robot_state_is_diff=True))
        self.assertEqual(list(self.state.attached), ["cup"])
        self.state.use(diff())  # Nothing is said of the robot.
        self.assertEqual(list(self.state.attached), ["cup"])
        self.state.use(diff(has_joints=True, robot_state_is_diff=False))
        self.assertEqual(list(self.state.attached), [])

    def test_joint_values_alone_change_nothing(self):
        self.state.use(diff(add("a", (BALL, NONE))))
        changes = self.state.changes
        self.state.use(SceneMessage(has_joints=True, robot_state_is_diff=True))
        self.assertEqual(self.state.changes, changes)

    def test_contacts_follow_the_matrix_and_then_both_defaults(self):
        contacts = AllowedContacts({("a", "b"): False}, {"a": True, "b": True, "c": False})
        self.assertFalse(contacts.allows("b", "a"))
        self.assertTrue(contacts.allows("a", "other"))
        self.assertFalse(contacts.allows("a", "c"))
        self.assertFalse(contacts.allows("x", "y"))

    def test_an_octomap_is_noticed_and_forgotten(self):
        self.state.use(diff(octomap="OcTree of 9 bytes"))
        self.state.use(diff())
        self.assertEqual(self.state.octomap, "OcTree of 9 bytes")
        self.state.use(diff(octomap=""))
        self.assertEqual(self.state.octomap, "")


class Refused(unittest.TestCase):
    """What cannot be taken over is named, with the reason; the rest of its message is served."""

    def setUp(self):
        self.state = PlanningSceneState()

    def assertRefused(self, item, *words, name="object 'bad'"):
        self.state.use(diff(item, add("good", (BALL, NONE))))
        self.assertIn("good", self.state.world)
        for word in words:
            self.assertIn(word, self.state.refused[name])

    def test_objects(self):
        self.assertRefused(add("bad"), "no shapes")
        self.assertRefused(add("bad", (Shape("sphere", (math.nan,)), NONE)), "not finite")
        self.assertRefused(add("bad", (BALL, NONE), pose=at(math.inf)), "not finite")
        self.assertRefused(add("bad", (BALL, at(math.nan))), "pose", "not finite")
        self.assertRefused(add("bad", (Shape("box", (1.0, 1.0)), NONE)), "2 dimensions; give 3")
        self.assertRefused(add("bad", (Shape("cone", (1.0, 0.0)), NONE)), "greater than 0")
        self.assertRefused(add("bad", (Shape("plane", (0.0, 0.0, 0.0, 1.0)), NONE)), "normal")
        for tiny_or_huge in (5e-324, 1e-200, 1e200, 1.7e308):
            self.assertRefused(add("bad", (Shape("plane", (tiny_or_huge,) * 3 + (1.0,)), NONE)), "normal of length")
        self.assertRefused(add("bad", (Shape("mesh", ()), NONE)), "no triangle")
        self.assertRefused(add("bad", (Shape("mesh", (0.0,) * 9, (0, 1, 3)), NONE)), "vertex 3 of 3")
        self.assertRefused(add("bad", (Shape("primitive of type 5", ()), NONE)), "type 5", "CONE 4")
        self.assertRefused(add("bad", (BALL, NONE), operation=9), "operation is 9")
        self.assertRefused(add("bad", (BALL, NONE), fault="it has 1 meshes but 2 mesh_poses"), "2 mesh_poses")
        self.assertRefused(ObjectMessage("bad", MOVE, FRAME, NONE), "not in the world")
        self.assertRefused(ObjectMessage("bad", ADD, "nowhere", NONE, (BALL,), (NONE,)), "nowhere", FRAME)
        self.assertRefused(add("", (BALL, NONE)), "id", name="object ''")
        self.assertRefused(add("<octomap>", (BALL, NONE)), "reserved", name="object '<octomap>'")

    def test_an_object_of_which_a_part_is_wrong_is_left_out_whole(self):
        self.state.use(diff(add("bad", (BALL, NONE))))
        self.assertRefused(add("bad", (BALL, NONE), (Shape("box", (0.0, 1.0, 1.0)), NONE)), "greater than 0")
        self.assertNotIn("bad", self.state.world)
        self.state.use(diff(add("bad", (BALL, NONE))))
        self.assertEqual(self.state.refused, {})

    def test_a_move_that_is_wrong_leaves_the_object(self):
        self.state.use(diff(add("bad", (BALL, at(1.0)))))
        self.assertRefused(ObjectMessage("bad", MOVE, FRAME, at(math.nan)), "stays where it was")
        self.assertRefused(ObjectMessage("bad", MOVE, FRAME, NONE, (), (NONE, NONE)), "2 poses", "1 shapes")
        self.assertEqual(in_world(self.state.world["bad"])[0][1][0][3], 1.0)

    def test_attached_objects(self):
        def attach(link, operation=ADD, shapes=(BALL,), is_diff=True):
            self.state.use(diff(attached=(AttachedMessage(link, ObjectMessage(
                "bad", operation, link, NONE, shapes, (NONE,) * len(shapes))),), robot_state_is_diff=is_diff))
            return self.state.refused.get("attached object 'bad'", "")
        self.assertIn("link_name", attach(""))
        self.assertIn("no shapes", attach("wrist", shapes=()))
        self.assertIn("no shapes", attach("wrist", APPEND, ()))
        self.assertIn("robot_state.is_diff", attach("wrist", REMOVE, (), False))
        self.assertIn("operation is 3", attach("wrist", MOVE))
        self.assertEqual("", attach("wrist"))
        self.assertIn("attached to 'wrist', not to 'finger'", attach("finger", REMOVE, ()))

    def test_quaternions_of_any_length_are_rotations(self):
        half = math.sqrt(0.5)
        for length in (5e-324, 1e-200, 1e-3, 1e200, 1.2e308):
            pose = ((0.0, 0.0, 0.0), (length, 0.0, 0.0, length))
            self.state.use(diff(add("turned", (BALL, NONE), (BALL, NONE), pose=pose)))
            for number, right in zip(self.state.world["turned"].pose[1], (half, 0.0, 0.0, half)):
                self.assertAlmostEqual(number, right, 12)

    def test_numbers_of_links(self):
        self.state.use(diff(padding=(("wrist", -1.0), ("finger", 0.01)), scale=(("wrist", 0.0),)))
        self.assertEqual(self.state.padding, {"finger": 0.01})
        self.assertIn("0 or more", self.state.refused["link_padding of 'wrist'"])
        self.assertIn("greater than 0", self.state.refused["link_scale of 'wrist'"])

    def test_fixed_frames(self):
        self.state.use(SceneMessage(transforms=((FRAME, FRAME, NONE), ("map", "camera", NONE),
                                                (FRAME, "lamp", at(math.nan)))))
        self.assertIn("'map'", self.state.refused["fixed frame 'camera'"])
        self.assertIn("not finite", self.state.refused["fixed frame 'lamp'"])


if __name__ == "__main__":
    unittest.main()
