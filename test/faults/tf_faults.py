"""Wrong and hostile transforms, and transforms of other publishers."""

import math
import threading
import time

import genpy
import rospy
from attacks import Group, expect
from tf2_msgs.msg import TFMessage

group = Group("tf", {"parameters": {"stale_after": 1.0}})
NAN, INF = float("nan"), float("inf")
CALLER = "/faults"


def publisher(topic="/tf", latch=False):
    """One publisher for each topic, kept."""
    key = (topic, latch)
    if key not in publisher.kept:
        publisher.kept[key] = rospy.Publisher(topic, TFMessage, queue_size=1000, latch=latch)
        time.sleep(1.0)  # until subscribers have connected; a message that comes too early is lost
    return publisher.kept[key]


publisher.kept = {}


def send(arena, *transforms, times=3, topic="/tf"):
    for _ in range(times):
        publisher(topic).publish(TFMessage(list(transforms)))
        time.sleep(0.05)


def wrong_box_b(arena, stamp, parent="world", child="box_b", **pose):
    """A wrong transform: box_b 40 m away."""
    pose.setdefault("x", 40.0)
    return arena.frames.transform(parent, child, stamp, **pose)


def later(seconds):
    return rospy.Time.now() + rospy.Duration(seconds)


def recovers(arena, timeout=15.0):
    """The node follows the motion again."""
    arena.require_tracking(timeout)


def never_wrong(arena, attack, timeout=15.0, named=()):
    """Attacks. Distances with status OK must be right, the node must recover, and the log must contain `named`."""
    arena.listener.forget()
    mark = arena.node.log_length()
    attack()
    recovers(arena, timeout)
    expect(arena.listener.wrong is None, str(arena.listener.wrong))
    for word in named:
        arena.wait_until(lambda word=word: word in arena.node.log(mark), 10.0, "the log does not name '%s'" % word)


# Wrong stamps. The transforms that follow are right and must be used.

for label, ahead in {"1000_s_ahead": 1000.0, "60_s_ahead": 60.0, "a_year_ahead": 3e7}.items():
    group.add("stamp_" + label, lambda arena, ahead=ahead: never_wrong(
        arena, lambda: send(arena, wrong_box_b(arena, later(ahead))), named=(CALLER, "box_b")), deadline=60.0,
        fast=label == "1000_s_ahead")
group.add("stamp_2_s_ahead", lambda arena: (send(arena, wrong_box_b(arena, later(2.0))), recovers(arena, 20.0)),
          deadline=60.0)
STAMPS = {"of_2e31_s": genpy.Time(2**31, 0), "of_4e9_s": genpy.Time(2**32 - 1, 999999999), "of_2e31_s_less_one":
          genpy.Time(2**31 - 1, 999999999)}
for label, stamp in STAMPS.items():
    group.add("stamp_" + label, lambda arena, stamp=stamp: never_wrong(
        arena, lambda: send(arena, wrong_box_b(arena, stamp)), named=(CALLER,)), deadline=60.0, fast=label == "of_2e31_s")


@group.attack(deadline=60.0)
def stamp_1000_s_ahead_of_another_frame(arena):
    """Frames that no body uses do no harm either."""
    never_wrong(arena, lambda: send(arena, wrong_box_b(arena, later(1000.0), child="elsewhere")))


@group.attack(deadline=60.0)
def stamp_1000_s_ahead_of_every_frame(arena):
    def attack():
        now = later(1000.0)
        send(arena, *arena.player.message(now).transforms)
    never_wrong(arena, attack)


@group.attack(deadline=60.0)
def stamp_long_ago(arena):
    never_wrong(arena, lambda: send(arena, wrong_box_b(arena, genpy.Time(1000, 0)), times=20))


@group.attack(deadline=60.0)
def stamp_zero(arena):
    """tf2 treats stamp 0 like any other old time."""
    never_wrong(arena, lambda: send(arena, wrong_box_b(arena, genpy.Time(0, 0)), times=20))


@group.attack(deadline=60.0)
def publisher_whose_clock_is_an_hour_ahead_goes_on(arena):
    """While it sends and afterwards, distances are right or not OK."""
    def attack():
        for _ in range(100):
            send(arena, wrong_box_b(arena, later(3600.0)), times=1)
    never_wrong(arena, attack, named=(CALLER,))


# Values

QUATERNIONS = {"nan": (NAN, 0.0, 0.0, 1.0), "zero": (0.0, 0.0, 0.0, 0.0), "twice_a_unit": (0.0, 0.0, 0.0, 2.0),
               "inf": (0.0, 0.0, 0.0, INF), "1e200": (0.0, 0.0, 1e200, 0.0), "denormal": (0.0, 0.0, 0.0, 5e-324)}
for label, quaternion in QUATERNIONS.items():
    group.add("quaternion_" + label, lambda arena, quaternion=quaternion: never_wrong(
        arena, lambda: send(arena, wrong_box_b(arena, rospy.Time.now(), quaternion=quaternion), times=20)), deadline=60.0,
        fast=label == "zero")
POSITIONS = {"nan": NAN, "inf": INF, "minus_inf": -INF, "1e308": 1e308, "1e200": 1e200}
for label, position in POSITIONS.items():
    group.add("position_" + label, lambda arena, position=position: never_finite_but_wrong(arena, position), deadline=60.0,
              fast=label == "1e200")


def never_finite_but_wrong(arena, position):
    """No message has status OK and a distance that is not a number."""
    problems = []

    def look(message):
        problems.extend("%s: status %d with %r" % (pair.pair, pair.status.code, pair.distance) for pair in message.pairs
                        if pair.has_distance and not math.isfinite(pair.distance))
    subscriber = rospy.Subscriber(arena.node.name + "/distances", arena.messages.Distances, look)
    try:
        arena.player.dropped = {"box_b"}
        for _ in range(40):
            send(arena, wrong_box_b(arena, rospy.Time.now(), x=position), times=1)
    finally:
        arena.player.dropped = set()
        subscriber.unregister()
    expect(not problems, str(problems[:1]))
    recovers(arena)


# Names

BAD_FRAMES = {"empty_child": ("world", ""), "empty_parent": ("", "box_b"), "itself": ("box_b", "box_b"),
              "slash": ("world", "/"), "with_blank": ("world", "a b"), "with_nul": ("world", "box_b\0"),
              "of_a_megabyte": ("world", "f" * 2**20), "parent_of_a_megabyte": ("f" * 2**20, "box_b"),
              "unicode": ("w\u00f6rld", "box_b\u202e"), "newline": ("world", "box\n[FATAL] gone")}
for label, (parent_name, child_name) in BAD_FRAMES.items():
    group.add("frame_" + label, lambda arena, parent=parent_name, child=child_name: (
        send(arena, wrong_box_b(arena, rospy.Time.now(), parent, child), times=5), recovers(arena)), deadline=60.0)


# The shape of the tree

def tree_attack(arena, *links, times=20, timeout=25.0):
    """Links of parent and child, sent for a second; afterwards the node recovers."""
    for _ in range(times):
        now = rospy.Time.now()
        send(arena, *(arena.frames.transform(parent, child, now, 0.5) for parent, child in links), times=1)
    recovers(arena, timeout)


group.add("loop_of_two_frames", lambda arena: tree_attack(arena, ("box_b", "box_a"), ("box_a", "box_b")), deadline=60.0)
group.add("loop_of_three_frames", lambda arena: tree_attack(arena, ("l1", "l2"), ("l2", "l3"), ("l3", "l1")), deadline=60.0)
group.add("loop_with_the_reference_frame", lambda arena: tree_attack(arena, ("box_b", "world")), deadline=60.0)
group.add("another_parent", lambda arena: tree_attack(arena, ("ball", "box_b")), deadline=60.0)
group.add("parent_that_hangs_in_the_air", lambda arena: tree_attack(arena, ("nowhere", "box_b")), deadline=60.0)


@group.attack(deadline=60.0)
def reference_frame_gets_a_parent(arena):
    """Sent once: frames below the reference frame still work."""
    send(arena, arena.frames.transform("map", "world", rospy.Time.now(), 3.0), times=1)
    for _ in range(4):
        time.sleep(1.0)
        recovers(arena, 10.0)
        from request_checks import ask
        response = ask(arena, posed=False)
        expect(response.success, "get_distance: " + response.message)


@group.attack(deadline=60.0)
def chain_of_5000_frames(arena):
    now = rospy.Time.now()
    links = [arena.frames.transform("c%d" % index, "c%d" % (index + 1), now, 0.001) for index in range(5000)]
    send(arena, *links, times=2)
    send(arena, arena.frames.transform("c5000", "world", now), times=1)
    recovers(arena, 30.0)


@group.attack(deadline=90.0, growth_mb=300.0)
def ten_thousand_frames(arena):
    for part in range(10):
        now = rospy.Time.now()
        send(arena, *(arena.frames.transform("world", "t%d_%d" % (part, index), now) for index in range(1000)), times=2)
    recovers(arena, 30.0)


@group.attack(deadline=120.0, growth_mb=300.0, storms=False)
def hundred_thousand_frames_of_long_names(arena):
    """tf2 never forgets names, so the node must limit their number."""
    for part in range(100):
        now = rospy.Time.now()
        send(arena, *(arena.frames.transform("world", "n" * 500 + "%d_%d" % (part, index), now) for index in range(1000)),
             times=1)
    recovers(arena, 60.0)


# Other publishers

@group.attack(deadline=60.0)
def two_publishers_that_fight(arena):
    """The node cannot know which one is right; it goes on and recovers when the other one stops."""
    ends = time.monotonic() + 3.0
    while time.monotonic() < ends:
        send(arena, wrong_box_b(arena, rospy.Time.now()), times=1)
    recovers(arena)


@group.attack(deadline=60.0, storms=False)
def frame_that_vanishes_and_comes_back(arena):
    """While box_b's transforms are missing the pair says so."""
    arena.player.dropped = {"box_b"}
    try:
        stale = arena.messages.PairStatus.STALE_TRANSFORM
        arena.wait_until(lambda: arena.listener.last and arena.listener.last[1] == stale, 15.0,
                         "the pair does not become stale: " + arena.listener.seen())
        time.sleep(1.0)
        expect(arena.listener.last[1] == stale, "the pair is stale no longer: " + arena.listener.seen())
    finally:
        arena.player.dropped = set()
    recovers(arena)


@group.attack(deadline=60.0)
def static_and_dynamic_at_once(arena):
    send(arena, wrong_box_b(arena, rospy.Time.now()), topic="/tf_static", times=5)
    recovers(arena, 30.0)


@group.attack(deadline=60.0)
def static_with_hostile_values(arena):
    send(arena, wrong_box_b(arena, rospy.Time.now(), x=NAN), wrong_box_b(arena, later(1e6), child="static_b"),
         wrong_box_b(arena, rospy.Time.now(), child="static_c", quaternion=(0.0, 0.0, 0.0, 0.0)), topic="/tf_static")
    recovers(arena, 30.0)


@group.attack(deadline=90.0)
def five_thousand_messages_a_second(arena):
    def flood():
        ends = time.monotonic() + 5.0
        while time.monotonic() < ends:
            now = rospy.Time.now()
            publisher().publish(TFMessage([arena.frames.transform("world", "flood", now)] * 5))
            time.sleep(0.0004)
    threads = [threading.Thread(target=flood, daemon=True) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(30.0)
    recovers(arena, 30.0)


@group.attack(deadline=60.0)
def message_of_100000_transforms(arena):
    transform = arena.frames.transform("world", "flood", rospy.Time.now())
    send(arena, *[transform] * 100000, times=1)
    recovers(arena, 30.0)


@group.attack(deadline=60.0)
def message_without_transforms(arena):
    send(arena, times=100)
    recovers(arena)
