#!/usr/bin/env python3
"""The bridge between a planning scene and a distance node: messages of MoveIt's fields, type and md5sum, from a fake."""
import math
import os
import random
import sys
import threading
import time
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest
from concave_distance.msg import Distances
from concave_distance.srv import GetDistance, GetScene
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point, TransformStamped
from shape_msgs.msg import Mesh, MeshTriangle, Plane
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "bridges"))
import moveit_definitions  # noqa: E402
from fake_planning_scene import FakePlanningScene, pose, solid  # noqa: E402
from plain_scene import are_equal, matrix, times  # noqa: E402

NODE = "concave_distance/"
PLACES = {"base": 0.0, "tip": 3.0}  # x of the two unit cubes of the robot


def value(message):
    position, rotation = message.position, message.orientation
    return matrix(((position.x, position.y, position.z), (rotation.x, rotation.y, rotation.z, rotation.w)))


def end_node(name):
    """Makes a node end; roslaunch starts it again."""
    try:
        uri = rosgraph.Master(rospy.get_name()).lookupNode(name)
        xmlrpc.client.ServerProxy(uri).shutdown(rospy.get_name(), "a test")
    except OSError:
        pass  # It has ended before it answered.


class Transforms(threading.Thread):
    """Moves the links: static ones would be rigid parts of the world."""

    def __init__(self):
        super().__init__(daemon=True)
        self._publisher = rospy.Publisher("/tf", TFMessage, queue_size=10)
        self.start()

    def run(self):
        while not rospy.is_shutdown():
            message = TFMessage()
            for frame, x in PLACES.items():
                one = TransformStamped()
                one.header.stamp, one.header.frame_id, one.child_frame_id = rospy.Time.now(), "world", frame
                one.transform.translation.x, one.transform.rotation.w = x, 1.0
                message.transforms.append(one)
            try:
                self._publisher.publish(message)
            except rospy.ROSException:
                return  # The test has ended.
            time.sleep(0.05)


class MoveItBridge(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.transforms = Transforms()
        cls.get_scene = rospy.ServiceProxy(NODE + "get_scene", GetScene)
        cls.get_distance = rospy.ServiceProxy(NODE + "get_distance", GetDistance)
        cls.distances, cls.status = None, {}
        rospy.Subscriber(NODE + "distances", Distances, lambda message: setattr(cls, "distances", message))
        rospy.Subscriber("/diagnostics", DiagnosticArray, cls.keep_status, queue_size=100)
        rospy.wait_for_service(NODE + "get_scene", 60.0)

    @classmethod
    def keep_status(cls, message):
        for one in message.status:
            if one.name == "moveit_bridge":
                cls.status = {item.key: item.value for item in one.values}

    def setUp(self):
        self.fake = None

    def tearDown(self):
        if self.fake:
            self.fake.publish(self.fake.make("PlanningScene"))
            self.close(self.fake)

    @staticmethod
    def close(fake):
        fake.publisher.unregister()
        fake.service.shutdown("the test has ended")

    def eventually(self, check, what, seconds=60.0):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                if check():
                    return
            except rospy.ServiceException:
                pass  # The node is being started.
            time.sleep(0.1)
        self.fail("%s; bodies: %s; status: %s" % (what, sorted(self.bodies()), self.status))

    def bodies(self):
        answer = self.get_scene(with_meshes=True)
        return {body.info.name: body for body in answer.bodies if body.info.name.startswith("moveit/")}

    def is_served(self):
        """Whether the node has what the fake has, and nothing else of the bridge's."""
        found, wanted = self.bodies(), {}
        for name, item in self.fake.objects.items():
            wanted["moveit/" + name] = ("", set(), self.shapes(item, "world"))
        for name, held in self.fake.attached.items():
            wanted["moveit/" + name] = (held.link_name, set(held.touch_links) - {held.link_name},
                                        self.shapes(held.object, held.link_name))
        if sorted(found) != sorted(wanted):
            return False
        for name, (link, touch, shapes) in wanted.items():
            body = found[name]
            place = value(body.pose_now)
            has = [(one.type, tuple(one.dimensions), times(place, value(at)))
                   for one, at in zip(body.add.primitives, body.add.primitive_poses)]
            has += [("mesh", len(one.triangles), times(place, value(at)))
                    for one, at in zip(body.add.meshes, body.add.mesh_poses)]
            if (body.info.attached_to, set(body.touch_links)) != (link, touch) or len(has) != len(shapes):
                return False
            for one, other in zip(has, shapes):
                if one[:2] != other[:2] or not are_equal(one[2], other[2]):
                    return False
        return True

    @staticmethod
    def shapes(item, frame):
        place = matrix(((PLACES.get(frame, 0.0), 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)))
        if hasattr(item, "pose"):
            place = times(place, value(item.pose))
        return ([(one.type, tuple(one.dimensions), times(place, value(at)))
                 for one, at in zip(item.primitives, item.primitive_poses)] +
                [("mesh", len(one.triangles), times(place, value(at)))
                 for one, at in zip(item.meshes, item.mesh_poses)])

    def expect_served(self, what="the bodies are not those of the planning scene"):
        self.eventually(self.is_served, what)

    def distance(self, body, link="base"):
        request = GetDistance._request_class()
        request.query.body_a, request.query.body_b = link, "moveit/" + body
        answer = self.get_distance(request)
        self.assertTrue(answer.success, answer.message)
        return answer.result.nearest.distance

    def pairs(self):
        """Names of the pairs that the cycles compute, of a message that comes from now on."""
        type(self).distances = None
        self.eventually(lambda: self.distances, "no distances")
        return {tuple(sorted((pair.body_a, pair.body_b))) for pair in self.distances.pairs}

    def expect_pair(self, is_there, *names):
        self.eventually(lambda: (tuple(sorted(names)) in self.pairs()) == is_there,
                        "pair %s is %scomputed" % (names, "not " if is_there else ""))

    def expect_problem(self, *words):
        self.eventually(lambda: any(all(word in key + ": " + text for word in words)
                                    for key, text in self.status.items()), "no problem with %s" % (words,))

    def ball(self, name="ball", x=10.0, radius=0.5, frame="world"):
        return self.fake.object(name, [(solid("SPHERE", radius), pose(x))], frame=frame)

    def test_1_a_late_start_and_a_restarted_planning_scene(self):
        # Nothing is published: the bridge has the definition by connecting, and asks.
        self.fake = FakePlanningScene()
        self.fake.objects = {"a": self.ball("a"), "b": self.ball("b", -10.0)}
        self.expect_served()
        self.assertGreater(self.fake.answers, 0)
        self.close(self.fake)
        self.fake = FakePlanningScene()
        self.fake.objects = {"c": self.ball("c")}
        self.expect_served("a restarted planning scene was not taken over")

    def test_2_distances_of_every_shape(self):
        self.fake = FakePlanningScene()
        corners = [Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)]
        wedge = Mesh([MeshTriangle(list(one)) for one in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))], corners)
        lying = (0.0, math.sin(math.pi / 4), 0.0, math.cos(math.pi / 4))  # the z axis points along x
        self.fake.put(
            self.fake.object("box", [(solid("BOX", 2.0, 4.0, 6.0), pose(-10.0))]),
            self.ball("ball", -10.0),
            # shape_msgs: the height first, then the radius; publishers send a third number that means nothing.
            self.fake.object("cylinder", [(solid("CYLINDER", 3.0, 0.25, 0.0), pose(-10.0))]),
            self.fake.object("lying_cylinder", [(solid("CYLINDER", 3.0, 0.25), pose(-10.0, rotation=lying))]),
            self.fake.object("cone", [(solid("CONE", 4.0, 0.5), pose(-10.0, rotation=lying))]),
            self.fake.object("mesh", meshes=[(wedge, pose(-10.0))]),
            self.fake.object("plane", planes=[(Plane([1.0, 0.0, 0.0, 7.0]), pose())]),
            self.fake.object("two", [(solid("SPHERE", 0.5), pose(-1.0)), (solid("SPHERE", 0.5), pose(1.0))],
                             at=pose(-10.0)))
        self.eventually(lambda: len(self.bodies()) == 8, "not all bodies")
        # The face of the base is at x = -0.5.
        for name, distance in (("box", 8.5), ("ball", 9.0), ("cylinder", 9.25), ("lying_cylinder", 8.0), ("cone", 7.5),
                               ("mesh", 8.5), ("plane", 6.5), ("two", 8.0)):
            self.assertAlmostEqual(self.distance(name), distance, 6, name)

    def test_3_an_attached_object_with_touch_links(self):
        self.fake = FakePlanningScene()
        self.fake.objects = {"ball": self.ball("ball", 1.2)}
        self.expect_served()
        self.expect_pair(True, "moveit/ball", "base")
        self.fake.attach("tip", self.ball("ball", -1.6, frame="tip"), ["base"])
        self.expect_served()
        self.expect_pair(False, "moveit/ball", "base")
        self.expect_pair(False, "moveit/ball", "tip")
        self.fake.attach("tip", self.ball("ball", -1.6, frame="tip"))
        self.expect_pair(True, "moveit/ball", "base")
        self.expect_pair(False, "moveit/ball", "tip")
        self.assertAlmostEqual(self.distance("ball"), 3.0 - 1.6 - 0.5 - 0.5, 6)
        self.fake.detach(self.ball("ball", 1.2))
        self.expect_served()
        self.expect_pair(True, "moveit/ball", "tip")

    def test_4_allowed_contacts(self):
        self.fake = FakePlanningScene()
        self.fake.objects = {"ball": self.ball("ball", 1.2), "other": self.ball("other", 1.3)}
        self.expect_served()
        self.expect_pair(True, "moveit/ball", "base")
        names = ["ball", "base", "other", "tip"]
        self.fake.set_contacts(names, {("ball", "base"), ("base", "tip")})
        self.expect_pair(False, "moveit/ball", "base")
        pairs = self.pairs()
        self.assertIn(("moveit/ball", "tip"), pairs)
        self.assertIn(("base", "moveit/other"), pairs)
        self.assertNotIn(("base", "tip"), pairs)
        self.fake.set_contacts(names, set())
        self.expect_pair(True, "moveit/ball", "base")
        self.expect_pair(True, "base", "tip")
        self.fake.set_contacts(["tip", "base"], set(), [("ball", True)])
        self.expect_pair(False, "moveit/ball", "base")
        self.expect_pair(False, "moveit/ball", "tip")
        self.assertIn(("base", "moveit/other"), self.pairs())
        self.fake.set_contacts(["tip", "base"], set())
        self.expect_pair(True, "moveit/ball", "tip")

    def test_5_padding(self):
        self.fake = FakePlanningScene()
        self.fake.objects = {"ball": self.ball("ball", -10.0)}
        self.fake.padding = {"base": 0.0, "tip": 0.0}
        self.expect_served()
        self.fake.set_padding(base=0.125)
        self.eventually(lambda: abs(self.distance("ball") - 8.875) < 1e-6, "padding has no effect")
        self.fake.set_padding(base=0.0)
        self.eventually(lambda: abs(self.distance("ball") - 9.0) < 1e-6, "padding stays")

    def test_6_the_sum_of_many_diffs_with_lost_ones_and_restarts(self):
        self.fake, draw = FakePlanningScene(), random.Random(6)
        for step in range(120):
            self.fake.is_silent = draw.random() < 0.1
            name = draw.choice("abcdefgh")
            kinds = [solid("SPHERE", draw.uniform(0.1, 0.5)), solid("BOX", *[draw.uniform(0.1, 1.0) for _ in range(3)]),
                     solid("CYLINDER", draw.uniform(0.1, 1.0), draw.uniform(0.1, 1.0))]
            shapes = [(draw.choice(kinds), pose(*[draw.uniform(-1, 1) for _ in range(3)])) for _ in range(draw.randint(1, 3))]
            at = pose(*[draw.uniform(5, 20) for _ in range(3)])
            if name in self.fake.attached:
                self.fake.detach(self.fake.object(name, shapes, at=at))
            elif draw.random() < 0.2:
                self.fake.attach(draw.choice(["base", "tip"]), self.fake.object(
                    name, shapes, at=at, frame="tip"), draw.choice([[], ["base"], ["tip", "base"]]))
                held = self.fake.attached[name]
                held.object.header.frame_id = held.link_name
            elif name in self.fake.objects and draw.random() < 0.3:
                self.fake.take_out(name)
            else:
                self.fake.put(self.fake.object(name, shapes, at=at))
            if step == 40:
                end_node("/concave_distance")
            if step == 80:
                end_node("/moveit_bridge")
            time.sleep(0.02)
        self.fake.is_silent = False
        self.assertGreater(len(self.fake.objects), 2)
        self.eventually(self.is_served, "the bodies are not the sum of the diffs", 120.0)

    def test_7_what_is_not_served_is_named_and_the_rest_is_served(self):
        self.fake = FakePlanningScene()
        bad = self.ball("bad")
        bad.primitive_poses[0].position.x = math.nan
        lost = self.ball("lost", frame="nowhere")
        far = self.ball("far", radius=1e10)
        odd = self.fake.object("odd", [(solid("SPHERE", 0.5), pose(10.0))])
        odd.primitives[0].type = 77
        good = self.ball("box 1")
        self.fake.scale["tip"] = 1.5
        self.fake.octomap = self.fake.classes["octomap_msgs/OctomapWithPose"]()
        self.fake.octomap.octomap.id, self.fake.octomap.octomap.data = "OcTree", [1, 2, 3]
        self.fake.octomap.header.frame_id = "map"
        self.eventually(lambda: self.fake.publisher.get_num_connections() == 1, "the bridge does not listen")
        self.fake.put(bad, lost, far, odd, self.fake.object("empty"), good)
        for words in (("'bad'", "not finite"), ("'lost'", "nowhere"), ("'empty'", "no shapes"), ("'odd'", "type 77"),
                      ("object 'far'", "refused", "1e9"), ("octomap", "3 bytes", "nobody subscribes"),
                      ("link_scale of 'tip'", "1.5", "not served")):
            self.expect_problem(*words)
        octomaps = []
        rospy.Subscriber("moveit_bridge/octomap", rospy.AnyMsg, octomaps.append)
        self.eventually(lambda: octomaps and not any("octomap" in key and "planning" in key for key in self.status),
                        "the octomap is not published")
        self.assertEqual(octomaps[0]._connection_header["type"], "octomap_msgs/Octomap")
        octomap = self.fake.classes["octomap_msgs/Octomap"]().deserialize(octomaps[0]._buff)
        self.assertEqual((octomap.header.frame_id, octomap.id, list(octomap.data)), ("map", "OcTree", [1, 2, 3]))
        scene = self.fake.diff()
        self.fake.octomap.origin.position.x, scene.world.octomap = 1.0, self.fake.octomap
        self.fake.publish(scene)
        self.expect_problem("octomap", "its origin is not that of its frame 'map'")
        self.assertEqual([name[:13] for name in self.bodies()], ["moveit/box_1_"])
        self.fake.objects = {"far": self.ball("far")}
        self.fake.put(*self.fake.objects.values())
        self.expect_served("what is right now is not served")
        self.eventually(lambda: not any("'far'" in key for key in self.status), "the problem stays")

    def test_8_a_definition_that_lacks_fields(self):
        self.fake = FakePlanningScene(moveit_definitions.definition(without=[
            "LinkPadding[] link_padding", "string[] touch_links"]))
        self.fake.objects = {"ball": self.ball("ball")}
        # The fake's service is made of the same definition, as a MoveIt of this version would be.
        self.fake.whole = self.whole_without_padding
        self.expect_served()
        self.expect_problem("link_padding", "links have no padding", "the rest is served")
        self.expect_problem("touch_links", "watched against all links")

    def whole_without_padding(self):
        scene = self.fake.make("PlanningScene")
        scene.world.collision_objects = list(self.fake.objects.values())
        return scene

    def test_9_another_type_on_the_topic_and_an_older_moveit(self):
        publisher = rospy.Publisher("monitored_planning_scene", String, queue_size=1)
        self.expect_problem("std_msgs/String", "not moveit_msgs/PlanningScene", "remap")
        publisher.unregister()
        time.sleep(0.5)
        self.fake = FakePlanningScene(moveit_definitions.definition(without=["CollisionObject[] collision_objects"]))
        self.expect_problem("collision_objects", "no object of the planning scene is served")
        self.close(self.fake)
        self.fake = FakePlanningScene(moveit_definitions.older_definition())
        self.fake.objects = {"old": self.ball("old")}
        self.expect_served("the scene of an older MoveIt is not served")
        self.eventually(lambda: "definition" not in self.status, "the problem stays")


if __name__ == "__main__":
    rospy.init_node("moveit_bridge_rostest")
    rostest.rosrun("concave_distance", "moveit_bridge_rostest", MoveItBridge)
