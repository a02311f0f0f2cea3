"""What cob_control_msgs/ObstacleDistances says, from the pairs of a distance node, without ROS.

In: pairs with their distance or their niches, the links of interest, what is attached to what. Out: entries with points
in the frame of the pairs, and the pairs that have no distance.
"""

import math
from dataclasses import dataclass

_EXACT = (0, 1)  # PairStatus: OK, PENETRATING. With any other one that has a distance, that is an upper bound.


@dataclass(frozen=True)
class Entry:
    link: str
    obstacle: str
    distance: float  # m, 0 or more
    point_on_link: tuple
    point_on_obstacle: tuple
    frame: str   # of the points
    stamp: object


def links_of(bodies, links):
    """The link of interest that a body is, or that carries it, by the body's name.

    bodies: what each is attached to, by name, empty for nothing. links: names of bodies, of interest.
    """
    found = {}
    for body in bodies:
        at, steps = body, 0
        while at and at not in links and steps <= len(bodies):
            at, steps = bodies.get(at, ""), steps + 1
        if at in links:
            found[body] = at
    return found


def entries(pairs, link_of, largest_distance):
    """Entries of pairs (PairDistance) up to a distance, and (link, obstacle, why) of those that have none.

    link_of: as links_of returns it. Two links of interest are each other's obstacle.
    """
    found, unknown = [], []
    for pair in pairs:
        for own, other, is_a in ((pair.body_a, pair.body_b, True), (pair.body_b, pair.body_a, False)):
            link = link_of.get(own)
            if link is None or link_of.get(other) == link:
                continue
            if not (pair.has_distance and pair.has_points):
                unknown.append((link, other, pair.status.message or "status %d" % pair.status.code))
                continue
            distance = pair.distance
            if pair.status.code not in _EXACT and pair.has_lower_bound:
                distance = pair.lower_bound  # Proven; the distance itself may be less than what was found.
            _append(found, link, other, distance, pair.point_a, pair.point_b, is_a, pair.header, largest_distance)
    return found, unknown


def entries_of_niches(pairs, link_of, largest_distance):
    """As entries(), of PairNiches: one entry for every place that may be touched, nearest first."""
    found, unknown = [], []
    for pair in pairs:
        nearest = pair.nearest
        one, without = entries([nearest], link_of, largest_distance)
        unknown += without
        for first in one:
            is_a = link_of.get(nearest.body_a) == first.link and nearest.body_b == first.obstacle
            found.append(first)
            for niche in pair.niches[1:]:
                _append(found, first.link, first.obstacle, niche.distance, niche.point_a, niche.point_b, is_a,
                        nearest.header, largest_distance)
    return found, unknown


def _append(found, link, obstacle, distance, point_a, point_b, is_a, header, largest_distance):
    own, other = (point_a, point_b) if is_a else (point_b, point_a)
    points = ((own.x, own.y, own.z), (other.x, other.y, other.z))
    if distance <= largest_distance and all(math.isfinite(number) for point in points for number in point):
        found.append(Entry(link, obstacle, max(distance, 0.0), points[0], points[1], header.frame_id, header.stamp))
