"""Hostile queries of distances."""

import math
import threading
import time

import genpy
from attacks import Group, expect
from request_checks import MEGABYTE, ask, call, query, require_refused, require_sound

group = Group("queries", {})

NAN, INF = float("nan"), float("inf")
NAMES = {
    "empty": "", "unknown": "nobody", "of_a_megabyte": MEGABYTE, "unicode": "b\u00f6x_\U0001f916_\u202e",
    "with_nul": "box_a\0", "with_newline": "box_a\n[FATAL] all is lost", "format": "%s%s%n%d%x", "path": "../../box_a",
    "pattern": "*", "slash": "/box_a",
}


def refuse(name, words, **fields):
    group.add(name, lambda arena: require_refused(ask(arena, **fields), *words))


for label, text in NAMES.items():
    if label != "slash":
        refuse("body_a_" + label, ("body",), body_a=text)
    refuse("body_b_" + label, ("body",), body_b=text)
refuse("both_bodies_the_same", ("body",), body_b="box_a")


@group.attack()
def body_name_of_invalid_utf8(arena):
    require_refused(ask(arena, body_a="box_9", replace=((b"box_9", b"\xff\xfe\xc0\x80\xed"),)), "body")


def finite_or_refused(arena, **fields):
    """A far pose is answered with finite numbers or refused."""
    response = ask(arena, **fields)
    if not response.success:
        require_refused(response)
        return
    nearest = response.result.nearest
    numbers = (nearest.distance, nearest.lower_bound, nearest.point_a.x, nearest.point_b.x)
    expect(all(math.isfinite(number) for number in numbers), "the answer is ok with %s" % (numbers,))
    expect(0.0 <= nearest.lower_bound <= nearest.distance * (1.0 + 1e-9), "lower bound %g above the distance %g" % (
        nearest.lower_bound, nearest.distance))


for label, value in {"nan": NAN, "inf": INF, "minus_inf": -INF}.items():
    refuse("position_" + label, ("pose_b", "pose"), pose_b__pose__position__y=value)
    refuse("quaternion_" + label, ("pose_b", "pose"), pose_b__pose__orientation__w=value)
    refuse("position_a_" + label, ("pose_a", "pose"), pose_a__pose__position__z=value)
for label, value in {"1e308": 1e308, "minus_1e200": -1e200, "1e154": 1e154, "1e30": 1e30, "1e16": 1e16}.items():
    group.add("position_" + label, lambda arena, value=value: finite_or_refused(
        arena, pose_b__pose__position__x=value))
    group.add("both_positions_" + label, lambda arena, value=value: finite_or_refused(
        arena, pose_a__pose__position__x=value, pose_b__pose__position__x=value))
for label, value in {"twice_a_unit": 2.0, "1e308": 1e308, "denormal": 5e-324, "slightly_off": 1.01}.items():
    refuse("quaternion_" + label, ("quaternion", "rotation", "orientation"), pose_b__pose__orientation__w=value)


@group.attack(fast=True)
def quaternion_of_zeros(arena):
    """Refused, or taken as the identity, as in other ROS programs."""
    response = ask(arena, pose_b__pose__orientation__w=0.0)
    if response.success:
        expect(response.result.nearest.distance == 1.0, "distance %r instead of 1" % response.result.nearest.distance)
    else:
        require_refused(response, "quaternion")


@group.attack(fast=True)
def position_denormal(arena):
    response = ask(arena, pose_b__pose__position__y=5e-324)
    expect(response.success and response.result.nearest.distance == 1.0, "no distance of 1: " + response.message)


for value in (5, 17, 255):
    refuse("accuracy_%d" % value, ("accuracy",), accuracy=value)
for label, value in {"negative": -1.0, "nan": NAN, "minus_inf": -INF}.items():
    refuse("absolute_tolerance_" + label, ("tolerance",), accuracy=3, absolute_tolerance=value)
    refuse("relative_tolerance_" + label, ("tolerance",), accuracy=3, relative_tolerance=value)
    refuse("time_budget_" + label, ("budget",), accuracy=4, time_budget=value)
refuse("relative_tolerance_above_one", ("tolerance",), accuracy=3, relative_tolerance=1e300)
refuse("tolerance_at_a_level_without_proof", ("tolerance", "accuracy"), accuracy=1, absolute_tolerance=0.1)
refuse("contacts_at_a_level_without_proof", ("contacts",), accuracy=2, with_contacts=True)
for label, value in {"denormal": 5e-324, "1e308": 1e308}.items():
    group.add("time_budget_" + label, lambda arena, value=value: finite_or_refused(
        arena, body_a="hook", body_b="comb", accuracy=3, time_budget=value))


@group.attack()
def largest_niche_count_of_four_billion(arena):
    response = ask(arena, body_a="hook", body_b="comb", accuracy=4, with_niches=True, largest_niche_count=2**32 - 1)
    expect(response.success, response.message)


def bounded(arena, seconds, **fields):
    """A correct bracket, within the time."""
    began = time.monotonic()
    finite_or_refused(arena, body_a="hook", body_b="comb", **fields)
    took = time.monotonic() - began
    expect(took <= seconds * arena.patience, "it took %.1f s" % took)


for label, distance in {"100_m": 1e2, "1e7_m": 1e7, "1e9_m": 1e9}.items():
    group.add("every_niche_at_" + label, lambda arena, x=distance: bounded(
        arena, 15.0, accuracy=4, with_niches=True, pose_b__pose__position__x=x), deadline=60.0)
    group.add("certified_niches_at_" + label, lambda arena, x=distance: bounded(
        arena, 15.0, accuracy=3, with_niches=True, pose_b__pose__position__x=x), deadline=60.0)
group.add("budget_of_a_millisecond_at_100_m", lambda arena: bounded(
    arena, 4.0, accuracy=4, with_niches=True, time_budget=0.001, pose_b__pose__position__x=100.0), deadline=60.0)

STAMPS = {"in_the_future": genpy.Time(4294967295, 999999999), "at_one_nanosecond": genpy.Time(0, 1),
          "long_ago": genpy.Time(1000000000, 0), "at_2e31": genpy.Time(2**31, 0)}
for label, stamp in STAMPS.items():
    refuse("stamp_" + label, (), posed=False, stamp=stamp)


@group.attack()
def stamp_with_four_billion_nanoseconds(arena):
    stamp = genpy.Time(1234567890, 987654321)
    replaced = bytes.fromhex("d2029649b168de3a"), bytes.fromhex("d2029649ffffffff")
    require_refused(ask(arena, posed=False, stamp=stamp, replace=(replaced,)))


FRAMES = {"unknown": "nowhere", "of_a_megabyte": MEGABYTE, "slash": "/", "with_blank": "a b", "with_nul": "world\0",
          "slashes": "////", "unicode": "w\u00f6rld", "newline": "a\nb"}
for label, frame in FRAMES.items():
    refuse("pose_frame_" + label, ("frame", "transform"), pose_b__header__frame_id=frame)


# Several queries in one call

@group.attack(fast=True)
def list_that_is_empty(arena):
    require_refused(call(arena, "get_distances"), "queries")


@group.attack(fast=True)
def one_bad_question_among_good_ones(arena):
    response = call(arena, "get_distances", queries=[query(arena), query(arena, body_a="nobody"), query(arena)])
    require_refused(response, "nobody")
    expect([bool(result.nearest.has_distance) for result in response.results] == [True, False, True],
           "the good questions were not answered")


def answered_or_limited(arena, question, count):
    """Every query is answered, or the whole list is refused as too long."""
    response = call(arena, "get_distances", timeout=60.0, queries=[question] * count)
    if len(response.results) != count:
        require_refused(response, "queries", "limit")


@group.attack(deadline=90.0, growth_mb=600.0, silence=15.0)
def hundred_thousand_unknown_bodies(arena):
    answered_or_limited(arena, query(arena, body_a="nobody"), 100000)


@group.attack(deadline=90.0, growth_mb=400.0, silence=15.0)
def ten_thousand_good_questions(arena):
    answered_or_limited(arena, query(arena), 10000)


@group.attack(deadline=120.0, growth_mb=400.0, silence=15.0)
def thousand_questions_for_every_niche(arena):
    """They may take long; meanwhile another client is answered, or refused with the reason."""
    heavy = query(arena, body_a="hook", body_b="comb", accuracy=4, with_niches=True)
    asking = threading.Thread(target=lambda: call(arena, "get_distances", timeout=60.0, queries=[heavy] * 1000),
                              daemon=True)
    asking.start()
    time.sleep(1.0)
    for _ in range(5):
        require_sound(ask(arena, timeout=15.0))
    asking.join(80.0 * arena.patience)


@group.attack(deadline=60.0)
def two_hundred_long_names(arena):
    answered_or_limited(arena, query(arena, body_a="m" * 50000), 200)
