#!/usr/bin/env python3
"""Opens rviz with a view of all bodies that the distance node serves, however large the robot is.

rosrun concave_distance view_robot.py CONFIG FRAME [arguments of rviz ...]
CONFIG: rviz's configuration, whose camera and grid are fitted; FRAME: its fixed frame. Waits for the bodies of the node
`concave_distance`, in this namespace, and for their frames; when they do not come, rviz opens with the view of CONFIG.
"""

import itertools
import math
import os
import sys
import time

import rospkg
import rospy
import tf2_ros
import yaml
from concave_distance.srv import ListBodies

LOADING_SECONDS = 60.0  # at most, until the bodies are loaded
FRAMES_SECONDS = 5.0  # at most, until their frames are known
MUCH_LARGER = 6.0  # than the median body: a floor, a hall, which need not be in view
ASPECT = 1.3  # width of the picture over its height, at least
MARGIN = 1.12  # of the distance from which all stands in the picture
HALF = 0.4  # of the cube that stands for a body, over the body's diameter
GRID_CELLS = 8.0  # along the robot's size


def fitted_view(bodies, yaw, pitch, field_of_view):
    """Focal point, camera distance, size and lowest height of a robot.

    bodies: (position of its frame, diameter) of each, metres, in the fixed frame. Where a body lies about its frame is not
    known, so it counts as a cube around it.
    """
    median = sorted(diameter for _, diameter in bodies)[len(bodies) // 2]
    bodies = [body for body in bodies if body[1] <= MUCH_LARGER * median]
    low = [min(position[axis] - HALF * diameter for position, diameter in bodies) for axis in range(3)]
    high = [max(position[axis] + HALF * diameter for position, diameter in bodies) for axis in range(3)]
    size = math.dist(low, high)
    focus = [0.5 * (a + b) for a, b in zip(low, high)]
    back = (math.cos(yaw) * math.cos(pitch), math.sin(yaw) * math.cos(pitch), math.sin(pitch))
    up = (-math.cos(yaw) * math.sin(pitch), -math.sin(yaw) * math.sin(pitch), math.cos(pitch))
    right = (-math.sin(yaw), math.cos(yaw), 0.0)
    points = [[a - b for a, b in zip(corner, focus)] for corner in itertools.product(*zip(low, high))]
    tangent = math.tan(0.5 * field_of_view)

    def distance(point):
        along, above, beside = (sum(a * b for a, b in zip(axis, point)) for axis in (back, up, right))
        return along + max(abs(above), abs(beside) / ASPECT) / tangent

    return focus, MARGIN * max(map(distance, points)), size, low[2]


def round_length(length):
    """1, 2.5 or 5 times a power of ten, not above the length."""
    power = 10.0 ** math.floor(math.log10(length))
    return max(step * power for step in (1.0, 2.5, 5.0) if step * power <= length)


def fit(config, bodies):
    """Fits camera and grid of rviz's configuration to the bodies."""
    view = config["Visualization Manager"]["Views"]["Current"]
    focus, distance, size, low = fitted_view(bodies, view["Yaw"], view["Pitch"], view["Field of View"])
    view["Focal Point"] = dict(zip("XYZ", focus))
    view["Near Clip Distance"] = 0.003 * distance
    view["Distance"] = distance
    for display in config["Visualization Manager"]["Displays"]:
        if display["Class"] == "rviz/Grid":
            display["Cell Size"] = round_length(size / GRID_CELLS)
            display["Offset"]["Z"] = low


def loaded_bodies(deadline):
    list_bodies = rospy.ServiceProxy("concave_distance/list_bodies", ListBodies)
    while time.monotonic() < deadline and not rospy.is_shutdown():
        try:
            answer = list_bodies()
            if answer.ready:
                return answer.bodies
        except rospy.ServiceException:  # not there yet
            pass
        time.sleep(0.2)
    return []


def located_bodies(bodies, frame):
    """(position, diameter) of the bodies whose frames are known in time."""
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer)
    deadline = time.monotonic() + FRAMES_SECONDS
    located = {}
    while len(located) < len(bodies) and time.monotonic() < deadline and not rospy.is_shutdown():
        for body in bodies:
            if body.name not in located and buffer.can_transform(frame, body.frame_id, rospy.Time(0)):
                place = buffer.lookup_transform(frame, body.frame_id, rospy.Time(0)).transform.translation
                located[body.name] = ((place.x, place.y, place.z), body.diameter)
        time.sleep(0.1)
    listener.unregister()
    return list(located.values())


def main():
    arguments = rospy.myargv(sys.argv)
    if len(arguments) < 3:
        sys.exit(__doc__)
    path, frame = arguments[1:3]
    # Without the remappings, which give the name to rviz.
    rospy.init_node("view_robot", argv=[], anonymous=True, disable_signals=True)
    bodies = located_bodies(loaded_bodies(time.monotonic() + LOADING_SECONDS), frame)
    rospy.signal_shutdown("rviz takes over")
    if bodies:
        with open(path) as stream:
            config = yaml.safe_load(stream)
        fit(config, bodies)
        path = os.path.join(rospkg.get_ros_home(), "view_robot%s.rviz" % rospy.get_namespace().replace("/", "_"))
        with open(path, "w") as stream:
            yaml.safe_dump(config, stream)
    remappings = [argument for argument in sys.argv[1:] if ":=" in argument]
    os.execvp("rviz", ["rviz", "-d", path, "-f", frame] + arguments[3:] + remappings)


if __name__ == "__main__":
    main()
