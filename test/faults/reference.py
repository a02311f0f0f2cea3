"""Queries for comparing a node's answers with those of a fresh node, byte for byte."""

import math
import time

import genpy
import ros_wire
from attacks import Failed

PAIRS = (("box_a", "box_b"), ("box_a", "ball"), ("ball", "blocks"), ("hook", "comb"))
POSES = ((2.5, 0.1, -0.2, 0.3), (0.4, 1.7, 0.6, 1.1), (-0.2, 0.3, 0.1, -0.7))


def queries(messages):
    """With given poses, so that transforms have no influence; every level with a proof, with niches."""
    for body_a, body_b in PAIRS:
        for x, y, z, angle in POSES:
            for accuracy in (messages.DistanceQuery.ACCURACY_CERTIFIED, messages.DistanceQuery.ACCURACY_COMPLETE):
                query = messages.DistanceQuery(body_a=body_a, body_b=body_b, use_pose_a=True, use_pose_b=True)
                query.pose_a.pose.orientation.w = 1.0
                position = query.pose_b.pose.position
                position.x, position.y, position.z = x, y, z
                query.pose_b.pose.orientation.z = math.sin(0.5 * angle)
                query.pose_b.pose.orientation.w = math.cos(0.5 * angle)
                query.accuracy = accuracy
                query.with_niches = True
                query.with_contacts = True
                yield query


def without_times(message):
    """Sets stamps and measured times to 0, which may differ between two nodes."""
    for name in message.__slots__:
        value = getattr(message, name)
        if isinstance(value, genpy.Time):
            setattr(message, name, genpy.Time())
        elif name == "solve_time":
            setattr(message, name, 0.0)
        elif isinstance(value, genpy.Message):
            without_times(value)
        elif isinstance(value, list):
            for part in value:
                if isinstance(part, genpy.Message):
                    without_times(part)
    return message


def answer(node, query):
    """The response; a busy node is called again."""
    deadline = time.monotonic() + 60.0 * node.arena.patience
    while True:
        response = node.call("get_distance", node.arena.services.GetDistance,
                             node.arena.services.GetDistanceRequest(query=query), timeout=60.0)
        if response.success:
            return response
        if "BUSY" not in response.message or time.monotonic() > deadline:
            raise Failed("no answer for %s and %s: %s" % (query.body_a, query.body_b, response.message))
        time.sleep(0.2)


def answers(node):
    """The node's answers as bytes, one entry per query."""
    return [(query, ros_wire.serialized(without_times(answer(node, query)))) for query in queries(node.arena.messages)]


def require_equal(node, fresh):
    """Raises Failed at the first answer of the node that differs from the fresh node's."""
    for (query, mine), (_, theirs) in zip(answers(node), fresh):
        if mine != theirs:
            position = query.pose_b.pose.position
            raise Failed("the answer differs from a fresh node's: %s and %s at (%g, %g, %g), level %d" % (
                query.body_a, query.body_b, position.x, position.y, position.z, query.accuracy))
