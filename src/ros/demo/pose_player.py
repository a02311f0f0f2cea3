#!/usr/bin/env python3
"""The demos insertion and contact: plays the poses of a CSV file on tf, forwards and backwards without end.

rosrun concave_distance pose_player.py _poses:=FILE.csv _parent:=FRAME _child:=FRAME [_rate:=200] [_speed:=1] [_pause:=1] [_start:=0]
pause: seconds of rest at either end; start: seconds into the path.
"""

import os
import sys

import rospy
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from demo_motion import (  # noqa: E402
    PosePath, number_parameter, play_at_rate, table_parameter, text_parameter, to_and_fro, transform)


def main():
    rospy.init_node("pose_player")
    path = PosePath(table_parameter("poses")[1])
    parent, child = text_parameter("parent"), text_parameter("child")
    speed, start = number_parameter("speed", 1.0, 0.0, 100.0), number_parameter("start", 0.0, 0.0, 3600.0)
    pause = number_parameter("pause", 1.0, 0.0, 3600.0)
    publisher = rospy.Publisher("/tf", TFMessage, queue_size=2)
    first, last = path.times[0], path.times[-1]

    def publish(time, now):
        pose = path.at(first + to_and_fro(start + speed * time, last - first, pause))
        publisher.publish(TFMessage([transform(parent, child, *pose, now)]))
    play_at_rate(number_parameter("rate", 200.0, 0.1, 2000.0), publish)


if __name__ == "__main__":
    main()
