#!/usr/bin/env python3
"""What cob_twist_controller does with obstacle distances, to try the bridge without it: registers links, shows messages.

rosrun concave_distance fake_twist_controller.py __ns:=arm _links:="[wam6, wam7]"
"""
import os
import sys

import rospy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "..", "src", "ros", "bridges"))
from cob_messages import message_classes, registration_class  # noqa: E402


def show(message):
    print("%d distances" % len(message.distances))
    for one in message.distances:
        print("  %s - %s: %.4f m in %s, link at (%.3f %.3f %.3f), nearest points (%.3f %.3f %.3f) and (%.3f %.3f %.3f)" % (
            one.link_of_interest, one.obstacle_id, one.distance, one.header.frame_id,
            *[number for vector in (one.frame_vector, one.nearest_point_frame_vector, one.nearest_point_obstacle_vector)
              for number in (vector.x, vector.y, vector.z)]))
    sys.stdout.flush()


def main():
    rospy.init_node("fake_twist_controller")
    register = rospy.ServiceProxy("obstacle_distance/registerLinkOfInterest", registration_class())
    register.wait_for_service()
    for link in rospy.get_param("~links", []):
        answer = register(link)
        while not answer.success and not rospy.is_shutdown():  # The distance node may not be there yet.
            print(answer.message)
            rospy.sleep(1.0)
            answer = register(link)
        print(answer.message)
    rospy.Subscriber("obstacle_distance", message_classes()[0], show, queue_size=1)
    rospy.spin()
    return 0


if __name__ == "__main__":
    sys.exit(main())
