#!/usr/bin/env python3
"""Prints what the node measures, some lines a second: the nearest pair with its niches, and which came and went.

rosrun concave_distance show_distances.py [_topic:=concave_distance/niches] [_rate:=2] [_pairs:=1]
                                          [_least_messages:=0] [_seconds:=0]
Each line begins with the time of the transforms, in seconds since those of the first message. With _seconds it ends after that time, with status 1 unless _least_messages messages with a distance have come.
"""

import sys
import threading
import time

import rospy
from concave_distance.msg import NicheChange, Niches, PairStatus

EVENT_VERBS = {NicheChange.BIRTH: "new", NicheChange.DEATH: "gone", NicheChange.MERGE: "merged"}


def line_of(pair, with_niches=True):
    """One pair in one readable line."""
    nearest = pair.nearest
    if not nearest.has_distance:
        return "{:<32} no distance: {}".format(nearest.pair, nearest.status.message or nearest.status.code)
    touching = "  PENETRATING" if nearest.status.code == PairStatus.PENETRATING else ""
    line = "{:<32} {:8.4f} m{}  {} niche{}".format(
        nearest.pair, nearest.distance, touching, len(pair.niches), "" if len(pair.niches) == 1 else "s")
    if with_niches and pair.niches:
        line += ":" + "".join("  #{} {:.4f}".format(niche.id, niche.distance) for niche in pair.niches[:12])
        if len(pair.niches) > 12:
            line += "  and {} farther".format(len(pair.niches) - 12)
    return line


class Printer:
    def __init__(self, rate, pairs):
        self.period = 1.0 / rate
        self.pairs = pairs
        self.printed_at = 0.0
        self.first_stamp = None
        self.events = []
        self.solved_messages = 0
        self.lock = threading.Lock()

    def receive(self, message):
        with self.lock:
            for pair in message.pairs:
                self.events += [(pair.nearest.pair, event) for event in pair.changes]
            if any(pair.nearest.has_distance for pair in message.pairs):
                self.solved_messages += 1
            if time.monotonic() - self.printed_at >= self.period:
                self.printed_at = time.monotonic()
                self.show(message)

    def seconds_since_start(self, stamp):
        """Of ROS time; a clock that jumps back starts again."""
        if self.first_stamp is None or stamp < self.first_stamp:
            self.first_stamp = stamp
        return (stamp - self.first_stamp).to_sec()

    def show(self, message):
        moment = "{:9.2f} s".format(self.seconds_since_start(message.header.stamp))
        by_distance = sorted(message.pairs, key=lambda pair: pair.nearest.distance if pair.nearest.has_distance
                             else float("inf"))
        for index, pair in enumerate(by_distance[:self.pairs]):
            print("{}  {}".format(moment if index == 0 else " " * 11, line_of(pair)))
        if len(by_distance) > self.pairs:
            print("{}  ({} pairs are watched)".format(" " * 11, len(by_distance)))
        shown = {pair.nearest.pair for pair in by_distance[:self.pairs]}
        events = ["{} #{}{}".format(EVENT_VERBS.get(event.kind, "?"), event.id,
                                    " into #{}".format(event.into_id) if event.kind == NicheChange.MERGE else "")
                  for name, event in self.events if name in shown]
        self.events = []
        if events:
            print("{}  {}{}".format(" " * 11, ", ".join(events[:10]), ", ..." if len(events) > 10 else ""))
        sys.stdout.flush()


def main():
    rospy.init_node("show_distances", anonymous=True)
    printer = Printer(max(0.1, rospy.get_param("~rate", 2.0)), max(1, rospy.get_param("~pairs", 1)))
    seconds = rospy.get_param("~seconds", 0.0)
    least_messages = rospy.get_param("~least_messages", 0)
    topic = rospy.get_param("~topic", "concave_distance/niches")
    rospy.Subscriber(topic, Niches, printer.receive, queue_size=1000)
    started = time.monotonic()
    complained = started
    while not rospy.is_shutdown() and not (seconds and time.monotonic() - started >= seconds):
        time.sleep(0.1)
        with printer.lock:
            silent = printer.printed_at == 0.0
        if silent and time.monotonic() - complained > 5.0:
            complained = time.monotonic()
            print("  still waiting for {} ...".format(rospy.resolve_name(topic)))
            sys.stdout.flush()
    if printer.solved_messages < least_messages:
        print("only {} messages with a distance came on {}, expected {}".format(
            printer.solved_messages, rospy.resolve_name(topic), least_messages))
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
