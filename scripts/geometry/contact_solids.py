"""What the contact scenes of doc/simulation.md move. Lengths in metres."""

import numpy as np

from .solid import Solid
from .thesis_solids import regular_polygon

# The body of fig. 4.1: a bar on two round feet.
BAR_HALF_LENGTH = 0.20
BAR_BOTTOM, BAR_TOP = 0.05, 0.12
FOOT_RADIUS = 0.03
FOOT_CENTRE = 0.16
FOOT_SEGMENTS = 12
BAR_WIDTH = 0.12

PLATE_SIZE = (0.30, 0.30)
PLATE_THICKNESS = 0.10
HOLE_SIDES = 24
HOLE_RADIUS = 0.0205  # of the corners; the flats are at 0.02033

# The plate of a press fit.
RING_RADIUS, RING_HOLE, RING_THICKNESS, RING_SIDES = 0.030, 0.010, 0.020, 96


def _foot(x):
    """Half-round from the bar's underside down and up again, from left to right."""
    angles = np.linspace(np.pi, 2.0 * np.pi, FOOT_SEGMENTS + 1)
    arc = [(x + FOOT_RADIUS * np.cos(a), FOOT_RADIUS + FOOT_RADIUS * np.sin(a)) for a in angles]
    return [(x - FOOT_RADIUS, BAR_BOTTOM)] + arc + [(x + FOOT_RADIUS, BAR_BOTTOM)]


def two_feet():
    """Frame: on the ground between the feet, x from foot to foot, z upwards; the same for every y."""
    solid = Solid("two_feet")
    outline = np.array([(-BAR_HALF_LENGTH, BAR_BOTTOM)] + _foot(-FOOT_CENTRE) + _foot(FOOT_CENTRE) +
                       [(BAR_HALF_LENGTH, BAR_BOTTOM), (BAR_HALF_LENGTH, BAR_TOP), (-BAR_HALF_LENGTH, BAR_TOP)])
    front, back = [np.column_stack((outline[:, 0], np.full(len(outline), y), outline[:, 1]))
                   for y in (-BAR_WIDTH / 2.0, BAR_WIDTH / 2.0)]
    solid.add_face(front, outward=(0, -1, 0))
    solid.add_face(back, outward=(0, 1, 0))
    solid.add_band(back, front)
    return solid


def holed_plate():
    """Frame: middle of the hole, on the upper face, z upwards."""
    solid = Solid("holed_plate")
    x, y = PLATE_SIZE[0] / 2.0, PLATE_SIZE[1] / 2.0
    top, bottom = [np.array([(-x, -y, z), (x, -y, z), (x, y, z), (-x, y, z)]) for z in (0.0, -PLATE_THICKNESS)]
    rim_top, rim_bottom = [regular_polygon((0.0, 0.0), HOLE_RADIUS, HOLE_SIDES, z) for z in (0.0, -PLATE_THICKNESS)]
    solid.add_face(top, holes=[rim_top], outward=(0, 0, 1))
    solid.add_face(bottom, holes=[rim_bottom], outward=(0, 0, -1))
    solid.add_band(bottom, top)
    solid.add_band(rim_top, rim_bottom)
    return solid


def press_fit_ring():
    """Frame: middle of the ring, z along the hole."""
    solid = Solid("press_fit_ring")
    (top, top_hole), (bottom, bottom_hole) = [
        [regular_polygon((0.0, 0.0), radius, RING_SIDES, z) for radius in (RING_RADIUS, RING_HOLE)]
        for z in (RING_THICKNESS / 2.0, -RING_THICKNESS / 2.0)]
    solid.add_face(top, holes=[top_hole], outward=(0, 0, 1))
    solid.add_face(bottom, holes=[bottom_hole], outward=(0, 0, -1))
    solid.add_band(bottom, top)
    solid.add_band(top_hole, bottom_hole)
    return solid
