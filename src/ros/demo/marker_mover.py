#!/usr/bin/env python3
"""The demo interactive: broadcasts on tf the pose of a body that is dragged in rviz.

rosrun concave_distance marker_mover.py _parent:=FRAME _child:=FRAME [_scale:=0.35] [_rate:=100] [_x:=0 ... _yaw:=0] [_idle_motion:=true]
scale: size of the handles (m); x, y, z, roll, pitch, yaw: pose at the start; idle_motion: the body sways on its own until
it is taken hold of.
"""

import math
import os
import sys

import rospy
from geometry_msgs.msg import Pose
from interactive_markers.interactive_marker_server import InteractiveMarkerServer
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import InteractiveMarker, InteractiveMarkerControl, InteractiveMarkerFeedback

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from demo_motion import number_parameter, play_at_rate, quaternion_of, text_parameter, transform  # noqa: E402

RANGE = 1e3         # m and rad: more is a mistake
HANDLE_RATE = 30.0  # Hz: rviz starts over when it misses one of the server's messages
ANGLES = ("roll", "pitch", "yaw")
AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 0.0, 1.0), "z": (0.0, 1.0, 0.0)}  # turn of a control that acts along its x axis


def handles(parent, child, scale):
    marker = InteractiveMarker(name=child, scale=scale)
    marker.header.frame_id = parent
    for mode, word in ((InteractiveMarkerControl.MOVE_AXIS, "move"), (InteractiveMarkerControl.ROTATE_AXIS, "turn")):
        for axis, turn in AXES.items():
            control = InteractiveMarkerControl(name=axis + "_" + word, interaction_mode=mode)
            place = control.orientation
            place.x, place.y, place.z, place.w = (math.sqrt(0.5) * part for part in (*turn, 1.0))
            marker.controls.append(control)
    return marker


def swayed(position, angles, time):
    """A slow figure around the start: low at the ends, high in the middle where the comb's longest tooth is."""
    x, y, z = position
    roll, pitch, yaw = angles
    return ((x + 0.20 * math.sin(0.35 * time), y + 0.015 * math.sin(0.53 * time), z + 0.04 * math.cos(0.7 * time)),
            quaternion_of(roll, pitch, yaw + 0.12 * math.sin(0.41 * time)))


class Mover:
    def __init__(self):
        self.parent, self.child = text_parameter("parent"), text_parameter("child")
        self.start = [[number_parameter(name, 0.0, -RANGE, RANGE) for name in names] for names in ("xyz", ANGLES)]
        self.is_idle = bool(rospy.get_param("~idle_motion", True))
        self.pose = (tuple(self.start[0]), quaternion_of(*self.start[1]))
        self.shown = None  # the pose of the handles, and when they were sent
        self.publisher = rospy.Publisher("/tf", TFMessage, queue_size=2)
        self.server = InteractiveMarkerServer("interactive_body")
        self.server.insert(handles(self.parent, self.child, number_parameter("scale", 0.35, 1e-3, RANGE)), self.follow)
        self.server.applyChanges()

    def follow(self, feedback):
        if feedback.event_type == InteractiveMarkerFeedback.MOUSE_DOWN:
            self.is_idle = False
        if feedback.event_type == InteractiveMarkerFeedback.POSE_UPDATE and not self.is_idle:
            place, turn = feedback.pose.position, feedback.pose.orientation
            length = math.hypot(turn.x, turn.y, turn.z, turn.w)
            self.pose = ((place.x, place.y, place.z), tuple(part / length for part in (turn.x, turn.y, turn.z, turn.w)))

    def publish(self, time, now):
        if self.is_idle:
            self.pose = swayed(*self.start, time)
        self.publisher.publish(TFMessage([transform(self.parent, self.child, *self.pose, now)]))
        # The handles in every rviz, also in one started later, follow the body.
        is_due = self.shown is None or abs((now - self.shown[1]).to_sec()) >= 1.0 / HANDLE_RATE
        if is_due and (self.shown is None or self.shown[0] != self.pose):
            pose = Pose()
            place, turn = pose.position, pose.orientation
            (place.x, place.y, place.z), (turn.x, turn.y, turn.z, turn.w) = self.pose
            self.server.setPose(self.child, pose)
            self.server.applyChanges()
            self.shown = (self.pose, now)


def main():
    rospy.init_node("marker_mover")
    play_at_rate(number_parameter("rate", 100.0, 0.1, 2000.0), Mover().publish)


if __name__ == "__main__":
    main()
