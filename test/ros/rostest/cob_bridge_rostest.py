#!/usr/bin/env python3
"""obstacle_distance and registerLinkOfInterest beside closed forms; the classes are made from the same fields."""
import math
import os
import sys
import threading
import time
import unittest

import genpy.dynamic
import rospy
import rostest
from concave_distance.msg import SceneOperation
from concave_distance.srv import ApplyScene
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "bridges"), os.path.join(HERE, "..", "..", "..", "src", "ros", "bridges")]
import moveit_definitions  # noqa: E402
from cob_messages import registration_class  # noqa: E402

DISTANCES = "cob_control_msgs/ObstacleDistances"
# A subscriber of cob_control_msgs has this compiled in.
FIELDS = """ObstacleDistance[] distances
{line}MSG: cob_control_msgs/ObstacleDistance
Header header
string link_of_interest
string obstacle_id
float64 distance
geometry_msgs/Vector3 frame_vector
geometry_msgs/Vector3 nearest_point_frame_vector
geometry_msgs/Vector3 nearest_point_obstacle_vector
{line}MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
{line}MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
""".format(line="=" * 80 + "\n")
MD5 = "58f6b8a2511da851588441c695d51807"
ANGLE, BASE, TIP = 0.6, (1.0, 2.0, 0.5), (4.0, 2.0, 0.5)  # of the base about z; places of the links in the world


class Transforms(threading.Thread):
    """The base is turned, so that directions in its frame are not those of the world. Static links would be rigid."""

    def __init__(self):
        super().__init__(daemon=True)
        self._publisher = rospy.Publisher("/tf", TFMessage, queue_size=10)
        self.start()

    def run(self):
        while not rospy.is_shutdown():
            message = TFMessage()
            for frame, place, angle in (("base", BASE, ANGLE), ("tip", TIP, 0.0)):
                one = TransformStamped()
                one.header.stamp, one.header.frame_id, one.child_frame_id = rospy.Time.now(), "world", frame
                at = one.transform
                at.translation.x, at.translation.y, at.translation.z = place
                at.rotation.z, at.rotation.w = math.sin(angle / 2), math.cos(angle / 2)
                message.transforms.append(one)
            try:
                self._publisher.publish(message)
            except rospy.ROSException:
                return  # The test has ended.
            time.sleep(0.02)


def in_base(point):
    x, y, z = (a - b for a, b in zip(point, BASE))
    return (math.cos(ANGLE) * x + math.sin(ANGLE) * y, -math.sin(ANGLE) * x + math.cos(ANGLE) * y, z)


class CobBridge(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.transforms = Transforms()
        made = genpy.dynamic.generate_dynamic(DISTANCES, FIELDS)[DISTANCES]
        assert made._md5sum == MD5, made._md5sum
        cls.arm, cls.places, cls.status = [], [], {}
        rospy.Subscriber("/diagnostics", DiagnosticArray, cls.keep_status, queue_size=100)
        rospy.Subscriber("/arm/obstacle_distance", made, cls.arm.append)
        rospy.Subscriber("/places/obstacle_distance", made, cls.places.append)
        cls.apply = rospy.ServiceProxy("/concave_distance/apply_scene", ApplyScene)
        cls.register = rospy.ServiceProxy("/arm/obstacle_distance/registerLinkOfInterest", registration_class())
        cls.register.wait_for_service(60.0)
        cls.apply.wait_for_service(60.0)

    @classmethod
    def keep_status(cls, message):
        for one in message.status:
            if one.name == "arm/cob_bridge":
                cls.status = {item.key: item.value for item in one.values}

    def change(self, *operations):
        answer = self.apply(operations=operations)
        self.assertTrue(answer.success, answer)

    def add(self, name, x, y, z, kind, *dimensions, **fields):
        made = SceneOperation(operation=SceneOperation.ADD, body=name, frame_id="world", **fields)
        made.pose.position.x, made.pose.position.y, made.pose.position.z = x, y, z
        made.primitives = [SolidPrimitive(type=kind, dimensions=dimensions)]
        self.change(made)

    def wait_for(self, messages, check, what, seconds=60.0):
        """The first message from now on that the check accepts."""
        del messages[:]
        end, at = time.monotonic() + seconds, 0
        while time.monotonic() < end:
            while at < len(messages):
                found = {}
                for one in messages[at].distances:
                    found.setdefault((one.link_of_interest, one.obstacle_id), []).append(one)
                if check(found):
                    return found
                at += 1
            time.sleep(0.02)
        self.fail("%s; the last of %d messages: %s" % (what, len(messages), messages[-1:]))

    def assertVector(self, vector, point):
        for one, other in zip((vector.x, vector.y, vector.z), point):
            self.assertAlmostEqual(one, other, 6)

    def test_1_registration(self):
        answer = self.register("no_link")
        self.assertFalse(answer.success)
        self.assertIn("no body 'no_link'", answer.message)
        for _ in range(2):
            end = time.monotonic() + 30.0
            while not self.register("tip").success and time.monotonic() < end:
                time.sleep(0.1)  # The robot is being loaded.
            self.assertTrue(self.register("tip").success)
        self.assertIn("already", self.register("tip").message)

    def test_2_values_are_those_of_the_closed_form(self):
        self.add("ball", 4.0, 5.0, 0.5, SolidPrimitive.SPHERE, 0.5)
        # A link whose transforms come a cycle later is in the next message.
        both = {("tip", "ball"), ("tip", "base")}
        found = self.wait_for(self.arm, lambda found: both <= set(found), "not the ball and the other link")
        (one,) = found[("tip", "ball")]
        self.assertEqual(one.header.frame_id, "base")
        self.assertGreater(one.header.stamp.to_sec(), 0.0)
        self.assertAlmostEqual(one.distance, 3.0 - 0.5 - 0.5, 6)
        self.assertVector(one.frame_vector, in_base(TIP))
        self.assertVector(one.nearest_point_frame_vector, in_base((4.0, 2.5, 0.5)))
        self.assertVector(one.nearest_point_obstacle_vector, in_base((4.0, 4.5, 0.5)))
        # The other link is an obstacle, too; the ball is none of its own.
        self.assertIn(("tip", "base"), found)
        self.assertNotIn(("base", "tip"), found)

    def test_3_beyond_the_largest_distance_nothing_is_published(self):
        self.add("far", 4.0, 7.2, 0.5, SolidPrimitive.SPHERE, 0.5)  # 4.2 m
        self.add("near", 4.0, -2.3, 0.5, SolidPrimitive.SPHERE, 0.5)  # 3.3 m
        found = self.wait_for(self.arm, lambda found: ("tip", "near") in found, "not near")
        self.assertNotIn(("tip", "far"), found)

    def test_4_what_a_link_holds_counts_as_the_link(self):
        self.add("held", 4.0, 3.0, 0.5, SolidPrimitive.SPHERE, 0.25)
        self.change(SceneOperation(operation=SceneOperation.ATTACH, body="held", other="tip"))
        found = self.wait_for(self.arm, lambda found: len(found.get(("tip", "ball"), ())) == 2, "not of what is held")
        nearest = min(found[("tip", "ball")], key=lambda one: one.distance)
        self.assertAlmostEqual(nearest.distance, 4.5 - 3.25, 6)
        self.assertVector(nearest.frame_vector, in_base(TIP))
        self.assertVector(nearest.nearest_point_frame_vector, in_base((4.0, 3.25, 0.5)))
        self.change(SceneOperation(operation=SceneOperation.REMOVE, body="held"))
        self.wait_for(self.arm, lambda found: len(found.get(("tip", "ball"), ())) == 1, "still held")

    def test_5_overlapping_bodies_have_distance_0(self):
        self.add("inside", 4.0, 2.0, 1.0, SolidPrimitive.SPHERE, 0.25)
        found = self.wait_for(self.arm, lambda found: ("tip", "inside") in found, "no overlap")
        self.assertEqual(found[("tip", "inside")][0].distance, 0.0)
        self.change(SceneOperation(operation=SceneOperation.REMOVE, body="inside"))

    def test_6_every_place_has_an_entry_of_its_own(self):
        # A frame of two posts beside the cube: one pair of bodies, two places.
        posts = SceneOperation(operation=SceneOperation.ADD, body="posts", frame_id="world")
        posts.pose.position.x, posts.pose.position.y, posts.pose.position.z = TIP
        posts.primitives = [SolidPrimitive(type=SolidPrimitive.SPHERE, dimensions=[0.5]) for _ in range(2)]
        posts.primitive_poses = [type(posts.pose)() for _ in range(2)]
        posts.primitive_poses[0].position.z, posts.primitive_poses[1].position.z = 2.0, -3.0
        self.change(posts)
        found = self.wait_for(self.places, lambda found: len(found.get(("tip", "posts"), ())) == 2, "not two places", 60.0)
        near, far = found[("tip", "posts")]
        self.assertAlmostEqual(near.distance, 1.0, 2)  # Spheres of a body of several shapes are meshes.
        self.assertAlmostEqual(far.distance, 2.0, 2)
        self.assertVector(near.frame_vector, in_base(TIP))
        self.assertAlmostEqual(near.nearest_point_frame_vector.z, 0.5, 6)
        self.assertAlmostEqual(far.nearest_point_frame_vector.z, -0.5, 6)

    def test_7_obstacles_that_are_registered_by_a_message(self):
        kind = moveit_definitions.message_classes()["moveit_msgs/CollisionObject"]
        publisher = rospy.Publisher("/arm/obstacle_distance/registerObstacle", kind, queue_size=1, latch=True)
        item = kind(id="crate 1", operation=kind.ADD)
        item.header.frame_id, item.pose.orientation.w = "world", 1.0
        item.primitives = [SolidPrimitive(type=SolidPrimitive.BOX, dimensions=[1.0, 1.0, 1.0])]
        item.primitive_poses = [type(item.pose)()]
        at = item.primitive_poses[0]
        at.position.x, at.position.y, at.position.z, at.orientation.w = 6.0, 2.0, 0.5, 1.0
        publisher.publish(item)
        found = self.wait_for(self.arm, lambda found: ("tip", "crate 1") in found, "no crate")
        self.assertAlmostEqual(found[("tip", "crate 1")][0].distance, 1.0, 6)
        item.operation, at.position.x = kind.MOVE, 7.0
        publisher.publish(item)
        self.wait_for(self.arm, lambda found: ("tip", "crate 1") in found and abs(
            found[("tip", "crate 1")][0].distance - 2.0) < 1e-6, "the crate was not moved")
        item.operation = kind.REMOVE
        publisher.publish(item)
        self.wait_for(self.arm, lambda found: ("tip", "crate 1") not in found, "the crate stays")

        publisher.unregister()
        time.sleep(0.5)
        publisher = rospy.Publisher("/arm/obstacle_distance/registerObstacle", String, queue_size=1, latch=True)
        publisher.publish("no obstacle")
        end = time.monotonic() + 60.0
        while "std_msgs/String" not in self.status.get("registerObstacle", "") and time.monotonic() < end:
            time.sleep(0.1)
        self.assertIn("it is a std_msgs/String, not a moveit_msgs/CollisionObject", self.status.get("registerObstacle"))

    def test_8_without_an_obstacle_a_message_says_so(self):
        for name in ("ball", "near", "far", "posts"):
            self.change(SceneOperation(operation=SceneOperation.REMOVE, body=name))
        self.wait_for(self.arm, lambda found: set(found) == {("tip", "base")}, "an obstacle stays")


if __name__ == "__main__":
    rospy.init_node("cob_bridge_rostest")
    rostest.rosrun("concave_distance", "cob_bridge_rostest", CobBridge)
