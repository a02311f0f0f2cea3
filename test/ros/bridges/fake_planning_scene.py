#!/usr/bin/env python3
"""What MoveIt's move_group publishes and answers about its planning scene, for tests and to try the bridge without MoveIt.

rosrun concave_distance fake_planning_scene.py [_link:=LINK]
Publishes monitored_planning_scene (a whole scene, then diffs; not latched) and answers get_planning_scene. As a program
it shows a table, a ball that moves to and fro above it, and, every other 10 s, a cup in the hand: attached to LINK.
"""
import os
import sys

import rospy
from geometry_msgs.msg import Pose
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import ColorRGBA

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "..", "src", "ros", "bridges")]
import moveit_definitions  # noqa: E402
from message_definitions import planning_scene_service  # noqa: E402

FRAME = "world"


def pose(x=0.0, y=0.0, z=0.0, rotation=(0.0, 0.0, 0.0, 1.0)):
    made = Pose()
    made.position.x, made.position.y, made.position.z = x, y, z
    made.orientation.x, made.orientation.y, made.orientation.z, made.orientation.w = rotation
    return made


class FakePlanningScene:
    """A scene and the diffs that change it. Everything is kept as messages."""

    def __init__(self, definition=None, topic="monitored_planning_scene", service="get_planning_scene"):
        self.classes = moveit_definitions.message_classes(definition)
        self.objects, self.attached = {}, {}
        self.padding, self.scale, self.colors = {}, {}, {}
        self.contacts = self.classes["moveit_msgs/AllowedCollisionMatrix"]()
        self.octomap = None  # an OctomapWithPose
        self.is_silent = False  # changes are made, but their diffs are lost
        scene_class = self.classes[moveit_definitions.PLANNING_SCENE]
        self.publisher = rospy.Publisher(topic, scene_class, queue_size=100) if topic else None
        self.answers = 0
        if service:
            made = planning_scene_service(scene_class)
            self.service = rospy.Service(service, made, lambda request: self._answer(made))

    def _answer(self, service):
        self.answers += 1
        return service._response_class(self.whole())

    def make(self, type_name, **fields):
        return self.classes["moveit_msgs/" + type_name](**fields)

    def whole(self):
        scene = self.make("PlanningScene")
        scene.name, scene.is_diff = "fake scene", False
        self._add_frame(scene)
        scene.world.collision_objects = list(self.objects.values())
        scene.robot_state.attached_collision_objects = list(self.attached.values())
        scene.robot_state.joint_state.name, scene.robot_state.joint_state.position = ["joint"], [0.0]
        scene.allowed_collision_matrix = self.contacts
        if self.octomap:
            scene.world.octomap = self.octomap
        scene.link_padding = [self.make("LinkPadding", link_name=a, padding=b) for a, b in self.padding.items()]
        scene.link_scale = [self.make("LinkScale", link_name=a, scale=b) for a, b in self.scale.items()]
        scene.object_colors = [self.make("ObjectColor", id=a, color=b) for a, b in self.colors.items()]
        return scene

    def _add_frame(self, scene):
        at = self.classes["geometry_msgs/TransformStamped"]()
        at.header.frame_id = at.child_frame_id = FRAME
        at.transform.rotation.w = 1.0
        scene.fixed_frame_transforms = [at]

    def diff(self):
        """A diff that changes nothing yet."""
        scene = self.make("PlanningScene")
        scene.is_diff = scene.robot_state.is_diff = True
        return scene

    def publish(self, scene):
        if not self.is_silent:
            self.publisher.publish(scene)

    def object(self, name, primitives=(), meshes=(), planes=(), at=None, operation=0, frame=FRAME):
        """A CollisionObject. Pairs of a shape and its pose; `at`: the pose of the object."""
        made = self.make("CollisionObject")
        made.header.frame_id, made.id, made.operation = frame, name, operation
        for shapes, field in ((primitives, "primitive"), (meshes, "mesh"), (planes, "plane")):
            plural = {"primitive": "primitives", "mesh": "meshes", "plane": "planes"}[field]
            setattr(made, plural, [shape for shape, _ in shapes])
            setattr(made, field + "_poses", [one for _, one in shapes])
        if hasattr(made, "pose"):
            made.pose = at or pose()
        return made

    def put(self, *objects):
        """Adds objects to the world or replaces them, as one diff."""
        scene = self.diff()
        for one in objects:
            self.objects[one.id] = one
            scene.world.collision_objects.append(one)
        self.publish(scene)

    def take_out(self, name):
        self.objects.pop(name, None)
        scene = self.diff()
        scene.world.collision_objects.append(self.object(name, operation=1))
        self.publish(scene)

    def attach(self, link, item, touch_links=()):
        """Attaches an object that is given in its link's frame, as MoveIt publishes it."""
        self.attached[item.id] = self.make("AttachedCollisionObject", link_name=link, object=item,
                                           touch_links=list(touch_links))
        scene = self._with_robot_state()
        if self.objects.pop(item.id, None):
            scene.world.collision_objects.append(self.object(item.id, operation=1))
        self.publish(scene)

    def detach(self, item):
        """Puts an attached object down, where `item` is in the world."""
        del self.attached[item.id]
        self.objects[item.id] = item
        scene = self._with_robot_state()
        scene.world.collision_objects.append(item)
        self.publish(scene)

    def _with_robot_state(self):
        scene = self.diff()
        scene.robot_state.is_diff = False
        scene.robot_state.joint_state.name, scene.robot_state.joint_state.position = ["joint"], [0.0]
        scene.robot_state.attached_collision_objects = list(self.attached.values())
        return scene

    def set_contacts(self, names, allowed, defaults=()):
        """allowed: pairs of names; defaults: pairs of a name and whether it may touch all."""
        rows = [[(a, b) in allowed or (b, a) in allowed for b in names] for a in names]
        self.contacts = self.make(
            "AllowedCollisionMatrix", entry_names=list(names),
            entry_values=[self.make("AllowedCollisionEntry", enabled=row) for row in rows],
            default_entry_names=[name for name, _ in defaults], default_entry_values=[value for _, value in defaults])
        scene = self.diff()
        scene.allowed_collision_matrix = self.contacts
        self.publish(scene)

    def set_padding(self, **padding):
        self.padding.update(padding)
        scene = self.diff()
        scene.link_padding = [self.make("LinkPadding", link_name=a, padding=b) for a, b in padding.items()]
        self.publish(scene)


def solid(kind, *dimensions):
    return SolidPrimitive(type=getattr(SolidPrimitive, kind), dimensions=dimensions)


def main():
    rospy.init_node("fake_planning_scene")
    link = rospy.get_param("~link", "wam7")
    scene = FakePlanningScene()
    scene.colors["ball"] = ColorRGBA(0.9, 0.5, 0.1, 1.0)
    scene.objects["table"] = scene.object("table", [(solid("BOX", 0.6, 0.6, 0.05), pose(0.7, 0.0, 0.1))])
    scene.publish(scene.whole())
    held = scene.object("cup", [(solid("CYLINDER", 0.1, 0.03), pose(0.0, 0.0, 0.12))], frame=link)
    down = scene.object("cup", [(solid("CYLINDER", 0.1, 0.03), pose(0.6, 0.2, 0.18))])
    rate, step = rospy.Rate(2.0), 0
    try:
        while not rospy.is_shutdown():
            scene.put(scene.object("ball", [(solid("SPHERE", 0.05), pose(0.7, 0.2 * ((step % 8) - 4) / 4.0, 0.3))]))
            if step % 40 == 10:
                scene.attach(link, held, [link])
            elif step % 40 == 30:
                scene.detach(down)
            step += 1
            rate.sleep()
    except rospy.ROSException:
        pass  # Ended by a signal.
    return 0


if __name__ == "__main__":
    sys.exit(main())
