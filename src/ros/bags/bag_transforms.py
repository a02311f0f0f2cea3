"""The transforms of bags: read in the order of their recording, checked as the node does, and where frames are at a stamp.

BagReader gives messages, BagFrames takes them and gives places. Times are nanoseconds, lengths metres. No master is needed.
"""
import bisect
import collections
import heapq
import math
import os

import genpy
import numpy as np
import rosbag
from tf2_msgs.msg import TFMessage

NANOSECONDS = 10**9
FILE = "name a bag, as rosbag record writes it"
DECRYPT = "import the key with gpg, or decrypt the bag where it is: rosbag encrypt -p rosbag/NoEncryptor"
TOPICS = "name tf's topics with --tf-topic and --tf-static-topic; topics of type tf2_msgs/TFMessage: %s"
LARGEST_COORDINATE = 1e18    # m
QUATERNION_TOLERANCE = 1e-2  # tf2's own, of the squared norm
REFUSED = "the transform of frame '%s' in '%s' from %s is refused"

# time: nanoseconds, of its recording; the begin of what is played, when it is static and was recorded before
BagMessage = collections.namedtuple("BagMessage", "time is_static sender transforms problem")


class Fault(Exception):
    """Says where something is wrong, what, and what to do."""

    def __str__(self):
        return "%s: %s (%s)" % self.args


def printable(text):
    """A text of a bag, or an error about it, for the terminal: short, without control characters."""
    text = "a part of it takes too much memory" if isinstance(text, MemoryError) else str(text)[:200]
    return "".join(c if c.isprintable() else "?" for c in text)


def open_bag(path):
    """The bag, and the times of its first and last message, nanoseconds."""
    if not os.path.isfile(path):
        raise Fault(path, "it is no file" if os.path.exists(path) else "there is no such bag", FILE)
    with open(path, "rb") as stream:
        head = stream.read(4200)  # the record behind the first line is padded to 4096 bytes
    if not head.startswith(b"#ROSBAG V"):
        raise Fault(path, "it is no bag of ROS 1", FILE)
    try:
        bag = rosbag.Bag(path)
        ends = [next(entries, None) for entries in (bag._get_entries(), bag._get_entries_reverse())]
        return bag, [entry.time.to_nsec() for entry in ends if entry]
    except Exception as problem:
        if b"encryptor=" in head:
            raise Fault(path, "it is encrypted and cannot be opened: " + printable(problem), DECRYPT)
        has_index = b"index_pos=" + bytes(8) not in head
        raise Fault(path, "it is cut off or damaged: " + printable(problem) if has_index else
                    "it has no index: its recording was not ended", "rosbag reindex " + path)


class BagReader:
    """moving, fixed: topics that are named in the place of /tf and /tf_static, of which each has to be in a bag. start:
    seconds after the begin of the bags; duration: seconds from there."""

    def __init__(self, paths, moving, fixed, start, duration):
        self.where = ", ".join(paths)
        are_given = bool(moving + fixed)
        moving, fixed = (moving, fixed) if are_given else (["/tf"], ["/tf_static"])
        self._fixed, self._wanted = ({topic.lstrip("/") for topic in topics} for topics in (fixed, moving + fixed))
        opened = [open_bag(path) for path in paths]
        self._bags = [bag for bag, _ in opened]
        self._require_topics(moving + fixed, are_given)
        times = [time for _, ends in opened for time in ends]
        length = (max(times) - min(times)) / NANOSECONDS
        if start > length:
            raise Fault("--start", "it is %g s, behind the end" % start, "the bags last %.9g s" % length)
        self.begin = min(times) + round(start * NANOSECONDS)
        self.end = min(max(times), self.begin + round(duration * NANOSECONDS))

    def messages(self):
        """Raises Fault where a bag is damaged."""
        time = self.begin
        before = [self._read(bag, self._fixed, 0, self.begin - 1) for bag in self._bags]
        try:
            for message in heapq.merge(*before, *(self._read(bag, self._wanted, self.begin, self.end) for bag in self._bags),
                                       key=lambda message: message.time):
                time = message.time
                yield message
        except Exception as problem:
            raise Fault(self.where, "it is damaged %.3f s after the begin of what is played: %s" % (
                (time - self.begin) / NANOSECONDS, printable(problem)),
                "rosbag reindex keeps what is whole; nothing was written")

    def _read(self, bag, wanted, begin, end):
        topics = [connection.topic for connection in bag._get_connections() if connection.topic.lstrip("/") in wanted]
        times = [genpy.Time(*divmod(time, NANOSECONDS)) for time in (begin, end)]
        messages = bag.read_messages(topics, *times, raw=True, return_connection_header=True) if topics else ()
        for topic, raw, time, header in messages:
            if raw[2] != TFMessage._md5sum:
                raise rosbag.ROSBagException("its index leads to a message of the type %s" % raw[0])
            sender = header.get("callerid") or topic  # a message that a program wrote has no sender
            message, problem = TFMessage(), None
            try:
                message.deserialize(raw[1])
            except Exception as error:
                message, problem = TFMessage(), printable(error)
            yield BagMessage(max(time.to_nsec(), self.begin), topic.lstrip("/") in self._fixed,
                             printable(sender if isinstance(sender, str) else sender.decode("utf-8", "replace")),
                             message.transforms, problem)

    def _require_topics(self, wanted, are_given):
        types = {connection.topic: connection for bag in self._bags for connection in bag._get_connections()}
        of_tf = sorted(topic for topic, found in types.items() if found.md5sum == TFMessage._md5sum)
        remedy = TOPICS % (printable(", ".join(of_tf)) or "none")
        for topic, found in types.items():
            rosbag.bag._message_types[found.md5sum] = TFMessage  # else it would be made from what the bag says of it
            if topic.lstrip("/") in self._wanted and topic not in of_tf:
                raise Fault(self.where, "its topic %s has the type %s, which is not tf2_msgs/TFMessage" % (
                    printable(topic), printable(found.datatype)), remedy)
        missing = [topic for topic in wanted if topic.lstrip("/") not in [found.lstrip("/") for found in types]]
        if missing and (are_given or len(missing) == len(wanted)):
            raise Fault(self.where, "there is no message on " + " or ".join(missing), remedy)


# Frames with transforms of one stamp; when the first of them was recorded; is_late: later stamps were answered before.
Moment = collections.namedtuple("Moment", "stamp recorded frames is_late")
# pose: in the reference frame, None where it is not known; newest: stamp of the oldest transform that it needs, 0: it has
# none yet; moved: one of these transforms is of the moment
Place = collections.namedtuple("Place", "pose newest moved")
NOWHERE = Place(None, 0, False)


def matrix_of(place):
    """4 x 4 of a translation and a unit quaternion."""
    (x, y, z), (qx, qy, qz, qw) = place
    return np.array(((1 - 2 * (qy * qy + qz * qz), 2 * (qx * qy - qz * qw), 2 * (qx * qz + qy * qw), x),
                     (2 * (qx * qy + qz * qw), 1 - 2 * (qx * qx + qz * qz), 2 * (qy * qz - qx * qw), y),
                     (2 * (qx * qz - qy * qw), 2 * (qy * qz + qx * qw), 1 - 2 * (qx * qx + qy * qy), z),
                     (0.0, 0.0, 0.0, 1.0)))


def inverse(pose):
    turn = pose[:3, :3].T
    return np.vstack((np.column_stack((turn, -turn @ pose[:3, 3])), pose[3]))


def between(first, second, share):
    """Interpolates as tf2 does."""
    translation = tuple(a + share * (b - a) for a, b in zip(first[0], second[0]))
    cosine = sum(a * b for a, b in zip(first[1], second[1]))
    sign, angle = math.copysign(1.0, cosine), math.acos(min(abs(cosine), 1.0))
    s, t = (math.sin(part * angle) / math.sin(angle) if angle else part for part in (1.0 - share, share))
    return translation, tuple(s * a + sign * t * b for a, b in zip(first[1], second[1]))


class Track:
    """The moving transforms of one frame, as far back as they are kept."""

    def __init__(self):
        self.entries = []  # (stamp, parent, (translation, quaternion))

    def add(self, stamp, parent, place, cache):
        """Returns False where there is one of this stamp: tf keeps the first."""
        at = bisect.bisect_left(self.entries, (stamp,))
        if stamp in [entry[0] for entry in self.entries[at:at + 1]]:
            return False
        self.entries.insert(at, (stamp, parent, place))
        half = len(self.entries) // 2
        if self.entries[half][0] < self.entries[-1][0] - 2 * cache:
            del self.entries[:half]
        return True

    def at(self, stamp, longest_gap):
        """Parent, pose in it and the stamp that it is of; the pose is None where the gap is too long."""
        after = bisect.bisect_right(self.entries, (stamp + 1,))
        if after == 0:
            return self.entries[0][1], None, 0
        newest, parent, place = self.entries[after - 1]
        if newest < stamp:
            following, other, next_place = self.entries[after] if after < len(self.entries) else (math.inf, None, None)
            if following - newest > longest_gap:
                return parent, None, newest
            place = between(place, next_place, (stamp - newest) / (following - newest)) if other == parent else place
        return parent, matrix_of(place), stamp


class BagFrames:
    """The transforms of a bag. A stamp waits for slower publishers until transforms are newer than it by the time after
    which they are stale, or by half of the cache."""

    def __init__(self, cache, future_tolerance, stale_after):
        self._cache, self._future_tolerance, self.stale_after = (
            round(value * NANOSECONDS) for value in (cache, future_tolerance, stale_after))
        self._lag = min(self.stale_after, self._cache // 2)
        self._now = self._newest = self._answered = 0  # of the last message; of moving transforms; the last moment
        self._tracks = {}
        self._fixed = {}    # frame: (parent, place, pose)
        self.parents = {}   # of each frame, the newest
        self._heap = []     # stamps that wait
        self._waiting = {}  # stamp: (recorded, frames, changes of static transforms)
        self.refusals, self.reasons = 0, {}  # the first for each frame and sender

    def take(self, message):
        """Returns the time of the message."""
        self._now = message.time
        if message.problem:
            self._refuse("a message from %s is none of tf" % message.sender, message.problem)
        for transform in message.transforms:
            child, parent = transform.child_frame_id.lstrip("/"), transform.header.frame_id.lstrip("/")
            offset, turn = transform.transform.translation, transform.transform.rotation
            place = (offset.x, offset.y, offset.z), (turn.x, turn.y, turn.z, turn.w)
            norm = math.sqrt(sum(v * v for v in place[1]))
            stamp = transform.header.stamp.to_nsec()
            problem = self._problem_of(child, parent, place[0], norm, stamp, message.is_static)
            if problem:
                self._refuse(REFUSED % (printable(child), printable(parent), message.sender), problem)
                continue
            self.parents[child] = parent
            place = place[0], tuple(v / norm for v in place[1])
            if message.is_static:
                made = parent, place, matrix_of(place)
                known = self._fixed.setdefault(child, made)
                changes = self._wait(self._now)[2]
                if known[:2] != made[:2]:  # stamps before a change have yet to be answered
                    changes[child] = made
            elif self._tracks.setdefault(child, Track()).add(stamp, parent, place, self._cache):
                self._newest = max(self._newest, stamp)
                self._wait(stamp)[1].add(child)
        return self._now

    def _wait(self, stamp):
        if stamp not in self._waiting:
            self._waiting[stamp] = self._now, set(), {}
            heapq.heappush(self._heap, stamp)
        return self._waiting[stamp]

    def _refuse(self, name, reason):
        self.refusals += 1
        self.reasons.setdefault(name, "%s: %s" % (name, reason))

    def _problem_of(self, child, parent, offset, norm, stamp, is_static):
        """What is wrong with a transform, and what its sender can do; None."""
        if not all(0 < len(name) < 256 and not any(ord(c) < 32 for c in name) for name in (child, parent)):
            return "it has no frame name, or one that is too long or has control characters (correct the publisher)"
        if child == parent:
            return "the frame is its own parent (correct the publisher)"
        if not all(abs(v) <= LARGEST_COORDINATE for v in offset):
            return "its translation is (%g, %g, %g) m (publish finite metres)" % offset
        if not abs(norm * norm - 1.0) <= QUATERNION_TOLERANCE:
            return "the norm of its quaternion is %g (publish unit quaternions; no rotation is w: 1)" % norm
        if self.parents.get(child) != parent and self.root_of(parent, child) == child:
            return "its parent is below the frame itself: a loop (give each frame one parent that is not below it)"
        if child in (self._tracks if is_static else self._fixed):
            return "it is published on both /tf and /tf_static (stop one of the two publishers)"
        if is_static:
            return None
        ahead, track = stamp - self._now, self._tracks.get(child)
        if stamp == 0:
            return "its stamp is zero (stamp it with the time of the pose; what never moves belongs on /tf_static)"
        if ahead > self._future_tolerance:
            return "its stamp is %g s ahead of the clock (check the machines' clocks, or raise --tf-future-tolerance)" % (
                ahead / NANOSECONDS)
        if track and track.entries[-1][0] - stamp > self._cache:
            return "its stamp is %g s older than the newest one (stop one of the two publishers)" % (
                (track.entries[-1][0] - stamp) / NANOSECONDS)

    def moments(self, is_end):
        """Those that need not wait for later transforms, in the order of their stamps."""
        while self._heap and (is_end or min(self._now, self._newest) - self._heap[0] >= self._lag):
            stamp = heapq.heappop(self._heap)
            recorded, frames, changes = self._waiting.pop(stamp)
            self._fixed.update(changes)
            is_late, self._answered = stamp <= self._answered, max(self._answered, stamp)
            yield Moment(stamp, recorded, frames.union(changes), is_late)

    def places(self, reference, frames, moment):
        """{frame: Place} in the reference frame, of these frames and of others."""
        known = {reference: Place(np.eye(4), moment.stamp, False)}
        below = known[reference]
        for frame, parent, step, stamp in self._up(reference, moment, ()):
            pose = None if below.pose is None or step is None else step @ below.pose
            below = Place(pose, min(below.newest, stamp), below.moved or frame in moment.frames)
            known[parent] = below._replace(pose=None if pose is None else inverse(pose))
        for wanted in frames:
            for frame, parent, step, stamp in reversed(self._up(wanted, moment, known)):
                above = known.get(parent, NOWHERE)
                known[frame] = Place(None if step is None or above.pose is None else above.pose @ step,
                                     min(above.newest, stamp), above.moved or frame in moment.frames)
            known.setdefault(wanted, NOWHERE)
        return known

    def _up(self, frame, moment, known):
        """(frame, parent, pose in it, its stamp) from a frame up to one that is known, or to the root."""
        steps = []
        while frame not in known and len(steps) <= len(self.parents):
            if frame in self._fixed:
                (parent, _, step), stamp = self._fixed[frame], moment.stamp
            elif frame in self._tracks:
                parent, step, stamp = self._tracks[frame].at(moment.stamp, self.stale_after)
            else:
                break
            steps.append((frame, parent, step, stamp))
            frame = parent
        return steps

    def root_of(self, frame, end=None):
        """The root above a frame, or `end` where that comes first."""
        for _ in range(len(self.parents)):
            frame = frame if frame == end else self.parents.get(frame, frame)
        return frame
