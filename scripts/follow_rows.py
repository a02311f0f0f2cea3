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
import xml.etree.ElementTree as ElementTree

import cvxopt
import cvxopt.solvers
import numpy as np
import rospy
from concave_distance.msg import Constraint, Constraints, DistanceQuery, Niches, PairStatus
from concave_distance.srv import GetDistance, ResetTracking
from geometry_msgs.msg import Point
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

NODE = "concave_distance"
HOLD = 3.0          # s of wall time, at the end of a run that is watched
SLACK_COST = 30.0   # of a row that cannot hold, against 1 for a tip at full speed in the wrong direction
COLOURS = {"all": ColorRGBA(0.10, 0.35, 0.75, 1.0), "nearest": ColorRGBA(0.85, 0.20, 0.10, 1.0)}
WORDS = {"all": "All rows", "nearest": "Nearest row only"}
# Mehrotra's correction goes round in circles on some of these programs.
cvxopt.solvers.options.update(show_progress=False, use_correction=False)


def rotation(axis, angle):
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


def numbers(element, key, default):
    return np.array((default if element is None else element.get(key, default)).split(), float)


def placed(origin):
    """4 x 4 matrix of a URDF's <origin>."""
    pose = np.eye(4)
    pose[:3, 3] = numbers(origin, "xyz", "0 0 0")
    roll, pitch, yaw = numbers(origin, "rpy", "0 0 0")
    pose[:3, :3] = rotation((0, 0, 1), yaw) @ rotation((0, 1, 0), pitch) @ rotation((1, 0, 0), roll)
    return pose


class Chain:
    """The joints of a URDF from its root to the tip, a point of its last link; others may only be fixed."""

    def __init__(self, description, link, point):
        joint_of = {joint.find("child").get("link"): joint for joint in ElementTree.fromstring(description).findall("joint")}
        self.joints, self.tip = [], np.append(point, 1.0)
        while link in joint_of:
            self.joints.insert(0, joint_of[link])
            link = joint_of[link].find("parent").get("link")
        moving = [joint for joint in self.joints if joint.get("type") != "fixed"]
        self.names = [joint.get("name") for joint in moving]
        self.lower, self.upper, self.speeds = (numbers(None, "", " ".join(joint.find("limit").get(key) for joint in moving))
                                               for key in ("lower", "upper", "velocity"))

    def tip_at(self, positions):
        """Where the tip is (3), and its Jacobian (3 x joints), in the root's frame."""
        pose, axes, left = np.eye(4), [], list(positions)
        for joint in self.joints:
            pose = pose @ placed(joint.find("origin"))
            if joint.get("type") == "fixed":
                continue
            axis, step = numbers(joint.find("axis"), "xyz", "1 0 0"), np.eye(4)
            axes.append((joint.get("type") == "prismatic", pose[:3, :3] @ axis, pose[:3, 3].copy()))
            if axes[-1][0]:
                step[:3, 3] = left.pop(0) * axis
            else:
                step[:3, :3] = rotation(axis, left.pop(0))
            pose = pose @ step
        tip = (pose @ self.tip)[:3]
        return tip, np.array([axis if slides else np.cross(axis, tip - at) for slides, axis, at in axes]).T


class Task:
    """Brings the tip to a goal and, where that leaves a choice, joints to a posture. `pace`: of the speeds' limits."""

    def __init__(self, description, task, pace):
        self.chain = Chain(description, task["tip"]["link"], task["tip"]["point"])
        names = self.chain.names
        self.name, self.bodies, self.text_at = task["name"], task["bodies"], task["text_at"]
        self.start = np.array([float(task["start"][name]) for name in names])
        self.goal = np.array(task["goal"], float)
        self.posture = np.array([float(task.get("posture", {}).get(name, np.nan)) for name in names])
        self.approach, self.weight, self.tolerance = task["approach"], task["posture_weight"], task["tolerance"]
        self.speeds, self.tip_speed = pace * self.chain.speeds, pace * task["tip_speed"]

    def wish(self, positions):
        """matrix, vector: matrix * w shall come near the vector; w: velocities as parts of their limits."""
        tip, jacobian = self.chain.tip_at(positions)
        desired = self.approach * (self.goal - tip) / self.tip_speed
        rest = np.nan_to_num(self.approach * (self.posture - positions) / self.speeds)
        return (np.vstack([jacobian * self.speeds / self.tip_speed, self.weight * np.eye(len(rest))]),
                np.concatenate([desired / max(1.0, np.linalg.norm(desired)), self.weight * np.clip(rest, -1.0, 1.0)]))

    def is_done(self, tip):
        return np.linalg.norm(self.goal - tip) < self.tolerance

    def velocities(self, positions, rows, margin, gain):
        """The program: as near to the wish as limits and jacobian * v >= drift - gain * (value - margin) allow."""
        count = len(positions)
        matrix, vector = self.wish(positions)
        hessian, linear = np.eye(count + 1), np.append(-matrix.T @ vector, SLACK_COST)  # the last unknown is a slack
        hessian[:count, :count] = matrix.T @ matrix
        highest = np.minimum(1.0, gain * (self.chain.upper - positions) / self.speeds)
        lowest = np.maximum(-1.0, gain * (self.chain.lower - positions) / self.speeds)
        jacobian = np.array([row.jacobian for row in rows]).reshape(-1, count) * self.speeds
        bounds = np.array([(row.drift if row.has_drift else 0.0) - gain * (row.value - margin) for row in rows])
        sizes = np.maximum(1e-6, np.abs(jacobian).max(axis=1, initial=0.0))  # m/s
        left = np.vstack([np.eye(count + 1)[:count], -np.eye(count + 1),
                          np.hstack([-jacobian / sizes[:, None], -np.ones((len(rows), 1))])])
        right = np.concatenate([highest, -lowest, [0.0], -bounds / sizes])
        solution = cvxopt.solvers.qp(*map(cvxopt.matrix, (hessian, linear, left, right)))
        if solution["status"] != "optimal":
            raise SystemExit("the quadratic program is not solved: " + solution["status"])
        return np.array(solution["x"]).ravel()[:count] * self.speeds


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
                       "pair", "niche", "rows", "state"]

    def add(self, moment, positions, velocity, tip, used, program):
        nearest = min(used, key=lambda row: row.value, default=None)
        cells = ["", "", "", ""] if nearest is None else [nearest.value, nearest.lower_bound, nearest.pair, nearest.niche_id]
        self.lines.append([moment, *positions, *velocity, *tip, *cells, len(program), self.state])
        self.path.append(Point(*tip))

    def summary(self):
        values = [line[-6] for line in self.lines if line[-6] != ""]
        least = "at least %.1f mm apart" % (1e3 * min(values)) if values else "far from everything"
        ends = {"goal": "at its goal", "contact": "CONTACT", "moving": "not at its goal"}
        return "%s: %s after %.2f s, %s" % (WORDS[self.rows], ends[self.state], self.lines[-1][0], least)

    def write(self, folder, task):
        with open(os.path.join(folder, "%s_%s.csv" % (task, self.rows)), "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(self.header)
            # The ids of niches differ from run to run, so each is named by when it was the nearest first.
            names = {}
            for line in self.lines:
                line[-3] = "" if line[-3] == "" else names.setdefault(line[-3], len(names) + 1)
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
    task = Task(rospy.get_param("robot_description"), rospy.get_param("~task"), float(rospy.get_param("~pace", 1.0)))
    output = rospy.get_param("~output", "")
    robot = Robot(task.chain.names, task.bodies)
    picture = None if output else Picture(task.text_at)
    step = float(rospy.get_param("~step"))
    robot.wait(task.start, step, float(rospy.get_param("~longest_wait", 60.0)))
    while not rospy.is_shutdown():
        for rows in list(WORDS) if which == "both" else [which]:
            record = run(robot, task, rows, picture)
            if record is None:
                return 0
            rospy.loginfo("%s", record.summary())
            if output:
                record.write(output, task.name)
            else:
                time.sleep(HOLD)
        if output:
            return 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
