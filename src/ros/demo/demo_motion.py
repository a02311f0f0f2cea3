"""What the programs of the demos share: their parameters, paths from CSV files, transforms, and playing at a rate."""

import csv
import math
import os
import sys

import numpy
import rospkg
import rospy
from geometry_msgs.msg import TransformStamped

CLOSING_TOLERANCE = 1e-9  # rad or m: the ends of a path are written with nine digits or more


def text_parameter(name):
    value = rospy.get_param("~" + name, "")
    if not isinstance(value, str) or not value:
        sys.exit("%s: is not set; set it to a text" % rospy.resolve_name("~" + name))
    return value


def number_parameter(name, fallback, least, most):
    value = rospy.get_param("~" + name, fallback)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not least <= value <= most:
        sys.exit("%s: is %r; set it to a number from %g to %g" % (rospy.resolve_name("~" + name), value, least, most))
    return float(value)


def table_parameter(name):
    """The column names and the rows, one a time that rises, of the CSV file that a parameter names."""
    path = text_parameter(name)
    if path.startswith("package://"):
        package, _, below = path[len("package://"):].partition("/")
        path = os.path.join(rospkg.RosPack().get_path(package), below)
    try:
        with open(path, newline="") as stream:
            names, *rows = csv.reader(stream)
        table = numpy.array(rows, float)
        if table.ndim != 2 or table.shape[1] != len(names) or not numpy.isfinite(table).all():
            raise ValueError("it is no table of finite numbers")
        if names[0] != "t" or not (numpy.diff(table[:, 0]) > 0.0).all():
            raise ValueError("its first column is not t, with times that rise")
    except (OSError, ValueError) as problem:
        sys.exit("%s: %s" % (path, problem))
    return names, table


class JointPath:
    """The periodic cubic spline through the rows of a table `t,<joint>,...`, whose last row repeats the first one."""

    def __init__(self, table):
        self.times, self.points = table[:, 0], table[:, 1:]
        if len(table) < 4 or self.times[0] != 0.0:
            sys.exit("a path of joints needs at least four rows, the first at t = 0")
        if abs(self.points[-1] - self.points[0]).max() > CLOSING_TOLERANCE:
            sys.exit("the path of joints does not close: repeat the first row as the last one")
        # Equal second derivatives from both sides of every waypoint: one linear equation each, cyclic.
        after = numpy.diff(self.times)
        before = numpy.roll(after, 1)
        rise = numpy.diff(self.points, axis=0) / after[:, None] ** 2
        one = numpy.eye(len(after))
        system = (numpy.roll(one, -1, axis=1) / before[:, None] + 2.0 * one * (1.0 / before + 1.0 / after)[:, None]
                  + numpy.roll(one, 1, axis=1) / after[:, None])
        speeds = numpy.linalg.solve(system, 3.0 * (rise + numpy.roll(rise, 1, axis=0)))
        self.speeds = numpy.vstack((speeds, speeds[:1]))

    def at(self, time):
        """Positions at any time; the path repeats."""
        phase = time % self.times[-1]
        row = min(int(numpy.searchsorted(self.times, phase, "right")) - 1, len(self.times) - 2)
        span = self.times[row + 1] - self.times[row]
        s = (phase - self.times[row]) / span
        return ((1.0 + 2.0 * s) * (1.0 - s) ** 2 * self.points[row] + s * (1.0 - s) ** 2 * span * self.speeds[row]
                + s * s * (3.0 - 2.0 * s) * self.points[row + 1] + s * s * (s - 1.0) * span * self.speeds[row + 1])


class PosePath:
    """Straight lines and steady turns between the rows of a table `t,x,y,z,qx,qy,qz,qw`."""

    def __init__(self, table):
        if table.shape[1] != 8 or (abs((table[:, 4:] ** 2).sum(axis=1) - 1.0) > 1e-3).any():
            sys.exit("a path of poses has the columns t,x,y,z,qx,qy,qz,qw and quaternions of length 1")
        self.times, self.points, self.turns = table[:, 0], table[:, 1:4], table[:, 4:]

    def at(self, time):
        """Position and quaternion at a time; outside of the table those of its ends."""
        time = min(max(time, self.times[0]), self.times[-1])
        row = min(max(int(numpy.searchsorted(self.times, time, "right")) - 1, 0), max(len(self.times) - 2, 0))
        after = min(row + 1, len(self.times) - 1)
        share = 0.0 if after == row else (time - self.times[row]) / (self.times[after] - self.times[row])
        first, last = self.turns[row], self.turns[after]
        last = last if first @ last >= 0.0 else -last
        angle = 2.0 * math.atan2(numpy.linalg.norm(last - first), numpy.linalg.norm(last + first))
        weights = (1.0 - share, share) if angle < 1e-6 else (math.sin((1.0 - share) * angle), math.sin(share * angle))
        turn = weights[0] * first + weights[1] * last
        return (1.0 - share) * self.points[row] + share * self.points[after], turn / numpy.linalg.norm(turn)


def to_and_fro(elapsed, duration, pause):
    """The time on a path of this duration that is played forwards and backwards, with a rest at either end."""
    leg = duration + pause
    phase = max(elapsed, 0.0) % (2.0 * leg) if leg > 0.0 else 0.0
    return min(phase, duration) if phase < leg else max(duration - (phase - leg), 0.0)


def quaternion_of(roll, pitch, yaw):
    """x, y, z, w of a turn about the fixed axes x, then y, then z."""
    (a, x), (b, y), (c, z) = ((math.cos(0.5 * angle), math.sin(0.5 * angle)) for angle in (roll, pitch, yaw))
    return (x * b * c - a * y * z, a * y * c + x * b * z, a * b * z - x * y * c, a * b * c + x * y * z)


def transform(parent, child, position, quaternion, stamp):
    message = TransformStamped()
    message.header.stamp, message.header.frame_id, message.child_frame_id = stamp, parent, child
    place, turn = message.transform.translation, message.transform.rotation
    place.x, place.y, place.z = position
    turn.x, turn.y, turn.z, turn.w = quaternion
    return message


def play_at_rate(rate, act):
    """Calls act(seconds since the first call, now) until the program ends; a clock that jumps back begins anew."""
    tick = rospy.Rate(rate, reset=True)
    began = None
    while not rospy.is_shutdown():
        now = rospy.Time.now()
        if not now.is_zero():
            began = now if began is None or now < began else began
            act((now - began).to_sec(), now)
        try:
            tick.sleep()
        except rospy.ROSInterruptException:
            break
