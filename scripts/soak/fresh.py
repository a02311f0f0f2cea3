"""A fresh node that loads the scene as it is now and says what a node that has run for hours should say.

The edits rest meanwhile, and the camera until the diagnostics say that its newest message is served. Of some messages
of `distances` every pair is asked again, at the stamp that it has there, of a node that was started a moment ago, has
the same transforms and gets that message of the camera.
"""

import os
import re
import shutil
import signal
import subprocess
import time

import rospy
from concave_distance.msg import DistanceQuery, Distances, PairStatus
from concave_distance.srv import GetDistance, GetDistances, GetScene, ListBodies
from processes import pid_of
from sensor_msgs.msg import PointCloud2

NODE = "/concave_distance/"
FRESH = "/soak_fresh/"
POINTS = "/soak_fresh_points"
TOLERANCE = 1e-11       # m: two proofs of one distance, each rounded by 2^-45 of at most 100 m (doc/numerics.md)
NICHE_TOLERANCE = 1e-9  # m: distances and points of niches, which are found from other starts
LONGEST_START = 100.0   # s
LONGEST_WAIT = 10.0     # s for a scene that rests, and for a cloud
REST = 1.0              # s without a change of the scene
HISTORY = 1.5           # s of transforms that the fresh node has before a sample
SAMPLES = 5             # messages that are compared
CAMERA_RESTS = 4.0      # s at most until its newest message is served; its cloud may be older (soak.py)
SETTLES = 0.2           # s from the diagnostics to the first message that is compared
COLLECTS = 0.6          # s
LOW_PRIORITY = 15       # that the fresh node's is lower by: it is no part of the cell
SOLVED = (PairStatus.OK, PairStatus.PENETRATING, PairStatus.BUDGET_EXHAUSTED)


class Comparison:
    """What one comparison, or several, have found."""

    def __init__(self):
        self.pairs, self.different, self.unfinished, self.cloud_pairs = 0, 0, 0, 0
        self.unsolved = 0
        self.lists, self.lists_different, self.lists_open = 0, 0, 0
        self.largest = 0.0
        self.failed = ""
        self.differences = []

    def compare(self, seen, fresh):
        """A pair of `distances` and the answer of the fresh node."""
        self.pairs += 1
        if seen.status.code == PairStatus.BUDGET_EXHAUSTED:
            self.unfinished += 1
            is_right = fresh.has_distance and (
                seen.lower_bound - TOLERANCE <= fresh.distance <= seen.distance + TOLERANCE)
        else:
            is_right = seen.status.code == fresh.status.code and self.are_near(seen.distance, fresh.distance, TOLERANCE)
            if is_right and seen.has_signed_distance and fresh.has_signed_distance:
                is_right = self.are_near(seen.signed_distance, fresh.signed_distance, TOLERANCE)
        if not is_right:
            self.different += 1
            self.differences.append("%s: %.17g (status %d), afresh %.17g (status %d %s)" % (
                seen.pair, seen.distance, seen.status.code, fresh.distance, fresh.status.code, fresh.status.message))

    def compare_lists(self, seen, fresh):
        """Lists of niches, where both are complete."""
        if not (seen.niches_complete and fresh.niches_complete):
            self.lists_open += 1
            self.differences.append("%s: the list is open (complete: %s, afresh: %s)" % (
                seen.nearest.pair, seen.niches_complete, fresh.niches_complete))
            return
        self.lists += 1
        if len(seen.niches) != len(fresh.niches) or not all(
                self.are_same(*both) for both in zip(ordered(seen.niches), ordered(fresh.niches))):
            self.lists_different += 1
            self.differences.append("%s, niches: %s, afresh %s" % (
                seen.nearest.pair, [niche.distance for niche in seen.niches], [niche.distance for niche in fresh.niches]))

    def are_same(self, one, other):
        if one.kind != other.kind or not self.are_near(one.distance, other.distance, NICHE_TOLERANCE):
            return False
        # Anywhere in a segment or patch is equally near.
        return one.kind != one.KIND_POINT or all(
            abs(getattr(getattr(one, point), axis) - getattr(getattr(other, point), axis)) <= NICHE_TOLERANCE
            for point in ("point_a", "point_b") for axis in "xyz")

    def are_near(self, one, other, tolerance):
        difference = abs(one - other)
        if tolerance == TOLERANCE and difference <= 1.0:
            self.largest = max(self.largest, difference)
        return difference <= tolerance


def ordered(niches):
    """By distance, and where these are equal but for rounding by a point."""
    return sorted(niches, key=lambda niche: (round(niche.distance, 8), round(niche.point_a.x, 7), round(niche.point_a.y, 7),
                                             round(niche.point_a.z, 7)))


class FreshNode:
    """A node of its own process that serves a scene as get_scene gives it."""

    def __init__(self, program, folder, files):
        self.folder = os.path.join(folder, "fresh")
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        for file in files:
            # The cloud that it gets is never too old.
            text = re.sub(r"(?m)^    stale_after: .*$", "    stale_after: .inf", file.text)
            with open(os.path.join(self.folder, file.name), "w", encoding="utf-8") as stream:
                stream.write(text)
        self.log = open(os.path.join(folder, "fresh.log"), "wb")
        self.process = subprocess.Popen(
            ["nice", "-n", str(LOW_PRIORITY), program, "__name:=" + FRESH.strip("/"),
             "_scene_file:=" + os.path.join(self.folder, files[0].name), "_reference_frame:=world",
             "_rate:=1", "_cache:=off", "_save_folder:=off", "/camera/points:=" + POINTS],
            stdout=self.log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        self.get_distances = rospy.ServiceProxy(FRESH + "get_distances", GetDistances)
        self.get_distance = rospy.ServiceProxy(FRESH + "get_distance", GetDistance)

    def wait_until_ready(self):
        """@return why it is not; empty: it is"""
        ready = rospy.ServiceProxy(FRESH + "list_bodies", ListBodies)
        end = time.monotonic() + LONGEST_START
        while time.monotonic() < end:
            if self.process.poll() is not None:
                return "the fresh node has ended: see its log"
            try:
                answer = ready()
                if answer.ready:
                    return "; ".join(problem.message for problem in answer.problems)
            except rospy.ServiceException:
                pass
            time.sleep(0.1)
        return "the fresh node is not ready after %d s" % LONGEST_START

    def has_cloud(self):
        query = DistanceQuery(body_a="wam7", body_b="camera")
        end = time.monotonic() + LONGEST_WAIT
        while time.monotonic() < end:
            status = self.get_distance(query).result.nearest.status
            if status.code != PairStatus.MISSING_TRANSFORM:
                return True
            time.sleep(0.05)
        return False

    def end(self):
        self.process.send_signal(signal.SIGINT)
        try:
            self.process.wait(20.0)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.log.close()


class Comparer:
    """Compares what the node has published with what a fresh one answers."""

    def __init__(self, program, folder, distances, camera, pair_topics, reports):
        self.program, self.folder = program, folder
        self.distances, self.camera, self.pair_topics, self.reports = distances, camera, pair_topics, reports
        self.get_scene = rospy.ServiceProxy(NODE + "get_scene", GetScene)
        self.publisher = rospy.Publisher(POINTS, PointCloud2, queue_size=1)

    def compare(self):
        found = Comparison()
        node = None
        try:
            files = self.resting_scene()
            node = FreshNode(self.program, self.folder, files)
            found.failed = node.wait_until_ready()
            if found.failed:
                found.different = 1  # a scene that get_scene gives loads
            else:
                self._compare(node, files, found)
        except rospy.ServiceException as problem:
            found.failed = str(problem)
        finally:
            if node:
                node.end()
        return found

    def resting_scene(self):
        """The files of get_scene, once they do not change any more."""
        end = time.monotonic() + LONGEST_WAIT
        before, files = None, self.get_scene(with_meshes=True).files
        while before != texts(files) and time.monotonic() < end:
            before = texts(files)
            time.sleep(REST)
            files = self.get_scene(with_meshes=True).files
        return files

    def sample(self):
        """Some messages of distances and the one of the camera that their cloud is of; None: it is never served."""
        camera = pid_of("/simulate_camera")
        if camera is None:
            return None
        os.kill(camera, signal.SIGSTOP)
        try:
            end = time.monotonic() + CAMERA_RESTS
            while time.monotonic() < end:
                cloud, messages = self.newest_cloud(), self.collected()
                # Messages that were on their way when the camera was stopped have come by then.
                stamp = self.reports.stamp_after(time.monotonic())
                if len(messages) >= SAMPLES and stamp == stamp_text(cloud) == stamp_text(self.newest_cloud()):
                    return messages, cloud
        finally:
            os.kill(camera, signal.SIGCONT)
        return None

    def newest_cloud(self):
        """The newest message of the camera, once the node says that it serves it."""
        end = time.monotonic() + CAMERA_RESTS
        while time.monotonic() < end:
            cloud = PointCloud2().deserialize(self.camera.newest()[-1][1])
            if self.reports.stamp_of_cloud() == stamp_text(cloud):
                break
            time.sleep(0.02)
        return cloud

    def collected(self):
        """Some messages of distances from now on."""
        time.sleep(SETTLES)
        begins = time.monotonic()
        time.sleep(COLLECTS)
        known = [buffer for at, buffer in self.distances.newest() if at > begins]
        return [Distances().deserialize(buffer) for buffer in known[len(known) % SAMPLES::max(1, len(known) // SAMPLES)]]

    def _wait_for_listener(self):
        end = time.monotonic() + LONGEST_WAIT
        while self.publisher.get_num_connections() == 0 and time.monotonic() < end:
            time.sleep(0.02)

    def _compare(self, node, files, found):
        time.sleep(HISTORY)
        sample = self.sample()
        if sample is None:
            found.failed = "no message of the camera was served in time, or no distances came"
            return
        self._wait_for_listener()
        self.publisher.publish(sample[1])
        has_cloud = node.has_cloud()
        pairs = [pair for message in sample[0] for pair in message.pairs]
        seen = [pair for pair in pairs if pair.status.code in SOLVED and (has_cloud or not has_camera(pair))]
        found.unsolved = len(pairs) - len(seen)
        lists = [message for message in (topic.at(pair.header.stamp) for topic in self.pair_topics for pair in seen
                                         if pair.pair == topic.pair) if message]
        answers = node.get_distances([query_of(pair) for pair in seen] +
                                     [query_of(message.nearest, with_niches=True) for message in lists])
        if texts(self.get_scene(with_meshes=True).files) != texts(files):
            found.failed = "the scene has changed meanwhile"
            return
        for pair, answer in zip(seen, answers.results):
            found.compare(pair, answer.nearest)
            found.cloud_pairs += has_camera(pair)
        for message, answer in zip(lists, answers.results[len(seen):]):
            found.compare_lists(message, answer)


def stamp_text(message):
    """Its stamp as the diagnostics write it."""
    return "%d.%09d" % (message.header.stamp.secs, message.header.stamp.nsecs)


def texts(files):
    return [file.text for file in files]


def has_camera(pair):
    return "camera" in (pair.body_a, pair.body_b)


def query_of(pair, **fields):
    return DistanceQuery(body_a=pair.body_a, body_b=pair.body_b, stamp=pair.header.stamp, **fields)
