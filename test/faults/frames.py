"""The motion that the node follows during the attacks, and its right distances."""

import math
import threading
import time

import rospy
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage


def transform(parent, child, stamp, x=0.0, y=0.0, z=0.0, quaternion=(0.0, 0.0, 0.0, 1.0)):
    message = TransformStamped()
    message.header.stamp = stamp
    message.header.frame_id = parent
    message.child_frame_id = child
    message.transform.translation.x = x
    message.transform.translation.y = y
    message.transform.translation.z = z
    rotation = message.transform.rotation
    rotation.x, rotation.y, rotation.z, rotation.w = quaternion
    return message


def gap_at(seconds):
    """Distance of the boxes box_a and box_b at a time, metres."""
    return 1.0 + 0.5 * math.sin(seconds)


class FramePlayer(threading.Thread):
    """Publishes the frames of the scene: box_b swings along x, the others stand still."""
    RATE = 40.0

    def __init__(self, topic="/tf"):
        super().__init__(daemon=True)
        self.publisher = rospy.Publisher(topic, TFMessage, queue_size=100)
        self.clock = rospy.Time.now
        self.dropped = set()
        self.running = True
        self.playing = True
        self.start()

    def message(self, now):
        still = {"box_a": (0.0, 0.0, 0.0), "ball": (0.0, 4.0, 0.0), "hook": (0.0, -3.0, 0.4)}
        places = dict(still, box_b=(1.0 + gap_at(now.to_sec()), 0.0, 0.0))
        return TFMessage([transform("world", frame, now, *place) for frame, place in sorted(places.items())
                          if frame not in self.dropped])

    def run(self):
        while self.running:
            now = self.clock()
            if self.playing and now is not None and not now.is_zero():
                self.publisher.publish(self.message(now))
            time.sleep(1.0 / self.RATE)


class DistanceListener:
    """Receives ~distances; finds messages with status OK and a wrong distance."""
    ALLOWED = 5e-3  # m; between two transforms the motion is interpolated

    def __init__(self, name, distances_class, status_class):
        self.lock = threading.Lock()
        self.last = None
        self.wrong = None
        self.count = 0
        self.ok = status_class.OK
        self.subscriber = rospy.Subscriber(name + "/distances", distances_class, self.receive, queue_size=10)

    def close(self):
        self.subscriber.unregister()

    def receive(self, message):
        now = rospy.Time.now().to_sec()
        for pair in message.pairs:
            if pair.pair != "boxes":
                continue
            stamp = pair.header.stamp.to_sec()
            right = pair.status.code == self.ok and abs(pair.distance - gap_at(stamp)) <= self.ALLOWED \
                and abs(now - stamp) < 2.0
            with self.lock:
                self.last = (time.monotonic(), pair.status.code, pair.distance, stamp, right, pair.status.message)
                self.count += 1
                # Wrong for the time of arrival, independent of its stamp.
                near = min(abs(pair.distance - gap_at(now - late)) for late in (0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0)) \
                    if pair.status.code == self.ok else 0.0
                if near > 0.1:
                    self.wrong = "status OK with a distance of %.3f m, stamped %.1f s from now, where the boxes are " \
                        "%.3f m apart" % (pair.distance, stamp - now, gap_at(now))

    def forget(self):
        with self.lock:
            self.wrong = None
            self.last = None

    def wait_until_right(self, timeout):
        """Whether a right distance arrives within the time."""
        began = time.monotonic()
        while time.monotonic() - began < timeout:
            with self.lock:
                if self.last and self.last[0] > began and self.last[4]:
                    return True
            time.sleep(0.02)
        return False

    def seen(self):
        with self.lock:
            if self.last is None:
                return "no message came"
            return "status %d, distance %.4f, %s" % (self.last[1], self.last[2], self.last[5])
