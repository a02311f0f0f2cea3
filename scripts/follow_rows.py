#!/usr/bin/env python3
"""Moves a simulated robot to a goal, kept clear by the rows of `constraints`: with all of them, or with the nearest only.

roslaunch concave_distance rows.launch [scene:=clamp|arm] [rows:=both|all|nearest] [output:=FOLDER]
The robot is that of robot_description, the task is in the private parameter task (config/rows_clamp_task.yaml). The
program owns /clock and takes one step at a time: joint states out, the Constraints of that moment in, a quadratic
program, a step; so a run is the same on every machine. With ~output it writes FOLDER/<task>_<rows>.csv and ends;
without, it begins again and again.
"""

import csv
import os
import queue
import sys
import time

import numpy as np
import rospy
from concave_distance.msg import Constraint, Constraints, DistanceQuery, Niches, PairStatus
from concave_distance.srv import GetDistance, ResetTracking
from geometry_msgs.msg import Point
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from row_program import Task  # noqa: E402  (the path comes first)

NODE = "concave_distance"
HOLD = 3.0          # s of wall time, at the end of a run that is watched
COLOURS = {"all": ColorRGBA(0.10, 0.35, 0.75, 1.0), "nearest": ColorRGBA(0.85, 0.20, 0.10, 1.0)}
WORDS = {"all": "All rows", "nearest": "Nearest row only"}


class Robot:
    """The simulated robot and the running node: joint states go in, the rows of that moment come out."""

    def __init__(self, names, bodies):
        self.names, self.bodies, self.now = names, bodies, rospy.Time(1000)
        self.messages = queue.Queue()
        self.states = rospy.Publisher("joint_states", JointState, queue_size=10)
        self.clock = rospy.Publisher("/clock", Clock, queue_size=10)
        self.topic = rospy.resolve_name(NODE + "/constraints")
        rospy.Subscriber(self.topic, Constraints, self.messages.put, queue_size=100, tcp_nodelay=True)
        self.get_distance = rospy.ServiceProxy(NODE + "/get_distance", GetDistance, persistent=True)
        self.reset_tracking = rospy.ServiceProxy(NODE + "/reset_tracking", ResetTracking)

    def rows(self, positions, step, longest=30.0):
        """The Constraints for these positions, one step later."""
        self.now += rospy.Duration.from_sec(step)
        state = JointState(name=self.names, position=list(positions))
        state.header.stamp = self.now
        self.states.publish(state)
        # An answer for this time shows that the node has these transforms, before the clock begins its next cycle.
        answer = self.get_distance(DistanceQuery(body_a=self.bodies[0], body_b=self.bodies[1], stamp=self.now))
        if answer.result.nearest.status.code == PairStatus.MISSING_TRANSFORM:
            raise rospy.ServiceException(answer.message)
        self.clock.publish(Clock(self.now))
        ends = time.monotonic() + longest
        while time.monotonic() < ends and not rospy.is_shutdown():
            try:
                message = self.messages.get(timeout=0.1)
            except queue.Empty:
                continue
            if message.header.stamp == self.now:
                return message
        raise rospy.ServiceException("nothing came on " + self.topic)

    def wait(self, positions, step, longest):
        """Until the node has rows and has prepared the bodies; the clock runs meanwhile."""
        listed = queue.Queue()
        niches = rospy.Subscriber(NODE + "/niches", Niches, listed.put, queue_size=10)
        ends, reason = time.monotonic() + longest, ""
        while not rospy.is_shutdown():
            try:
                self.rows(positions, step, 1.0)
                reason = "its niches are not complete"
                while not listed.empty():
                    message = listed.get()
                    if message.header.stamp > rospy.Time(1000) and all(
                            pair.niches_complete for pair in message.pairs if pair.nearest.has_distance):
                        niches.unregister()
                        return
            except (rospy.ServiceException, rospy.ROSException) as error:
                reason = str(error)
                self.clock.publish(Clock(self.now))  # without a time the node refuses transforms
            if time.monotonic() > ends:
                raise SystemExit("no rows came on {} within {:.0f} s ({}). Is the node running, with a scene and this robot? "
                                 "roslaunch concave_distance rows.launch starts all of it".format(self.topic, longest, reason))
            time.sleep(0.05)


class Record:
    """What a run has done, a line a step."""

    def __init__(self, rows, joints):
        self.rows, self.lines, self.path, self.state = rows, [], [], "moving"
        self.header = ["t", *joints, *("v_" + name for name in joints), "tip_x", "tip_y", "tip_z", "value", "lower_bound",
                       "pair", "rows", "state"]

    def add(self, moment, positions, velocity, tip, used, program):
        nearest = min(used, key=lambda row: row.value, default=None)
        cells = ["", "", ""] if nearest is None else [nearest.value, nearest.lower_bound, nearest.pair]
        self.lines.append([moment, *positions, *velocity, *tip, *cells, len(program), self.state])
        self.path.append(Point(*tip))

    def summary(self):
        values = [line[-5] for line in self.lines if line[-5] != ""]
        clear = ", always %.1f mm clear" % (1e3 * min(values)) if values and self.state != "contact" else ""
        ends = {"goal": "at its goal", "contact": "CONTACT", "moving": "not at its goal"}
        return "%s: %s after %.2f s%s" % (WORDS[self.rows], ends[self.state], self.lines[-1][0], clear)

    def write(self, folder, task):
        with open(os.path.join(folder, "%s_%s.csv" % (task, self.rows)), "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(self.header)
            for line in self.lines:
                writer.writerow(["%.7g" % (cell + 0.0) if isinstance(cell, float) else cell for cell in line])


class Picture:
    """Markers: the path of the tip, the rows that the program has now, and what came out."""

    def __init__(self, text_at):
        self.publisher = rospy.Publisher("~markers", MarkerArray, queue_size=2, latch=True)
        self.text_at = text_at

    @staticmethod
    def marker(namespace, kind, rows, size):
        marker = Marker(ns=namespace, id=list(WORDS).index(rows), type=kind, action=Marker.ADD, color=COLOURS[rows])
        marker.header.frame_id = "world"
        marker.pose.orientation.w = 1.0
        marker.scale.x = marker.scale.z = size
        return marker

    def show(self, record, program, text):
        path = self.marker("path", Marker.LINE_STRIP, record.rows, 0.003)
        path.points = record.path if len(record.path) > 1 else 2 * record.path
        lines = self.marker("rows", Marker.LINE_LIST, record.rows, 0.004)
        lines.id = 0
        lines.points = [point for row in program for point in (row.point_a, row.point_b)]
        lines.action = Marker.ADD if program else Marker.DELETE
        words = self.marker("text", Marker.TEXT_VIEW_FACING, record.rows, self.text_at[3])
        words.pose.position = Point(*self.text_at[:2], self.text_at[2] - 1.4 * words.id * self.text_at[3])
        words.text = text
        self.publisher.publish(MarkerArray([path, lines, words]))


def run(robot, task, rows, picture):
    """One run from the start; None when the program is told to end."""
    step, margin, gain, speed, longest = (float(rospy.get_param("~" + name)) for name in (
        "step", "margin", "gain", "speed", "longest"))
    record, positions = Record(rows, task.chain.names), task.start.copy()
    robot.reset_tracking("")
    began = time.monotonic()
    for number in range(int(round(longest / step))):
        message = robot.rows(positions, step)
        if rospy.is_shutdown():
            return None
        used = [row for row in message.rows if row.state == Constraint.USED]
        program = used if rows == "all" else sorted(used, key=lambda row: row.value)[:1]
        tip = task.chain.tip_at(positions)[0]
        if any(row.overlapping for row in used):
            record.state = "contact"
        elif task.is_done(tip):
            record.state = "goal"
        velocity = task.velocities(positions, program, margin, gain) if record.state == "moving" else np.zeros(len(positions))
        record.add(number * step, positions, velocity, tip, used, program)
        if picture and number % max(1, int(round(0.02 / step))) == 0:
            picture.show(record, program, "%s: %.1f s" % (WORDS[rows], number * step))
        if record.state != "moving":
            break
        positions = positions + step * velocity
        if speed > 0.0:
            time.sleep(max(0.0, began + (number + 1) * step / speed - time.monotonic()))
    if picture:
        picture.show(record, [], record.summary())
    return record


def main():
    rospy.init_node("follow_rows")
    which = rospy.get_param("~rows", "both")
    if which not in ("both", *WORDS):
        raise SystemExit("the parameter rows is '{}': expected both, all or nearest".format(which))
    if not rospy.has_param("robot_description"):
        raise SystemExit("there is no parameter robot_description: roslaunch concave_distance rows.launch sets it")
    if not rospy.has_param("~task"):
        raise SystemExit("there is no task: rosparam load config/rows_clamp_task.yaml {}/task".format(rospy.get_name()))
    try:
        task = Task(rospy.get_param("robot_description"), rospy.get_param("~task"), float(rospy.get_param("~pace", 1.0)))
    except (KeyError, TypeError, ValueError) as error:
        raise SystemExit("task: {!r}; compare it with config/rows_clamp_task.yaml".format(error))
    output = rospy.get_param("~output", "")
    robot = Robot(task.chain.names, task.bodies)
    picture = None if output else Picture(task.text_at)
    step = float(rospy.get_param("~step"))
    robot.wait(task.start, step, float(rospy.get_param("~longest_wait", 60.0)))
    while not rospy.is_shutdown():
        for rows in list(WORDS) if which == "both" else [which]:
            try:
                record = run(robot, task, rows, picture)
            except (rospy.ServiceException, rospy.ROSException) as error:
                if rospy.is_shutdown():
                    return 0
                raise SystemExit("the node {} does not answer any more: {}".format(rospy.resolve_name(NODE), error))
            if record is None:
                return 0
            rospy.loginfo("%s", record.summary())
            if output:
                record.write(output, task.name)
            else:
                time.sleep(HOLD)
        if output:
            break
    return 0


if __name__ == "__main__":
    sys.exit(main())
