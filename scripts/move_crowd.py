#!/usr/bin/env python3
"""The demo crowd: adds bodies of many shapes to the node's scene in one batch, and moves each on a path of its own.

rosrun concave_distance move_crowd.py [_bodies:=200] [_rate:=50] [_speed:=1] [_clear_radius:=0]
The bodies stand on a floor, with 2.2 square metres each, around a disc about the origin where none has its home; each
is in a tf frame of its own, which follows a sum of slow sines about the body's home.
"""

import math
import random
import sys

import rospy
from concave_distance.msg import SceneOperation
from concave_distance.srv import ApplyScene, ApplySceneRequest
from geometry_msgs.msg import Pose, TransformStamped
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import ColorRGBA
from tf2_msgs.msg import TFMessage

AREA = 2.2       # m2, for each body
SEED = 4
FIRST_POSES = 25  # on tf before the bodies that they are for
BLUE, ORANGE = ColorRGBA(0.35, 0.55, 0.80, 1.0), ColorRGBA(0.90, 0.62, 0.30, 1.0)
GREEN, GREY = ColorRGBA(0.45, 0.70, 0.50, 1.0), ColorRGBA(0.62, 0.62, 0.68, 1.0)


def pose_at(x=0.0, y=0.0, z=0.0):
    pose = Pose()
    pose.position.x, pose.position.y, pose.position.z = x, y, z
    pose.orientation.w = 1.0
    return pose


def solid(kind, *dimensions):
    return SolidPrimitive(type=kind, dimensions=dimensions)


def shape_of(index, engine):
    """Shapes with their poses, and a colour: people, boxes, balls, and carts that are concave."""
    scale = engine.uniform(0.8, 1.2)
    kind = index % 4
    if kind == 0:
        height = 0.7 * scale
        return [solid(SolidPrimitive.CYLINDER, height, 0.16 * scale), solid(SolidPrimitive.SPHERE, 0.11 * scale)], \
            [pose_at(z=0.5 * height), pose_at(z=height + 0.09 * scale)], BLUE
    if kind == 1:
        sides = (0.5 * scale, 0.35 * scale, 0.3 * scale)
        return [solid(SolidPrimitive.BOX, *sides)], [pose_at(z=0.5 * sides[2])], ORANGE
    if kind == 2:
        return [solid(SolidPrimitive.SPHERE, 0.2 * scale)], [pose_at(z=0.2 * scale)], GREEN
    deck, wall = (0.6 * scale, 0.4 * scale, 0.06), (0.05, 0.4 * scale, 0.45 * scale)
    return [solid(SolidPrimitive.BOX, *deck), solid(SolidPrimitive.BOX, *wall), solid(SolidPrimitive.BOX, *wall)], \
        [pose_at(z=0.1), pose_at(x=-0.28 * scale, z=0.1 + 0.5 * wall[2]), pose_at(x=0.28 * scale, z=0.1 + 0.5 * wall[2])], GREY


class Walker:
    def __init__(self, home, engine):
        self.home = home
        self.waves = [(engine.uniform(0.2, 0.4), 0.25 * (order + 1), engine.uniform(0.0, 6.3), engine.uniform(0.0, 6.3))
                      for order in range(2)]
        self.turn = engine.uniform(-0.4, 0.4)

    def place(self, time, message):
        x, y = self.home
        for size, rate, phase_x, phase_y in self.waves:
            x += size * math.sin(rate * time + phase_x)
            y += size * math.sin(rate * time + phase_y)
        message.transform.translation.x, message.transform.translation.y = x, y
        message.transform.rotation.z = math.sin(0.5 * self.turn * time)
        message.transform.rotation.w = math.cos(0.5 * self.turn * time)


def homes_of(count, engine, clear_radius):
    """Places on a grid, each a little off, moved outwards so that a disc is clear and each keeps its area."""
    columns = int(math.ceil(math.sqrt(1.5 * count)))
    rows = int(math.ceil(count / columns))
    step = math.sqrt(AREA)
    places = [(step * (index % columns - 0.5 * (columns - 1)) + engine.uniform(-0.3, 0.3),
               step * (index // columns - 0.5 * (rows - 1)) + engine.uniform(-0.3, 0.3)) for index in range(count)]
    stretch = [math.hypot(1.0, clear_radius / math.hypot(*place)) for place in places]
    return [(factor * x, factor * y) for factor, (x, y) in zip(stretch, places)]


def main():
    rospy.init_node("move_crowd")
    count = int(rospy.get_param("~bodies", 200))
    speed = rospy.get_param("~speed", 1.0)
    engine = random.Random(SEED)
    walkers = [Walker(home, engine) for home in homes_of(count, engine, rospy.get_param("~clear_radius", 0.0))]
    operations, transforms = [], []
    for index in range(count):
        frame = "walker_%d" % index
        primitives, poses, colour = shape_of(index, engine)
        operations.append(SceneOperation(operation=SceneOperation.ADD, body=frame, frame_id=frame, pose=pose_at(),
                                         primitives=primitives, primitive_poses=poses, color=colour))
        message = TransformStamped()
        message.header.frame_id, message.child_frame_id = "world", frame
        transforms.append(message)
    rospy.wait_for_service("concave_distance/apply_scene")
    add = rospy.ServiceProxy("concave_distance/apply_scene", ApplyScene)
    publisher = rospy.Publisher("/tf", TFMessage, queue_size=2)
    tick = rospy.Rate(rospy.get_param("~rate", 50.0))
    began = rospy.Time.now()
    published, is_added = 0, False
    while not rospy.is_shutdown():
        now = rospy.Time.now()
        for walker, message in zip(walkers, transforms):
            message.header.stamp = now
            walker.place(speed * (now - began).to_sec(), message)
        publisher.publish(TFMessage(transforms))
        published += 1
        if not is_added and published > FIRST_POSES:
            response = add(ApplySceneRequest(operations=operations))
            is_added = response.success
            rospy.loginfo("%d bodies added in one batch: %s", count, response.message or "all well")
        try:
            tick.sleep()
        except rospy.ROSInterruptException:
            break
    return 0


if __name__ == "__main__":
    sys.exit(main())
