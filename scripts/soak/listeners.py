"""The five subscribers of the soak, and what the programs say of themselves: diagnostics and rosout."""

import collections
import threading
import time

import rospy
from concave_distance.msg import NicheChange, PairNiches
from diagnostic_msgs.msg import DiagnosticArray
from rosgraph_msgs.msg import Log

NODE = "concave_distance/"
KEPT = 100          # messages that are kept for a comparison
LONGEST_WAIT = 3.0  # s for diagnostics
SAME_PLACE = 1e-3   # m on the body that rests: a niche that ends and another that begins there are one


class Stream:
    """Counts the messages of a topic without reading them, and keeps the last ones. A gap: more than two periods."""

    def __init__(self, topic, period=None, kept=0):
        self.period = period
        self.lock = threading.Lock()
        self.count, self.gaps, self.last = 0, 0, None
        self.kept = collections.deque(maxlen=kept)
        self.subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self.receive, queue_size=200, tcp_nodelay=True)

    def receive(self, message):
        now = time.monotonic()
        with self.lock:
            self.count += 1
            if self.period and self.last and now - self.last > 2.0 * self.period:
                self.gaps += 1
            self.last = now
            # Only what is read of it is kept: a message of rospy refers to its connection.
            if self.kept.maxlen:
                self.kept.append((now, message._buff))

    def newest(self):
        with self.lock:
            return list(self.kept)

    def take(self):
        with self.lock:
            taken = self.count, self.gaps
            self.count = self.gaps = 0
            return taken


class Ids:
    """Follows the ids of one pair's niches. `rests`: which of its bodies does not move, or none."""

    def __init__(self, rests):
        self.rests = rests
        self.lock = threading.Lock()
        self.seen, self.lost = 0, 0
        self.ended = set()
        self.before = None
        self.reasons = collections.deque(maxlen=5)

    def follow(self, message):
        with self.lock:
            born = {change.id for change in message.changes if change.kind == NicheChange.BIRTH}
            gone = {change.id for change in message.changes if change.kind != NicheChange.BIRTH}
            listed = {niche.id: niche for niche in message.niches}
            for number in set(listed) & self.ended:
                self._lose("id %d is listed after its end" % number)
            if self.before and message.cycle == self.before[0] + 1 and self.rests:
                self._compare_places(born, gone, listed)
            self.seen += len(born)
            self.ended |= gone
            self.before = message.cycle, listed

    def _compare_places(self, born, gone, listed):
        for old in gone & set(self.before[1]):
            for new in born & set(listed):
                place, now = (getattr(niche, "point_" + self.rests) for niche in (self.before[1][old], listed[new]))
                if max(abs(place.x - now.x), abs(place.y - now.y), abs(place.z - now.z)) < SAME_PLACE:
                    self._lose("id %d has become %d where it was" % (old, new))

    def _lose(self, reason):
        self.lost += 1
        self.reasons.append(reason)

    def take(self):
        with self.lock:
            taken = self.seen, self.lost
            self.seen = self.lost = 0
            return taken


class PairTopic:
    """The niches of one pair: ids, and the last messages for a comparison."""

    def __init__(self, pair, rests):
        self.pair = pair
        self.ids = Ids(rests)
        self.kept = collections.deque(maxlen=KEPT)
        self.subscriber = rospy.Subscriber(NODE + "pairs/" + pair + "/niches", PairNiches, self.receive, queue_size=200,
                                           tcp_nodelay=True)

    def receive(self, message):
        self.ids.follow(message)
        self.kept.append(message)

    def at(self, stamp):
        """The message of a stamp; a repeated one is the same."""
        for message in reversed(list(self.kept)):
            if message.header.stamp == stamp:
                return message
        return None


class Reports:
    """Diagnostics of the node, and errors in rosout."""

    def __init__(self, quiet):
        self.lock = threading.Lock()
        self.quiet = quiet  # nodes whose errors do not count
        self.cycles = collections.Counter()
        self.largest_ms, self.voxels = 0.0, 0
        self.stamp, self.diagnosed_at = "", 0.0
        self.errors, self.last_error = 0, ""
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.diagnose, queue_size=100)
        rospy.Subscriber("/rosout", Log, self.read, queue_size=1000)

    def diagnose(self, message):
        for status in message.status:
            if not status.name.startswith("concave_distance"):
                continue
            values = {value.key: value.value for value in status.values}
            with self.lock:
                for key in ("cycles", "late cycles", "failed cycles"):
                    self.cycles[key] += int(values.get(key, 0))
                self.largest_ms = max(self.largest_ms, float(values.get("cycle time max (ms)", 0.0)))
                self.voxels = int(values.get("camera occupied voxels", self.voxels))
                if "camera stamp (s)" in values:
                    self.stamp, self.diagnosed_at = values["camera stamp (s)"], time.monotonic()

    def stamp_of_cloud(self):
        """Seconds with nine digits, as text, of the cloud that the node serves."""
        with self.lock:
            return self.stamp

    def stamp_after(self, instant):
        """The same, by diagnostics that come after an instant of time.monotonic(); empty: none come."""
        while time.monotonic() < instant + LONGEST_WAIT:
            with self.lock:
                if self.diagnosed_at > instant:
                    return self.stamp
            time.sleep(0.02)
        return ""

    def read(self, message):
        if message.level < Log.ERROR or message.name in self.quiet:
            return
        with self.lock:
            self.errors += 1
            self.last_error = "%s: %s" % (message.name, message.msg)

    def take(self):
        with self.lock:
            taken = self.cycles, self.largest_ms, self.voxels, self.errors
            self.cycles, self.largest_ms, self.errors = collections.Counter(), 0.0, 0
            return taken
