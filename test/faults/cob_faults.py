"""The bridge for cob_twist_controller under hostile obstacles, registrations and distances."""

import os
import random
import struct
import sys
import time

import processes
import ros_wire
import rospy
from arena import REPOSITORY
from attacks import Group, expect
from bridge_faults import Bridge, collision_object, solid, pose
from cloud_messages import bytes_class

sys.path.insert(0, os.path.join(REPOSITORY, "src", "ros", "bridges"))
import cob_messages  # noqa: E402

group = Group("cob", {})
SERVICE = "/obstacle_distance/registerLinkOfInterest"
NAN = float("nan")


class Served:
    """The bridge with box_a as its link, and what it publishes."""

    def __init__(self, arena):
        self.bridge = Bridge(arena, "cob_bridge.py", ("_links:=[box_a]", "_chain_base_link:=world", "_largest_distance:=5.0"))
        kind, _ = cob_messages.message_classes()
        self.last = None
        rospy.Subscriber("/obstacle_distance", kind, self.keep, queue_size=10)
        obstacle = type(collision_object("x"))
        self.raw = bytes_class(obstacle._type, obstacle._md5sum, obstacle._full_text)
        self.sender = rospy.Publisher("/obstacle_distance/registerObstacle", self.raw, queue_size=100)
        self.bridge.until(lambda: self.sender.get_num_connections() > 0, 30.0, "it does not listen")

    def keep(self, message):
        self.last = message

    def publish(self, message):
        self.sender.publish(self.raw(message if isinstance(message, bytes) else ros_wire.serialized(message)))


def served(arena):
    found = getattr(arena, "cob_served", None)
    if found is None or found.bridge.process.poll() is not None:
        found = arena.cob_served = Served(arena)
        close = arena.stop_node
        arena.stop_node = lambda: (processes.end_group(found.bridge.process), close())[1]
    return found


def require_served(arena):
    """Right distances of box_a to box_b come, and an obstacle that is registered is among them."""
    watched = served(arena)

    def of(obstacle):
        return [one for one in watched.last.distances if one.obstacle_id == obstacle] if watched.last else []

    def right():
        near = of("box_b")
        return near and abs(near[0].distance - arena.frames.gap_at(near[0].header.stamp.to_sec())) < 5e-3 and of("good")
    watched.last = None
    watched.bridge.until(right, 40.0, "no right distances", lambda: watched.publish(
        collision_object("good", [(solid(1, 1, 1, 1), pose(0.0, 0.0, 3.0))])))
    arena.require_tracking()


def survives(label, make):
    def act(arena):
        require_served(arena)
        for message in make():
            served(arena).publish(message)
        require_served(arena)
    group.add(label, act, deadline=150.0, storms=False)


survives("obstacles_that_are_cut", lambda: [ros_wire.serialized(collision_object("bad"))[:cut] for cut in (0, 1, 20, 50, 100)])
survives("obstacles_of_noise", lambda: [bytes(random.Random(seed).randrange(256) for _ in range(200)) for seed in range(50)])
survives("obstacles_that_cannot_be", lambda: [collision_object("bad", [one]) for one in (
    (solid(1, NAN, 1, 1), pose()), (solid(2, 1e300), pose()), (solid(2, 1), pose(NAN)), (solid(99), pose()),
    (solid(2, 1), pose(rotation=(1e200, 0, 0, 1e200))))])
survives("obstacles_with_odd_names", lambda: [collision_object(name) for name in (
    "", "a\0b", "\x1b[2J", "box_a", "n" * 10**6, "<octomap>", "../x", "*")])
survives("five_hundred_obstacles", lambda: [collision_object("o%d" % index, [
    (solid(2, 0.1), pose(30.0 + index % 20, index // 20, 0.0))]) for index in range(500)])
survives("operations_that_are_none", lambda: [collision_object("bad", operation=one) for one in (-128, 4, 127, 3, 1)])


def register(arena, data):
    kind = cob_messages.registration_class()
    code, text, uri = arena.master().lookupService("/faults", SERVICE)
    expect(code == 1, "the service is not offered: " + text)
    answer = ros_wire.call_bytes(uri, SERVICE, kind._md5sum, data, 20.0 * arena.patience)
    return kind._response_class().deserialize(answer)


@group.attack(deadline=120.0, storms=False)
def links_that_are_none(arena):
    require_served(arena)
    for name in (b"", b"nobody", b"\xff\xfe", b"a\0b", b"\x1b[2J\n", b"n" * 10**6, b"box_a/", b"*"):
        answer = register(arena, struct.pack("<I", len(name)) + name)
        expect(not answer.success and answer.message, "%r was registered" % name[:20])
    for body in (b"", b"\x01", struct.pack("<I", 2**32 - 1) + b"x"):
        try:
            expect(not register(arena, body).success, "%r was registered" % body)
        except ros_wire.CallFailed:
            pass
    require_served(arena)


@group.attack(deadline=120.0, storms=False)
def distances_of_another_publisher(arena):
    """NaN, unknown names and frames beside the node's own: none of it is published as a distance."""
    require_served(arena)
    rival = rospy.Publisher(arena.node.name + "/distances", arena.messages.Distances, queue_size=10)
    message = arena.messages.Distances()
    for distance, frame in ((NAN, "world"), (0.1, "nowhere"), (0.1, ""), (-1.0, "world")):
        pair = arena.messages.PairDistance(pair="evil", body_a="box_a", body_b="evil", distance=distance, has_distance=True,
                                          has_points=True)
        pair.header.frame_id = frame
        pair.point_a.x = NAN
        message.pairs.append(pair)
    try:
        watched = served(arena)
        ends = time.monotonic() + 5.0
        while time.monotonic() < ends:
            rival.publish(message)
            time.sleep(0.05)
            evil = [one for one in (watched.last.distances if watched.last else []) if one.obstacle_id == "evil"]
            expect(not evil, "published: %s" % evil)
    finally:
        rival.unregister()
    require_served(arena)
