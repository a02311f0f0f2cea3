#!/usr/bin/env python3
"""Moves a robot without a driver: its joint states and the transform from root_frame to its root link.

rosrun concave_distance robot_mover.py [_robot_description:=NAME] [_motion:=zero|sway] [_rate:=50] [_root_frame:=world]
zero: every joint at zero, or in the middle of its range if zero is outside; sway: each joint moves around that. root_frame
empty: no transform to the root link. A floating joint, which joint states do not have, stands at its origin: its transform
is on /tf_static until something publishes it on /tf.
"""

import math
import os
import sys
import xml.etree.ElementTree as ElementTree

import rospy
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from demo_motion import number_parameter, play_at_rate, quaternion_of, transform  # noqa: E402

AMPLITUDES = {"revolute": 0.5, "continuous": 0.5, "prismatic": 0.1}  # rad or m, at most
SHARE_OF_RANGE = 0.2                                                 # likewise
SLOWEST, FREQUENCY_STEP, FREQUENCIES = 0.07, 0.011, 7                # Hz, Hz, number


def description():
    """The text of the parameter, which is waited for; searched from this namespace upwards."""
    name = rospy.get_param("~robot_description", "robot_description")
    while not rospy.is_shutdown():
        found = rospy.search_param(name)
        if found == rospy.resolve_name("~robot_description"):  # that is the name
            found = rospy.resolve_name(name)
        text = rospy.get_param(found, None) if found else None
        if isinstance(text, str) and text.lstrip().startswith("<"):
            return text
        rospy.logwarn_throttle(5.0, "Waiting for the parameter '%s' with a robot's URDF." % name)
        rospy.rostime.wallsleep(0.1)
    sys.exit()


def numbers(element, attribute):
    text = element.get(attribute, "") if element is not None else ""
    return [float(part) for part in text.split()] or [0.0, 0.0, 0.0]


def swaying(joint, index):
    """Middle, amplitude and frequency of a joint with one axis."""
    kind = joint.get("type")
    amplitude, middle, limit = AMPLITUDES[kind], 0.0, joint.find("limit")
    if kind != "continuous" and limit is not None:
        lower, upper = sorted(float(limit.get(side, 0.0)) for side in ("lower", "upper"))
        middle = 0.5 * (lower + upper) if lower > 0.0 or upper < 0.0 else 0.0
        amplitude = min(amplitude, SHARE_OF_RANGE * (upper - lower))
        middle = min(max(middle, lower + amplitude), upper - amplitude)
    return middle, amplitude, SLOWEST + FREQUENCY_STEP * (index % FREQUENCIES)


def standing(robot, root_frame):
    """The transforms of the root link in its frame and of floating joints at their origins."""
    now, transforms = rospy.Time.now(), []
    ends = [[joint.find(side).get("link").lstrip("/") for side in ("parent", "child")] for joint in robot.findall("joint")]
    links = [link.get("name").lstrip("/") for link in robot.findall("link")]
    root = next(link for link in links if link not in [child for _, child in ends])
    if root_frame and root_frame != root:
        transforms.append(transform(root_frame, root, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), now))
    for joint, (parent, child) in zip(robot.findall("joint"), ends):
        if joint.get("type") != "floating":
            continue
        origin = joint.find("origin")
        transforms.append(transform(parent, child, numbers(origin, "xyz"), quaternion_of(*numbers(origin, "rpy")), now))
        rospy.loginfo("The floating joint '%s' stands at its origin until something publishes the transform from '%s' to "
                      "'%s' on /tf.", joint.get("name"), parent, child)
    return transforms


def main():
    rospy.init_node("robot_mover")
    motion = rospy.get_param("~motion", "zero")
    if motion not in ("zero", "sway"):
        sys.exit("%s: is %r; set it to zero or sway" % (rospy.resolve_name("~motion"), motion))
    try:
        robot = ElementTree.fromstring(description())
        joints = sorted((joint for joint in robot.findall("joint") if joint.get("type") in AMPLITUDES
                         and joint.find("mimic") is None), key=lambda joint: joint.get("name"))
        moves = [swaying(joint, index) for index, joint in enumerate(joints)]
        transforms = standing(robot, rospy.get_param("~root_frame", "world"))
    except (ElementTree.ParseError, AttributeError, StopIteration, TypeError, ValueError) as problem:
        sys.exit("robot_description: the URDF cannot be read: %s; check it with check_urdf" % problem)
    static = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
    if transforms:
        static.publish(TFMessage(transforms))
    publisher = rospy.Publisher("joint_states", JointState, queue_size=1)
    message = JointState(name=[joint.get("name") for joint in joints])

    def publish(time, now):
        message.header.stamp = now
        message.position = [middle + (amplitude * math.sin(2.0 * math.pi * frequency * time) if motion == "sway" else 0.0)
                            for middle, amplitude, frequency in moves]
        publisher.publish(message)
    play_at_rate(number_parameter("rate", 50.0, 0.1, 2000.0), publish)


if __name__ == "__main__":
    main()
