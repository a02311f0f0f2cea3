#!/usr/bin/env python3
"""Measures the demo clouds from outside (scripts/measure.sh clouds starts it).

  measure_clouds.py [--messages 50] [--output FILE]

Publishes clouds at 5 Hz on the topic of the demo's camera, five points for each voxel, and takes the time from sending
a message to the arrival of the first distance to it: each cloud has one voxel of its own beside a body that is added
for the purpose, a step farther away than that of the cloud before, so that its distance names it. Two kinds: `surface`, a wavy
sheet with noise of a voxel, as a camera sees it, and `scattered`, every voxel by itself, the worst of that count. A row:
kind, voxels, triangles, messages sent and those that were answered before the next came; milliseconds from message to
distance (median, 90th percentile, largest); error of the distances from the voxels (largest, metres) and of the distance
to the points (largest, metres); cycle time, milliseconds, and the share of late cycles, in percent, as the diagnostics have
them, with the cloud and without; load of the machine.
"""

import argparse
import csv
import itertools
import math
import os
import sys
import threading
import time

import numpy
import rospy
from concave_distance.msg import Distances, SceneOperation
from concave_distance.srv import ApplyScene
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import PointCloud2, PointField
from shape_msgs.msg import SolidPrimitive

VOXEL = 0.03        # m, as config/clouds.yaml
PROBE = 0.1         # m, edge of the added box
HOME = numpy.array([0.0, -2.0, 0.5 * PROBE])  # middle of the box
STEPS = 12          # places of the nearest voxel
PER_VOXEL = 5       # points
RATE = 5.0          # Hz
SIZES = (1000, 10000, 50000)
STEP = itertools.count()


def nearest_voxel(step):
    """Middle of the voxel beside the box, and the distance from its near face to the box."""
    index = math.ceil((HOME[0] + 0.5 * PROBE) / VOXEL) + 1 + step % STEPS
    middle = numpy.array([(index + 0.5) * VOXEL, (math.floor(HOME[1] / VOXEL) + 0.5) * VOXEL, 0.5 * VOXEL])
    return middle, index * VOXEL - (HOME[0] + 0.5 * PROBE)


def voxels_of(kind, count, engine):
    """Indices of other cells, farther away than the nearest one ever is."""
    if kind == "surface":
        side = math.ceil(math.sqrt(count))
        x, y = numpy.meshgrid(numpy.arange(side), numpy.arange(side))
        z = numpy.round(0.06 * side * numpy.sin(6.0 * x / side) * numpy.cos(5.0 * y / side)
                        + engine.normal(0.0, 0.7, x.shape))
        cells = numpy.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)[:count]
    else:
        side = math.ceil((10.0 * count) ** (1.0 / 3.0))
        keys = engine.choice(side ** 3, count, replace=False)
        cells = numpy.stack([keys % side, keys // side % side, keys // side ** 2], axis=1)
    return cells.astype(numpy.int64) + numpy.array([0, -80 - side, 30 + (side if kind == "surface" else 0)])


def message_of(points, stamp):
    cloud = PointCloud2(height=1, width=len(points), point_step=12, row_step=12 * len(points), is_dense=True)
    cloud.header.frame_id, cloud.header.stamp = "world", stamp
    cloud.fields = [PointField(name=name, offset=4 * place, datatype=PointField.FLOAT32, count=1)
                    for place, name in enumerate("xyz")]
    cloud.data = points.astype(numpy.float32).tobytes()
    return cloud


class Listener:
    def __init__(self):
        self.lock = threading.Lock()
        self.wanted = None      # expected distance
        self.sent = 0.0
        self.answer = None      # seconds, error
        self.cycles = []
        rospy.Subscriber("concave_distance/distances", Distances, self.take, queue_size=1, tcp_nodelay=True)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.diagnose, queue_size=10)

    def expect(self, distance):
        with self.lock:
            self.wanted, self.sent, self.answer = distance, time.monotonic(), None

    def take(self, message):
        now = time.monotonic()
        with self.lock:
            if self.wanted is None or self.answer is not None:
                return
            for pair in message.pairs:
                if {pair.body_a, pair.body_b} == {"probe", "camera"} and pair.has_distance:
                    error = abs(pair.distance - self.wanted)
                    if error < 0.3 * VOXEL:
                        self.answer = (now - self.sent, error)

    def diagnose(self, message):
        for status in message.status:
            values = {value.key: value.value for value in status.values}
            if "cycle time mean (ms)" in values:
                with self.lock:
                    self.cycles.append([float(values[key]) for key in ("cycle time mean (ms)", "late cycles", "cycles")])

    def take_cycles(self):
        with self.lock:
            cycles, self.cycles = self.cycles, []
        if not cycles:
            return math.nan, math.nan
        table = numpy.array(cycles)
        return numpy.average(table[:, 0], weights=table[:, 2]), 100.0 * table[:, 1].sum() / table[:, 2].sum()


def add_probe():
    service = rospy.ServiceProxy("concave_distance/apply_scene", ApplyScene)
    service.wait_for_service(30.0)
    operation = SceneOperation(operation=SceneOperation.ADD, body="probe", frame_id="probe", pair_with=["camera"])
    operation.primitives = [SolidPrimitive(type=SolidPrimitive.BOX, dimensions=[PROBE] * 3)]
    answer = service([operation])
    while not answer.success and "not loaded yet" in answer.message:
        time.sleep(0.2)
        answer = service([operation])
    if not answer.success:
        sys.exit("measure_clouds: " + answer.message)


def place_probe():
    import tf2_ros
    from geometry_msgs.msg import TransformStamped
    broadcaster = tf2_ros.StaticTransformBroadcaster()
    transform = TransformStamped()
    transform.header.stamp = rospy.Time.now()
    transform.header.frame_id, transform.child_frame_id = "world", "probe"
    place = transform.transform.translation
    place.x, place.y, place.z = HOME
    transform.transform.rotation.w = 1.0
    broadcaster.sendTransform(transform)
    return broadcaster


def measure(kind, count, messages, publisher, listener, engine):
    cells = voxels_of(kind, count - 1, engine)
    listener.take_cycles()
    times, errors, to_points = [], [], []
    for _ in range(messages):
        begin = time.monotonic()
        middle, gap = nearest_voxel(next(STEP))
        inside = engine.uniform(-0.45, 0.45, (PER_VOXEL * len(cells), 3))
        points = VOXEL * (numpy.repeat(cells, PER_VOXEL, axis=0) + 0.5 + inside)
        own = middle + VOXEL * engine.uniform(-0.45, 0.45, (PER_VOXEL, 3))
        cloud = message_of(numpy.concatenate([points, own]), rospy.Time.now())
        listener.expect(gap)
        publisher.publish(cloud)
        while listener.answer is None and time.monotonic() - listener.sent < 5.0:
            time.sleep(0.001)
        if listener.answer is not None:
            times.append(1e3 * listener.answer[0])
            errors.append(listener.answer[1])
            outside = numpy.maximum(numpy.abs(own - HOME) - 0.5 * PROBE, 0.0)
            to_points.append(numpy.min(numpy.linalg.norm(outside, axis=1)) - gap)
        time.sleep(max(0.0, 1.0 / RATE - (time.monotonic() - begin)))
    cycle, late = listener.take_cycles()
    in_time = sum(1 for value in times if value < 1e3 / RATE)
    if not times:
        sys.exit("measure_clouds: no cloud of %d voxels was answered within five seconds" % count)
    return [kind, count, messages, in_time] + ["%.4g" % value for value in (
        numpy.median(times), numpy.percentile(times, 90), max(times), max(errors), max(to_points), cycle, late)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--messages", type=int, default=50)
    parser.add_argument("--output", default="doc/results/clouds.csv")
    options = parser.parse_args()
    rospy.init_node("measure_clouds")
    broadcaster = place_probe()
    publisher = rospy.Publisher("/camera/points", PointCloud2, queue_size=1)
    add_probe()
    listener = Listener()
    engine = numpy.random.default_rng(1)
    while publisher.get_num_connections() == 0:
        time.sleep(0.05)
    time.sleep(5.0)
    alone = listener.take_cycles()
    rows = [measure(kind, count, options.messages, publisher, listener, engine)
            for kind in ("surface", "scattered") for count in SIZES]
    del broadcaster
    load = "%.1f" % os.getloadavg()[0]
    with open(options.output, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["kind", "voxels", "messages", "answered_before_the_next", "median_ms", "p90_ms", "largest_ms",
                         "largest_error_to_voxels", "largest_difference_to_points", "cycle_ms", "late_percent",
                         "cycle_ms_without", "late_percent_without", "load"])
        writer.writerows(row + ["%.4g" % value for value in alone] + [load] for row in rows)
    print(open(options.output, encoding="utf-8").read(), end="")


if __name__ == "__main__":
    main()
