#!/usr/bin/env python3
"""A bag of the demo robot is played to a real node, each stamp until it is answered; distance_bag, which answers the same bag
offline, has the same answers."""
import copy
import csv
import math
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import genpy
import rosbag
import roslib.packages
import rospy
import rostest
from concave_distance.msg import Niches, PairStatus
from rosgraph_msgs.msg import Clock
from tf2_msgs.msg import TFMessage

PACKAGE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__)))))
STAMPS = 150
RATE = 50.0             # Hz
ROUNDING = 1e-12        # m
PREPARING_STEP = 0.005  # s
CLOCK_STEP = 0.0005     # s, far less than between two stamps
MOST_AHEAD = 0.015      # s that the clock may be ahead of a stamp
BETWEEN_STEPS = 0.002   # s of wall time


class Player:
    """Publishes the messages of a bag and holds the clock until the node has answered."""

    def __init__(self, path):
        self.clock = rospy.Publisher("/clock", Clock, queue_size=10)
        self.moving = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self.fixed = rospy.Publisher("/tf_static", TFMessage, queue_size=100, latch=True)
        self.moves, self.stands = [], []
        with rosbag.Bag(path) as bag:
            for topic, message, _ in bag.read_messages():
                (self.moves if topic == "/tf" else self.stands).append(message)

    def stamp(self, index):
        return self.moves[index].transforms[0].header.stamp

    def step(self, begin, step, end, is_done, before_each=lambda now: None):
        """Steps the clock on until the condition holds."""
        deadline, ahead = time.monotonic() + 60.0, 0.0
        while not is_done():
            if time.monotonic() > deadline:
                return False
            now = begin + genpy.Duration.from_sec(ahead)
            before_each(now)
            self.clock.publish(Clock(now))
            ahead = min(ahead + step, end)
            time.sleep(BETWEEN_STEPS)
        return True

    def stand_before(self, seconds, is_ready):
        """Stands where the bag begins, from so many seconds before. The node refuses transforms until its clock has come
        there: they are sent again and again."""
        message = copy.deepcopy(self.moves[0])

        def send(now):
            for transform in message.transforms:
                transform.header.stamp = now
            self.moving.publish(message)
        return self.step(self.stamp(0) - genpy.Duration.from_sec(seconds), PREPARING_STEP, 0.8 * seconds, is_ready, send)

    def play(self, index, is_answered):
        self.moving.publish(self.moves[index])
        return self.step(self.stamp(index), CLOCK_STEP, MOST_AHEAD, is_answered)


def solved(message):
    return [pair for pair in message.pairs if pair.nearest.has_distance]


def points_of(answer):
    return {name + axis: getattr(getattr(answer, field), axis) for name, field in (
        ("a", "point_a"), ("b", "point_b"), ("n", "normal")) for axis in "xyz"}


class Bags(unittest.TestCase):
    def setUp(self):
        self.last = None
        self.lock = threading.Lock()
        rospy.Subscriber("/concave_distance/niches", Niches, self.take, queue_size=100)

    def take(self, message):
        with self.lock:
            self.last = message

    def is_of(self, is_right):
        """Every pair that the last message solves has a whole list, and a stamp that is right."""
        with self.lock:
            pairs = solved(self.last) if self.last else []
        return bool(pairs) and all(pair.niches_complete and is_right(pair.header.stamp) for pair in pairs)

    def expect_same(self, row, answer):
        numbers = dict(points_of(answer), distance=answer.distance)
        for name, value in numbers.items():
            found = float(row[name]) if row[name] else math.nan
            if not (math.isnan(found) and math.isnan(value)):
                self.assertLessEqual(abs(found - value), ROUNDING, "%s of %s" % (name, row))

    def test_distance_bag_gives_the_nodes_answers_on_the_same_stamps(self):
        folder = tempfile.mkdtemp()
        bag = os.path.join(folder, "run.bag")
        subprocess.run([sys.executable, os.path.join(PACKAGE, "scripts", "write_robot_bag.py"), "--output", bag,
                        "--seconds", str(STAMPS / RATE), "--rate", str(RATE)], check=True)
        player = Player(bag)
        self.assertEqual(len(player.moves), STAMPS)
        deadline = time.monotonic() + 60.0
        while not (player.moving.get_num_connections() and player.fixed.get_num_connections()):
            self.assertLess(time.monotonic(), deadline, "the node does not listen")
            time.sleep(BETWEEN_STEPS)
        for message in player.stands:
            player.fixed.publish(message)
        first = player.stamp(0)
        # Until then the node gives distances alone, because it prepares the bodies for niches; and its clock and the clock
        # of its transforms have to be near the first stamp.
        for seconds in (60.0, 0.5):
            begin = first - genpy.Duration.from_sec(seconds)
            self.assertTrue(player.stand_before(seconds, lambda: self.is_of(lambda stamp: stamp >= begin)))
        of_node = {}
        for index in range(STAMPS):
            stamp = player.stamp(index)
            self.assertTrue(player.play(index, lambda: self.is_of(lambda found: found == stamp)), "stamp %d" % index)
            with self.lock:
                for pair in solved(self.last):
                    of_node[pair.nearest.pair, "%d.%09d" % (stamp.secs, stamp.nsecs)] = pair
                self.last = None
        rows, niches = (os.path.join(folder, name) for name in ("d.csv", "n.csv"))
        subprocess.run([roslib.packages.find_node("concave_distance", "distance_bag")[0], "--bag", bag, "--scene",
                        os.path.join(PACKAGE, "config", "robot.yaml"), "--robot-description",
                        os.path.join(PACKAGE, "urdf", "wam.urdf"), "--output", rows, "--niches-output", niches], check=True)
        lists = {}
        with open(niches, newline="") as stream:
            for row in csv.DictReader(stream):
                lists.setdefault((row["pair"], row["stamp"]), []).append(row)
        compared = 0
        with open(rows, newline="") as stream:
            for row in csv.DictReader(stream):
                if not row["distance"]:
                    continue
                answer = of_node[row["pair"], row["stamp"]]
                self.assertEqual((row["status"], answer.nearest.status.code), ("ok", PairStatus.OK))
                self.assertEqual(row["warning"], str(int(answer.nearest.warning)))
                self.expect_same(row, answer.nearest)
                self.assertLessEqual(abs(float(row["lower_bound"]) - answer.nearest.lower_bound), ROUNDING)
                found = lists.get((row["pair"], row["stamp"]), [])
                self.assertEqual(len(found), len(answer.niches))
                for niche_row, niche in zip(found, answer.niches):
                    self.expect_same(niche_row, niche)
                    self.assertEqual(niche_row["visible"], str(int(niche.visible)))
                compared += 1
        self.assertEqual(compared, len(of_node), "no answer of the node is missing")
        self.assertGreater(compared, 5 * STAMPS)


if __name__ == "__main__":
    rospy.init_node("bags_rostest")
    rostest.rosrun("concave_distance", "bags", Bags)
