#!/usr/bin/env python3
"""The demo cell: puts a part into the crate, attaches it to the hand there, detaches it where the path puts it down.

rosrun concave_distance pick_parts.py _path:=FILE.csv _pick:=SECONDS _place:=SECONDS
Watches joint_states: at the joint positions that the path has at `pick` the part is attached, at those of `place`
detached; at those of its beginning the part is taken away and the next one comes. Each step is one batch of
apply_scene. Prints the alerts of the group `hand`, to which the part belongs while the hand holds it.
"""

import csv
import os
import sys

import rospkg
import rospy
from concave_distance.msg import Alert, SceneOperation
from concave_distance.srv import ApplyScene, ApplySceneRequest
from sensor_msgs.msg import JointState
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import ColorRGBA

PART = "part"
SIZE = (0.06, 0.06, 0.16)        # m
IN_CRATE = (0.30, 0.74, 0.099)   # its middle: 4 mm above the crate's floor
NEAR = 0.004                     # rad, every joint
ORANGE = ColorRGBA(0.93, 0.49, 0.16, 1.0)
STATES = {Alert.CLEAR: "clear", Alert.WARNING: "near", Alert.UNKNOWN: "unknown"}


def joints_at(path, times):
    """Joint positions by name at times of the path, linear between its rows."""
    with open(path, newline="") as stream:
        rows = list(csv.reader(stream))
    names, table = rows[0][1:], [[float(cell) for cell in row] for row in rows[1:]]
    found = []
    for time in times:
        after = next(index for index, row in enumerate(table) if row[0] > time)
        before = table[after - 1]
        share = (time - before[0]) / (table[after][0] - before[0])
        found.append({name: before[place] + share * (table[after][place] - before[place])
                      for place, name in enumerate(names, 1)})
    return found


class Picker:
    """The part is `gone`, in the `crate`, in the `hand` or put `down`."""

    def __init__(self, stations):
        self.home, self.pick, self.place = stations
        self.part = "gone"
        self.service = rospy.ServiceProxy("concave_distance/apply_scene", ApplyScene)
        rospy.Subscriber("concave_distance/groups/hand/alerts", Alert, self.tell, queue_size=10)
        rospy.Subscriber("joint_states", JointState, self.watch, queue_size=1)

    @staticmethod
    def tell(alert):
        nearest = alert.nearest
        rospy.loginfo("hand: %s; %s and %s, %s", STATES[alert.state], nearest.body_a, nearest.body_b,
                      "%.3f m" % nearest.distance if nearest.has_distance else "no distance")

    def apply(self, said, *operations):
        try:
            response = self.service(ApplySceneRequest(operations=list(operations)))
        except rospy.ServiceException as problem:
            rospy.logwarn_throttle(5.0, "apply_scene: %s" % problem)
            return False
        if not response.success:
            rospy.logwarn_throttle(5.0, "apply_scene: %s" % response.message)
            return False
        rospy.loginfo("%s (revision %d)", said, response.revision)
        return True

    def added(self):
        part = SceneOperation(operation=SceneOperation.ADD, body=PART, frame_id="world", color=ORANGE)
        part.primitives = [SolidPrimitive(type=SolidPrimitive.BOX, dimensions=SIZE)]
        part.pose.position.x, part.pose.position.y, part.pose.position.z = IN_CRATE
        part.pose.orientation.w = 1.0
        return part

    def watch(self, joints):
        now = dict(zip(joints.name, joints.position))

        def is_at(station):
            return all(abs(now.get(name, 10.0) - position) < NEAR for name, position in station.items())
        step = None
        if self.part == "gone":
            step = ("a part comes into the crate", "crate", self.added())
        elif self.part == "crate" and is_at(self.pick):
            step = ("the hand takes the part", "hand", SceneOperation(
                operation=SceneOperation.ATTACH, body=PART, other="wam7", touch_links=["wam6"]))
        elif self.part == "hand" and is_at(self.place):
            step = ("the hand leaves the part on the carton", "down",
                    SceneOperation(operation=SceneOperation.DETACH, body=PART))
        elif self.part == "down" and is_at(self.home):
            step = ("the part is taken away, the next one comes into the crate", "crate",
                    SceneOperation(operation=SceneOperation.REMOVE, body=PART), self.added())
        if step and self.apply(step[0], *step[2:]):
            self.part = step[1]


def main():
    rospy.init_node("pick_parts")
    path = rospy.get_param("~path")
    if path.startswith("package://"):
        package, _, below = path[len("package://"):].partition("/")
        path = os.path.join(rospkg.RosPack().get_path(package), below)
    stations = joints_at(path, (0.0, rospy.get_param("~pick"), rospy.get_param("~place")))
    rospy.wait_for_service("concave_distance/apply_scene")
    Picker(stations)
    rospy.spin()
    return 0


if __name__ == "__main__":
    sys.exit(main())
