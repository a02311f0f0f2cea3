#!/usr/bin/env python3
"""The demo robot: publishes joint states along a closed path of joint positions.

rosrun concave_distance joint_player.py _path:=FILE.csv [_rate:=100] [_speed:=1] [_start:=0]
The file's first line is t,<joint>,<joint>,...; its last row repeats the first one and gives the period.
"""

import os
import sys

import rospy
from sensor_msgs.msg import JointState

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from demo_motion import JointPath, number_parameter, play_at_rate, table_parameter  # noqa: E402


def main():
    rospy.init_node("joint_player")
    names, table = table_parameter("path")
    path = JointPath(table)
    speed, start = number_parameter("speed", 1.0, 0.0, 100.0), number_parameter("start", 0.0, 0.0, 3600.0)
    publisher = rospy.Publisher("joint_states", JointState, queue_size=1)
    message = JointState(name=names[1:])

    def publish(time, now):
        message.header.stamp, message.position = now, path.at(start + speed * time).tolist()
        publisher.publish(message)
    play_at_rate(number_parameter("rate", 100.0, 0.1, 2000.0), publish)


if __name__ == "__main__":
    main()
