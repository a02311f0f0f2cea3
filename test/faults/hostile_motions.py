"""Motions that get_clearance must refuse, or answer with a bracket."""

import math
import struct
import threading

import genpy
import ros_wire
from attacks import Failed, Group, expect, shortened
from geometry_msgs.msg import PoseStamped
from request_checks import MEGABYTE, call, require_refused, require_sound, set_field
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

group = Group("motions", {})
NAN, INF = float("nan"), float("inf")


def waypoint(x, stamp=genpy.Time(), **fields):
    """A pose of the ball beside the comb, changed by the fields."""
    pose = PoseStamped()
    pose.header.stamp = stamp
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = x, 3.0, 8.0
    pose.pose.orientation.w = 1.0
    for name, value in fields.items():
        set_field(pose, name, value)
    return pose


def path(arena, *poses, timeout=20.0, **fields):
    return call(arena, "get_clearance", timeout, poses=list(poses) or [waypoint(-4.0), waypoint(4.0)],
                **{"body": "ball", **fields})


def trajectory(arena, names, points, **fields):
    points = [JointTrajectoryPoint(**point) if isinstance(point, dict) else JointTrajectoryPoint(positions=point)
              for point in points]
    return call(arena, "get_clearance", trajectory=JointTrajectory(joint_names=names, points=points), **fields)


def require_bracket(response):
    expect(response.success, "refused: " + shortened(response.message))
    expect(response.has_distance and 0.0 <= response.lower_bound <= response.distance < INF,
           "status %d, distance %g, lower bound %g" % (response.status, response.distance, response.lower_bound))
    expect(math.isfinite(response.time) and math.isfinite(response.point_a.x), "time %g, point %g" % (
        response.time, response.point_a.x))


def refuse(name, words, act, fast=False):
    group.add(name, lambda arena: require_refused(act(arena), *words), fast=fast)


def answer(name, act, fast=False):
    group.add(name, lambda arena: require_bracket(act(arena)), fast=fast)


# Paths of poses

refuse("nothing", ("neither",), lambda arena: call(arena, "get_clearance"), fast=True)
refuse("both", ("a trajectory and a path",), lambda arena: path(arena, trajectory=JointTrajectory(joint_names=["wing"])))
for key, text in {"empty": "", "unknown": "nobody", "of_a_megabyte": MEGABYTE, "with_nul": "ball\0",
                  "group": "pair_of_boxes"}.items():
    refuse("body_" + key, (), lambda arena, text=text: path(arena, body=text))
for key, value in {"nan": NAN, "inf": INF, "1e19": 1e19, "minus_1e308": -1e308}.items():
    refuse("position_" + key, ("poses[1]", "waypoint 1"), lambda arena, value=value: path(arena, waypoint(0.0), waypoint(value)),
           fast=key == "nan")
for key, value in {"nan": NAN, "2": 2.0, "1e308": 1e308}.items():
    refuse("quaternion_" + key, ("quaternion", "orientation"), lambda arena, value=value: path(
        arena, waypoint(0.0), waypoint(1.0, pose__orientation__w=value)))
for key, frame in {"unknown": "moon", "of_a_megabyte": MEGABYTE, "with_nul": "world\0"}.items():
    refuse("frame_" + key, ("frame", "tf "), lambda arena, frame=frame: path(
        arena, *[waypoint(x, header__frame_id=frame) for x in (0.0, 1.0)]))
refuse("frames_differ", ("one frame",), lambda arena: path(arena, waypoint(0.0), waypoint(1.0, header__frame_id="box_a")))
refuse("times_descend", ("is not after",), lambda arena: path(
    arena, waypoint(0.0, genpy.Time(5)), waypoint(1.0, genpy.Time(4))), fast=True)
refuse("times_equal_though_poses_differ", ("is not after",), lambda arena: path(
    arena, waypoint(0.0, genpy.Time(5)), waypoint(1.0, genpy.Time(6)), waypoint(2.0, genpy.Time(6))))
for key, value in {"1e18": 1e18, "1e9": 1e9, "denormal": 5e-324}.items():
    answer("path_between_" + key, lambda arena, value=value: path(
        arena, waypoint(-value), waypoint(value), time_budget=2.0), fast=key == "1e18")
answer("path_of_one_pose", lambda arena: path(arena, waypoint(2.0)))
answer("path_of_equal_poses", lambda arena: path(arena, *[waypoint(2.0)] * 1000))
answer("path_of_half_turns", lambda arena: path(arena, waypoint(2.0), waypoint(
    2.0, pose__orientation__w=0.0, pose__orientation__x=1.0), waypoint(2.0)))
answer("path_until_the_last_stamp", lambda arena: path(
    arena, waypoint(-4.0, genpy.Time(0, 1)), waypoint(4.0, genpy.Time(2**32 - 1, 999999999))))
answer("path_of_ten_thousand_poses", lambda arena: path(
    arena, *[waypoint(4.0 * math.sin(index)) for index in range(10000)], time_budget=2.0))
refuse("path_of_ten_thousand_and_one", ("10001 waypoints",), lambda arena: path(arena, *[waypoint(2.0)] * 10001), fast=True)

# Trajectories; the scene has no robot

for key, names in {"unknown": ["wing"], "empty": [""], "of_a_megabyte": [MEGABYTE], "with_nul": ["wing\0"],
                   "twice": ["wing", "wing"]}.items():
    refuse("joint_" + key, (), lambda arena, names=names: trajectory(arena, names, [[0.0] * len(names)]))
SIZES = {
    "no_points": (["wing"], []), "no_names": ([], [[0.0]]), "too_few": (["wing"] * 2, [[0.0, 1.0], [0.0]]),
    "too_many": (["wing"], [[0.0], [0.0] * 100000]), "a_point_without": (["wing"], [[0.0], []]),
    "velocities": (["wing"], [{"positions": [0.0], "velocities": [0.0, 1.0]}]),
    "accelerations": (["wing"], [{"positions": [0.0], "velocities": [0.0], "accelerations": [0.0] * 3}]),
}
for key, (names, points) in SIZES.items():
    refuse("sizes_" + key, ("trajectory",), lambda arena, names=names, points=points: trajectory(arena, names, points),
           fast=key == "too_few")
refuse("million_joints_without_numbers", ("has no positions",), lambda arena: trajectory(
    arena, [""] * 10**6, [[]] * 10000), fast=True)
refuse("joint_state_of_other_sizes", (), lambda arena: trajectory(
    arena, ["wing"], [[0.0]], joints=JointState(name=["wing"] * 3, position=[0.0])))


@group.attack(deadline=120.0, growth_mb=2000.0, storms=False)
def ten_million_points(arena):
    """240 MB of request, really sent, as bytes: the message classes would take minutes."""
    point = ros_wire.serialized(JointTrajectoryPoint(time_from_start=genpy.Duration(0x7a7a7a7a, 0x1a1a1a1a)))
    service = arena.services.GetClearance
    request = ros_wire.serialized(service._request_class(trajectory=JointTrajectory(points=[JointTrajectoryPoint(
        time_from_start=genpy.Duration(0x7a7a7a7a, 0x1a1a1a1a))])))
    head, tail = request.split(struct.pack("<I", 1) + point)
    answered = ros_wire.call_bytes(arena.node.service_uri("get_clearance"), arena.node.name + "/get_clearance",
                                   service._md5sum, head + struct.pack("<I", 10**7) + point * 10**7 + tail,
                                   60.0 * arena.patience)
    response = service._response_class()
    response.deserialize(answered)
    require_refused(response, "10000000 waypoints")


# Numbers of the request

for field, values in {"tolerance": (-1.0, NAN, INF), "threshold": (-1.0, NAN, INF), "time_budget": (-1.0, NAN, 1e9)}.items():
    for value in values:
        refuse("%s_%g" % (field, value), (field,), lambda arena, field=field, value=value: path(
            arena, with_first_time=True, **{field: value}), fast=field == "tolerance")
answer("tolerance_denormal", lambda arena: path(arena, tolerance=5e-324, each_pair=True, time_budget=1.0))
answer("tolerance_1e308", lambda arena: path(arena, tolerance=1e308))
answer("threshold_1e308", lambda arena: path(arena, with_first_time=True, threshold=1e308))
answer("time_budget_denormal", lambda arena: path(arena, tolerance=1e-9, time_budget=5e-324), fast=True)
for key, text in {"empty": "", "unknown": "nobody", "of_a_megabyte": MEGABYTE, "with_nul": "a\0"}.items():
    refuse("cancelled_" + key, (), lambda arena, text=text: call(arena, "cancel_clearance", id=text))
answer("id_of_a_megabyte", lambda arena: path(arena, id=MEGABYTE))


@group.attack(deadline=90.0)
def twenty_at_once(arena):
    """Each is answered, or refused with a reason; some are answered."""
    answers, failures = [], []

    def ask():
        try:
            response = path(arena, timeout=60.0 * arena.patience)
            require_sound(response)
            answers.append(response.success)
        except Failed as failure:
            failures.append(str(failure))
    threads = [threading.Thread(target=ask) for _ in range(20)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    expect(not failures, "%d of 20: %s" % (len(failures), failures[:1]))
    expect(any(answers), "none was answered")
