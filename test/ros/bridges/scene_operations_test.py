#!/usr/bin/env python3
"""Operations that bring a distance node to a planning scene, applied to a plain model of apply_scene."""
import copy
import dataclasses
import math
import unittest

from plain_scene import FRAME, LINKS, NONE, UNIT, PlainScene, RandomDiffs, are_equal, frames, inverted, matrix, times
from planning_scene_state import PlanningSceneState
from planning_scene_values import (
    ADD as ADD_OBJECT, AllowedContacts, AttachedMessage, ObjectMessage, SceneMessage, Shape)
from scene_operations import (
    ADD, ALLOW_CONTACT, ATTACH, DETACH, MOVE, REMOVE, SET_MARGIN, Names, NodeScene, padding_without_body, plan, plane_mesh,
    wanted_bodies, wanted_contacts, wanted_margins)

BALL, BOX = Shape("sphere", (0.1,)), Shape("box", (1.0, 2.0, 3.0))
NAMES = Names("moveit/")


class Fault(Exception):
    def __init__(self, owner, text):
        super().__init__("%s: %s" % (owner, text))
        self.owner = owner


class PlainNode:
    """apply_scene as doc/services.md has it: bodies by name with their shapes in the world."""

    def __init__(self, links=("wrist", "finger", "palm"), refuses=()):
        self.links = links
        self.refuses = refuses  # names of bodies that cannot be added
        self.bodies = {}  # name: [frame, pose in it, shapes and poses, attached to, touch links, margin]
        self.off = set()
        self.margins = dict.fromkeys(links, 0.0)

    def apply(self, operations):
        """All operations or none."""
        kept = copy.deepcopy((self.bodies, self.off, self.margins))
        try:
            for one in operations:
                self._apply(one)
        except Fault:
            self.bodies, self.off, self.margins = kept
            raise

    def placed(self):
        return {name: [(shape, times(times(self._frame(body[0]), body[1]), at)) for shape, at in body[2]]
                for name, body in self.bodies.items()}

    @staticmethod
    def _frame(name):
        return matrix(LINKS[name]) if name in LINKS else UNIT

    def _require(self, is_right, one, text):
        if not is_right:
            raise Fault(one.owner, text)

    def _apply(self, one):
        is_there = one.body in self.bodies
        if one.kind in (MOVE, REMOVE, ATTACH, DETACH):
            self._require(is_there, one, "there is no such body")
            body = self.bodies[one.body]
        if one.kind == ADD:
            self._require(not is_there and one.body not in self.links, one, "there is a body of this name already")
            self._require(one.body not in self.refuses, one, "cannot be added")
            self._require(one.frame, one, "no frame")
            self.bodies[one.body] = [one.frame, matrix(one.pose), [
                (shape, matrix(at)) for shape, at in zip(one.shapes, one.shape_poses)], "", (), one.margin]
        elif one.kind == MOVE:
            self._require(not body[3], one, "it is attached")
            body[0:2] = one.frame, matrix(one.pose)
        elif one.kind == REMOVE:
            del self.bodies[one.body]
            self.off = {pair for pair in self.off if one.body not in pair}
        elif one.kind == ATTACH:
            self._require(not body[3], one, "it is attached already")
            in_world = times(self._frame(body[0]), body[1])
            body[0:2] = one.other, times(inverted(self._frame(one.other)), in_world)
            body[3:5] = one.other, one.touch
        elif one.kind == DETACH:
            self._require(body[3], one, "it is not attached")
            in_world = times(self._frame(body[0]), body[1])
            frame = one.frame or FRAME
            body[0:2] = frame, times(inverted(self._frame(frame)), in_world)
            body[3:5] = "", ()
        elif one.kind == SET_MARGIN:
            self._require(is_there or one.body in self.links, one, "there is no such body")
            if is_there:
                self.bodies[one.body][5] = one.margin
            else:
                self.margins[one.body] = one.margin
        else:
            pair = tuple(sorted((one.body, one.other)))
            self._require(all(name in self.bodies or name in self.links for name in pair), one, "there is no such body")
            (self.off.add if one.kind == ALLOW_CONTACT else self.off.discard)(pair)

    def seen(self):
        return NodeScene({}, frozenset(self.links), frozenset(), dict(self.margins), FRAME)


class Follower:
    """Brings a node to a state as the bridge does."""

    def __init__(self, node):
        self.node, self.scene, self.own, self.refused = node, node.seen(), {}, set()
        self.counts = [0] * 8

    def follow(self, state):
        for _ in range(20):
            bodies = wanted_bodies(state, self.scene, NAMES, 20.0)
            operations, after = plan(bodies, wanted_contacts(state, NAMES, bodies, self.scene.others),
                                     wanted_margins(state, NAMES, self.scene, self.own), self.scene, self.refused)
            if not operations:
                return
            try:
                self.node.apply(operations)
            except Fault as fault:
                self.refused.add(fault.owner)
                continue
            self.scene = after
            for one in operations:
                self.counts[one.kind] += 1
        raise AssertionError("it does not come to an end: %s" % operations)


class RandomScenes(unittest.TestCase):
    def assertBrought(self, node, model, step):
        wanted = {}
        for name, shapes in model.placed().items():
            wanted[NAMES.body(name)] = ("", (), shapes)
        for name, (link, touch, shapes) in model.held().items():
            key = NAMES.body(name)
            wanted[key + "_attached" if key in wanted else key] = (
                link, tuple(one for one in touch if one != link and one in node.links), shapes)
        placed = node.placed()
        self.assertEqual(sorted(placed), sorted(wanted), step)
        for name, (link, touch, shapes) in wanted.items():
            body = node.bodies[name]
            self.assertEqual((body[3], body[4]), (link, touch), (step, name))
            self.assertEqual(len(placed[name]), len(shapes), (step, name))
            for (shape, one), (other_shape, other) in zip(placed[name], shapes):
                self.assertEqual(shape, other_shape)
                self.assertTrue(are_equal(one, other), (step, name, one, other))
            if link:
                self.assertEqual(body[5], model.padding.get(link, 0.0), (step, name))

    def assertContacts(self, node, state, step):
        """Every pair beside the message's own words: the matrix, then defaults of which all have to allow it."""
        objects = {NAMES.body(name): name for name in set(state.world) | set(state.attached)}
        bodies = {**{name: name for name in node.links}, **{a: b for a, b in objects.items() if a in node.bodies}}
        for a in bodies:
            for b in bodies:
                if a < b and not _are_held(node, a, b):
                    self.assertEqual((a, b) in node.off, state.contacts.allows(bodies[a], bodies[b]), (step, a, b))

    def run_scenes(self, seed, steps=1000, restart=None, forget=None, coalesce=1):
        draws, model, state, node = RandomDiffs(seed), PlainScene(), PlanningSceneState(), PlainNode()
        follower, compared = Follower(node), 0
        state.use(SceneMessage(transforms=frames()))
        for step in range(steps):
            message = draws.diff()
            model.use(message)
            state.use(message)
            if restart and step % restart == 0:
                node = PlainNode()
                follower = Follower(node)
            if forget and step % forget == 0:  # The bridge is started again: it reads what the node has.
                known = follower.scene
                follower = Follower(node)
                follower.scene = dataclasses.replace(
                    node.seen(), bodies=known.bodies, off=frozenset(
                        pair for pair in node.off if any(name in node.bodies for name in pair)))
            if step % coalesce:
                continue
            follower.follow(state)
            self.assertBrought(node, model, step)
            compared += len(node.bodies)
            if not forget and not restart and not model.attached:
                self.assertContacts(node, state, step)
        self.assertEqual(follower.refused, set())
        self.assertGreater(compared, steps / coalesce)
        return follower

    def test_a_thousand_diffs_one_by_one(self):
        counts = self.run_scenes(11).counts
        self.assertTrue(all(count > 0 for count in counts), counts)

    def test_many_diffs_at_once(self):
        self.run_scenes(12, coalesce=9)

    def test_a_distance_node_that_is_restarted(self):
        self.run_scenes(13, restart=40)

    def test_a_bridge_that_is_restarted(self):
        self.run_scenes(14, forget=40)


def _are_held(node, a, b):
    return any(name in node.bodies and node.bodies[name][3] for name in (a, b))


class Operations(unittest.TestCase):
    def setUp(self):
        self.state, self.node = PlanningSceneState(), PlainNode()
        self.follower = Follower(self.node)

    def use(self, *objects, **fields):
        fields.setdefault("robot_state_is_diff", True)
        self.state.use(SceneMessage(objects=objects, transforms=frames(), **fields))
        before = list(self.follower.counts)
        self.follower.follow(self.state)
        return [a - b for a, b in zip(self.follower.counts, before)]

    @staticmethod
    def ball(name="ball", x=0.0, frame=FRAME):
        return ObjectMessage(name, ADD_OBJECT, frame, NONE, (BALL,), (((x, 0.0, 0.0), NONE[1]),))

    def held(self, name="ball", link="wrist", touch=()):
        return AttachedMessage(link, self.ball(name, 0.1, link), touch)

    def counted(self, **kinds):
        names = ("add", "move", "remove", "attach", "detach", "allow", "disallow", "margin")
        return [kinds.get(name, 0) for name in names]

    def test_an_object_that_is_published_again_elsewhere_is_moved(self):
        self.assertEqual(self.use(self.ball()), self.counted(add=1))
        self.assertEqual(self.use(self.ball()), self.counted())
        self.assertEqual(self.use(self.ball(x=1.0)), self.counted(move=1))

    def test_picking_moves_the_body_and_putting_down_makes_it_again(self):
        self.use(self.ball())
        self.assertEqual(self.use(ObjectMessage("ball", 1), attached=(self.held(),)), self.counted(move=1, attach=1))
        self.assertEqual(self.use(attached=(self.held(touch=("finger", "unknown")),)), self.counted(detach=1, attach=1))
        self.assertEqual(self.node.bodies["moveit/ball"][4], ("finger",))
        down = self.use(self.ball(x=2.0), robot_state_is_diff=False, has_joints=True)
        self.assertEqual(down, self.counted(add=1, remove=1))

    def test_what_is_refused_leaves_the_rest(self):
        self.node.refuses = ("moveit/bad",)
        self.use(self.ball("bad"), self.ball("good"))
        self.assertEqual(list(self.node.bodies), ["moveit/good"])
        self.assertEqual(self.follower.refused, {"object 'bad'"})

    def test_a_body_that_may_not_have_its_new_shapes_goes(self):
        self.use(self.ball())
        self.node.refuses = ("moveit/ball",)
        self.use(ObjectMessage("ball", ADD_OBJECT, FRAME, NONE, (BOX,), (NONE,)))
        self.assertEqual(self.node.bodies, {})

    def test_contacts_that_are_no_longer_allowed_are_watched_again(self):
        matrix_of = AllowedContacts({("ball", "finger"): True, ("ball", "wrist"): False}, {})
        self.assertEqual(self.use(self.ball(), contacts=matrix_of), self.counted(add=1, allow=1))
        self.assertEqual(self.node.off, {("finger", "moveit/ball")})
        self.assertEqual(self.use(contacts=AllowedContacts({("ball", "finger"): False}, {})), self.counted(disallow=1))

    def test_a_touch_link_stays_off_while_its_object_is_held(self):
        self.use(attached=(self.held(touch=("finger",)),), contacts=AllowedContacts({("ball", "finger"): True}, {}))
        self.assertEqual(self.use(contacts=AllowedContacts({("ball", "finger"): False}, {})), self.counted())

    def test_a_default_allows_all_pairs_of_a_name(self):
        self.use(self.ball(), self.ball("other", 1.0), contacts=AllowedContacts(
            {("ball", "wrist"): False}, {"ball": True, "palm": False}))
        self.assertEqual(self.node.off, {("finger", "moveit/ball"), ("moveit/ball", "moveit/other")})

    def test_padding_is_the_margin_of_links_and_of_what_they_hold(self):
        self.node.margins["palm"] = 0.03
        self.follower = Follower(self.node)
        self.use(attached=(self.held(),), padding=(("wrist", 0.01), ("palm", 0.02), ("unknown", 0.5), ("bare", 0.0)))
        self.assertEqual(padding_without_body(self.state, NAMES, self.follower.scene), {"unknown": "unknown"})
        self.assertEqual(padding_without_body(self.state, Names("moveit/", "left/"), self.follower.scene),
                         {"wrist": "left/wrist", "palm": "left/palm", "unknown": "left/unknown"})
        self.assertEqual(self.node.margins, {"wrist": 0.01, "finger": 0.0, "palm": 0.03})
        self.assertEqual(self.node.bodies["moveit/ball"][5], 0.01)
        self.use(padding=(("wrist", 0.0),))
        self.assertEqual(self.node.margins["wrist"], 0.0)
        self.assertEqual(self.node.bodies["moveit/ball"][5], 0.0)

    def test_one_that_is_attached_by_its_name_stays_where_it_is_on_the_link(self):
        self.use(self.ball(x=1.0))
        attach = AttachedMessage("wrist", ObjectMessage("ball", ADD_OBJECT, "wrist", NONE))
        self.assertEqual(self.use(attached=(attach,)), self.counted(attach=1))
        remove = AttachedMessage("wrist", ObjectMessage("ball", 1))
        self.assertEqual(self.use(attached=(remove,)), self.counted(detach=1))

    def test_names_that_the_node_does_not_allow_are_replaced(self):
        self.assertEqual(NAMES.body("box_1/lid"), "moveit/box_1/lid")
        for name in ("box 1", "box-1", "/box", "box//lid", "", "\u00e4", "x" * 300, "a/"):
            made = NAMES.body(name)
            self.assertRegex(made, r"\A[a-z]+(/[A-Za-z0-9_]+)+\Z")
            self.assertLessEqual(len(made), 200)
        self.assertNotEqual(NAMES.body("box 1"), NAMES.body("box-1"))

    def test_a_plane_is_a_square_around_its_nearest_point(self):
        for coefficients in ((0.0, 0.0, 2.0, -1.0), (1.0, -2.0, 3.0, 4.0), (-1.0, 0.0, 0.0, 0.0)):
            mesh = plane_mesh(coefficients, 4.0)
            corners = [mesh.numbers[i:i + 3] for i in range(0, 12, 3)]
            for corner in corners:
                self.assertAlmostEqual(sum(a * b for a, b in zip(coefficients, corner + (1.0,))), 0.0, 12)
            for i in range(4):
                side = math.dist(corners[i], corners[(i + 1) % 4])
                self.assertAlmostEqual(side, 4.0, 12)
            middle = [sum(corner[i] for corner in corners) / 4.0 for i in range(3)]
            length = math.hypot(*coefficients[:3])
            self.assertAlmostEqual(math.hypot(*middle), abs(coefficients[3]) / length, 12)


if __name__ == "__main__":
    unittest.main()
