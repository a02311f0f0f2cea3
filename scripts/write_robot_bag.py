#!/usr/bin/python3
"""Writes a bag of a robot that follows a path of joint positions, as robot_state_publisher publishes it on tf.

    scripts/write_robot_bag.py --output run.bag [--urdf urdf/wam.urdf] [--path config/wam_path.csv] [--seconds 600]
                               [--rate 100] [--root-frame world] [--compression none]

The path is a CSV file, t and the joints, in seconds and radians; it is repeated. Joints
that move are on /tf, one message of all at each time, fixed ones and the root on /tf_static. The same arguments write the
same transforms.
"""
import argparse
import csv
import math
import pathlib
import xml.etree.ElementTree

import numpy
import rosbag
import rospy
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

ROOT = pathlib.Path(__file__).resolve().parent.parent
BEGIN = rospy.Time(1700000000, 0)


def numbers(text):
    return [float(part) for part in text.split()]


def product(p, q):
    """Of quaternions x, y, z, w."""
    return (p[3] * q[0] + p[0] * q[3] + p[1] * q[2] - p[2] * q[1],
            p[3] * q[1] - p[0] * q[2] + p[1] * q[3] + p[2] * q[0],
            p[3] * q[2] + p[0] * q[1] - p[1] * q[0] + p[2] * q[3],
            p[3] * q[3] - p[0] * q[0] - p[1] * q[1] - p[2] * q[2])


def about(axis, angle):
    length = math.sqrt(sum(part * part for part in axis))
    scale = math.sin(0.5 * angle) / length
    return (axis[0] * scale, axis[1] * scale, axis[2] * scale, math.cos(0.5 * angle))


class Joint:
    def __init__(self, element):
        self.name = element.get("name")
        self.parent = element.find("parent").get("link")
        self.child = element.find("child").get("link")
        self.kind = element.get("type")
        origin = element.find("origin")
        self.offset = numbers(origin.get("xyz", "0 0 0")) if origin is not None else [0.0, 0.0, 0.0]
        roll, pitch, yaw = numbers(origin.get("rpy", "0 0 0")) if origin is not None else (0.0, 0.0, 0.0)
        self.turn = product(product(about((0, 0, 1), yaw), about((0, 1, 0), pitch)), about((1, 0, 0), roll))
        axis = element.find("axis")
        self.axis = numbers(axis.get("xyz")) if axis is not None else [1.0, 0.0, 0.0]
        if self.kind not in ("fixed", "revolute", "continuous"):
            raise SystemExit("joint %s is %s: this script knows fixed, revolute and continuous ones" % (self.name, self.kind))

    def transform(self, angle, stamp):
        message = TransformStamped()
        message.header.stamp = stamp
        message.header.frame_id = self.parent
        message.child_frame_id = self.child
        translation, rotation = message.transform.translation, message.transform.rotation
        translation.x, translation.y, translation.z = self.offset
        turn = self.turn if self.kind == "fixed" else product(self.turn, about(self.axis, angle))
        rotation.x, rotation.y, rotation.z, rotation.w = turn
        return message


class Path:
    """A path of joints that begins anew at its end, smooth as joint_player's: cubics between its lines."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as stream:
            rows = list(csv.reader(stream))
        self.names = rows[0][1:]
        table = numpy.array(rows[1:], dtype=float)
        self.times, self.points = table[:, 0] - table[0, 0], table[:, 1:]
        steps = numpy.diff(self.times)
        count = len(steps)
        # Equal second derivatives from both sides of every line.
        system, right = numpy.zeros((count, count)), numpy.zeros((count, self.points.shape[1]))
        for i in range(count):
            before, after = steps[i - 1], steps[i]
            system[i, i - 1] += 1 / before
            system[i, i] += 2 / before + 2 / after
            system[i, (i + 1) % count] += 1 / after
            right[i] = 3 * ((self.points[i] - self.points[i - 1 if i else count - 1]) / before**2
                            + (self.points[i + 1] - self.points[i]) / after**2)
        velocities = numpy.linalg.solve(system, right)
        self.velocities = numpy.vstack([velocities, velocities[:1]])

    def at(self, time):
        """{joint: position}"""
        time = math.fmod(time, self.times[-1])
        i = int(numpy.searchsorted(self.times, time, side="right")) - 1
        step = self.times[i + 1] - self.times[i]
        s = (time - self.times[i]) / step
        positions = ((1 + 2 * s) * (1 - s)**2 * self.points[i] + s * (1 - s)**2 * step * self.velocities[i]
                     + s * s * (3 - 2 * s) * self.points[i + 1] + s * s * (s - 1) * step * self.velocities[i + 1])
        return dict(zip(self.names, positions.tolist()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", required=True)
    parser.add_argument("--urdf", default=ROOT / "urdf/wam.urdf")
    parser.add_argument("--path", default=ROOT / "config/wam_path.csv")
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--rate", type=float, default=100.0, help="messages per second")
    parser.add_argument("--root-frame", default="world")
    parser.add_argument("--compression", choices=("none", "bz2", "lz4"), default="none")
    options = parser.parse_args()
    robot = xml.etree.ElementTree.parse(options.urdf).getroot()
    joints = [Joint(element) for element in robot.findall("joint")]
    path = Path(options.path)
    moving = [joint for joint in joints if joint.kind != "fixed"]
    unknown = [joint.name for joint in moving if joint.name not in path.names]
    if unknown:
        raise SystemExit("%s: no column of %s" % (options.path, ", ".join(unknown)))
    children = {joint.child for joint in joints}
    root = next(link.get("name") for link in robot.findall("link") if link.get("name") not in children)
    standing = [joint.transform(0.0, BEGIN) for joint in joints if joint.kind == "fixed"]
    if root != options.root_frame:
        standing.append(TransformStamped(child_frame_id=root))
        standing[-1].header.frame_id = options.root_frame
        standing[-1].header.stamp = BEGIN
        standing[-1].transform.rotation.w = 1.0
    with rosbag.Bag(options.output, "w", compression=options.compression) as bag:
        if standing:
            bag.write("/tf_static", TFMessage(standing), BEGIN)
        for step in range(round(options.seconds * options.rate)):
            time = step / options.rate
            stamp = BEGIN + rospy.Duration.from_sec(time)
            angles = path.at(time)
            bag.write("/tf", TFMessage([joint.transform(angles[joint.name], stamp) for joint in moving]), stamp)


if __name__ == "__main__":
    main()
