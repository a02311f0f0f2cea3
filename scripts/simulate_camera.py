#!/usr/bin/env python3
"""The demo clouds: a depth camera beside the arm sees a ball that comes and goes, the floor, and the arm itself.

rosrun concave_distance simulate_camera.py [_rate:=5] [_width:=80] [_height:=60] [_still:=true]
Publishes /camera/points (sensor_msgs/PointCloud2, with 2 mm of noise) and the static transform of its frame; at rate
0 that transform alone. Still, the ball is at rest and the noise is that of one picture. The links of the arm count as capsules between the origins of their frames, which is all that this camera knows of them.
"""

import math
import struct

import numpy
import rospy
import tf2_ros
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import PointCloud2, PointField

EYE = numpy.array([1.9, -0.9, 1.3])     # m, in the world
LOOKS_AT = numpy.array([0.35, 0.1, 0.6])
OPENING = 1.0                           # rad, from left to right
BALL_RADIUS = 0.14                      # m
ARM_RADIUS = 0.06                       # m
NOISE = 0.002                           # m
FARTHEST = 4.0                          # m
LINKS = ["wam_base", "wam1", "wam2", "wam3", "wam4", "wam5", "wam6", "wam7"]


def axes():
    """Right, down and forward in the world, as columns: a camera's optical frame."""
    forward = (LOOKS_AT - EYE) / numpy.linalg.norm(LOOKS_AT - EYE)
    right = numpy.cross(forward, [0.0, 0.0, 1.0])
    right /= numpy.linalg.norm(right)
    return numpy.stack([right, numpy.cross(forward, right), forward], axis=1)


def quaternion_of(matrix):
    """x, y, z, w of a rotation whose trace is not near -1."""
    w = 0.5 * math.sqrt(1.0 + numpy.trace(matrix))
    return [(matrix[2, 1] - matrix[1, 2]) / (4 * w), (matrix[0, 2] - matrix[2, 0]) / (4 * w),
            (matrix[1, 0] - matrix[0, 1]) / (4 * w), w]


def ball_at(time):
    return numpy.array([0.75 + 0.18 * math.sin(0.5 * time), 0.25 * math.cos(0.35 * time), 0.75 + 0.1 * math.sin(0.8 * time)])


def to_spheres(rays, centre, radius):
    """Distances along rays from the eye to a sphere; infinite where they miss it."""
    to_centre = centre - EYE
    along = rays @ to_centre
    inside = along ** 2 - to_centre @ to_centre + radius ** 2
    return numpy.where((inside >= 0.0) & (along > 0.0), along - numpy.sqrt(numpy.maximum(inside, 0.0)), numpy.inf)


class Camera:
    def __init__(self):
        width, height = rospy.get_param("~width", 80), rospy.get_param("~height", 60)
        columns = numpy.tan(0.5 * OPENING) * numpy.linspace(-1.0, 1.0, width)
        rows = numpy.tan(0.5 * OPENING) * height / width * numpy.linspace(-1.0, 1.0, height)
        grid = numpy.stack(numpy.meshgrid(columns, rows), axis=-1).reshape(-1, 2)
        self.local = numpy.concatenate([grid, numpy.ones((len(grid), 1))], axis=1)
        self.local /= numpy.linalg.norm(self.local, axis=1, keepdims=True)
        self.rays = self.local @ axes().T
        self.engine = numpy.random.default_rng(1)
        self.still = rospy.get_param("~still", False)
        self.buffer = tf2_ros.Buffer()
        tf2_ros.TransformListener(self.buffer)
        self.publisher = rospy.Publisher("camera/points", PointCloud2, queue_size=1)
        tf2_ros.StaticTransformBroadcaster().sendTransform(self.mount())

    @staticmethod
    def mount():
        transform = TransformStamped()
        transform.header.stamp = rospy.Time.now()
        transform.header.frame_id, transform.child_frame_id = "world", "camera_optical"
        place, turn = transform.transform.translation, transform.transform.rotation
        place.x, place.y, place.z = EYE
        turn.x, turn.y, turn.z, turn.w = quaternion_of(axes())
        return transform

    def arm(self, stamp):
        """Points along the arm, 2 cm apart, where tf has its links at this time."""
        origins = []
        for link in LINKS:
            try:
                place = self.buffer.lookup_transform("world", link, stamp, rospy.Duration(0.05)).transform.translation
            except (tf2_ros.LookupException, tf2_ros.ConnectivityException, tf2_ros.ExtrapolationException):
                continue
            origins.append(numpy.array([place.x, place.y, place.z]))
        points = []
        for start, end in zip(origins, origins[1:]):
            steps = max(1, int(numpy.linalg.norm(end - start) / 0.02))
            points += [start + (end - start) * step / steps for step in range(steps)]
        return points

    def look(self, _event):
        stamp = rospy.Time.now()
        if self.still:
            self.engine = numpy.random.default_rng(1)
        ball = ball_at(0.0 if self.still else stamp.to_sec())
        depth = to_spheres(self.rays, ball, BALL_RADIUS)
        down = self.rays[:, 2]
        depth = numpy.minimum(depth, numpy.where(down < -1e-6, -EYE[2] / numpy.minimum(down, -1e-6), numpy.inf))
        for point in self.arm(stamp):
            depth = numpy.minimum(depth, to_spheres(self.rays, point, ARM_RADIUS))
        seen = depth < FARTHEST
        depth = numpy.where(seen, depth, numpy.nan) + self.engine.normal(0.0, NOISE, len(depth))
        points = (self.local * depth[:, None]).astype(numpy.float32)
        self.publisher.publish(self.message(points, stamp))

    @staticmethod
    def message(points, stamp):
        cloud = PointCloud2(height=1, width=len(points), point_step=12, row_step=12 * len(points), is_dense=False)
        cloud.header.frame_id, cloud.header.stamp = "camera_optical", stamp
        cloud.fields = [PointField(name=name, offset=4 * place, datatype=PointField.FLOAT32, count=1)
                        for place, name in enumerate("xyz")]
        cloud.is_bigendian = struct.pack("=H", 1) == b"\0\1"
        cloud.data = points.tobytes()
        return cloud


def main():
    rospy.init_node("simulate_camera")
    camera = Camera()
    rate = rospy.get_param("~rate", 5.0)
    if rate > 0.0:
        rospy.Timer(rospy.Duration(1.0 / rate), camera.look)
    rospy.spin()


if __name__ == "__main__":
    main()
