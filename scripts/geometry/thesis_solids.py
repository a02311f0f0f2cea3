"""The three geometries of Carretero (ch. 2-6), rebuilt from what its text says about them.

Its drawings are lost; the sizes here are chosen so that face counts, node counts and distances of the text
come out (doc/demo_scenes.md lists what survives and what is ours). Lengths in the thesis's units.
"""

import numpy as np

from .solid import Solid

# Boxes with notches: 6 + 12 faces.
CUBE_SIDE = 1.59
NOTCHED_SIDE = 1.53
NOTCH_WIDTH = 0.36
NOTCH_DEPTH = 0.30
NOTCH_SPAN = 1.01  # from the lower rim of one notch to the upper rim of the other

# Grooved cylinder (66 faces) and semi-extruded body (22 faces).
CYLINDER_RADIUS = 0.42
CYLINDER_LENGTH = 2.08
CYLINDER_SIDES = 16
GROOVE_WIDTH = 0.5
GROOVE_DEPTH = 0.22
SEMI_EXTRUDED_DEPTH = 1.5
SLOT_FLOOR = 0.8
# Cross-section (x, z), counter-clockwise seen against the y axis' direction, i.e. from -y.
SEMI_EXTRUDED_PROFILE = [
    (-0.85, 0.0), (0.95, 0.0), (0.95, 0.35), (1.3, 0.6), (0.95, 0.85), (0.95, 1.3), (0.5, 1.3), (0.5, SLOT_FLOOR),
    (-0.5, SLOT_FLOOR), (-0.5, 1.3), (-0.95, 1.3), (-0.95, 0.85), (-0.7, 0.6), (-0.95, 0.35), (-0.95, 0.1)]
POCKET = ((-0.5, 0.15), (0.65, 0.55))
POCKET_DEPTH = 0.5

# Battery: a box with two hexagonal through holes and a lateral guide on either end; 2 * 6 + 2 convex pieces.
BATTERY_SIZE = (0.70, 0.50, 0.30)
HOLE_RADIUS = 0.085
HOLE_CENTRES = ((-0.20, -0.05), (0.20, -0.07))
GUIDE_HALF_WIDTH = 0.06
GUIDE_REACH = 0.05
GUIDE_BOTTOM = 0.04
GUIDE_TOP = 0.26

# Fixture: a plate and eight convex protrusions.
PLATE_LOWER = (-0.48, -0.51, -0.06)
PLATE_UPPER = (0.48, 0.21, 0.0)


def regular_polygon(centre, radius, sides, z):
    """Counter-clockwise seen from +z, one corner towards +y (where the pins come in)."""
    angles = np.pi / 2.0 + np.arange(sides) * 2.0 * np.pi / sides
    return np.column_stack((centre[0] + radius * np.cos(angles), centre[1] + radius * np.sin(angles),
                            np.full(sides, z)))


def guide(sign):
    """The rims of the battery's guide at +x or -x: at the box's wall, and where it reaches to."""
    x, out = sign * BATTERY_SIZE[0] / 2.0, sign * (BATTERY_SIZE[0] / 2.0 + GUIDE_REACH)
    w = GUIDE_HALF_WIDTH
    # Both ends slope at 45 degrees: the guide enters easily, and a tilted battery has its lowest point at a corner of
    # the box, not at the guide's end.
    root = np.array([(x, -w, GUIDE_BOTTOM), (x, w, GUIDE_BOTTOM), (x, w, GUIDE_TOP), (x, -w, GUIDE_TOP)])
    crest = np.array([(out, -w, GUIDE_BOTTOM + GUIDE_REACH), (out, w, GUIDE_BOTTOM + GUIDE_REACH),
                      (out, w, GUIDE_TOP - GUIDE_REACH), (out, -w, GUIDE_TOP - GUIDE_REACH)])
    return root, crest


def rectangle(lower, upper, z):
    return np.array([(lower[0], lower[1], z), (upper[0], lower[1], z), (upper[0], upper[1], z),
                     (lower[0], upper[1], z)])


def extrude(name, outline, lower, upper):
    """A prism along z over a counter-clockwise outline."""
    solid = Solid(name)
    bottom = np.array([(x, y, lower) for x, y in outline])
    top = np.array([(x, y, upper) for x, y in outline])
    solid.add_face(bottom, outward=(0, 0, -1))
    solid.add_face(top, outward=(0, 0, 1))
    solid.add_band(bottom, top)
    return solid


def cube():
    """Frame: centre of the cube."""
    h = CUBE_SIDE / 2.0
    return extrude("box", [(-h, -h), (h, -h), (h, h), (-h, h)], -h, h)


def notch_rims():
    """y of the four rims of the two notches, upwards."""
    half = NOTCH_SPAN / 2.0
    return -half, -half + NOTCH_WIDTH, half - NOTCH_WIDTH, half


def notched_box():
    """Frame: middle of the notched side (the plane x = 0); the material lies at x > 0."""
    h = NOTCHED_SIDE / 2.0
    y1, y2, y3, y4 = notch_rims()
    outline = [(0.0, h), (0.0, y4), (NOTCH_DEPTH, (y3 + y4) / 2.0), (0.0, y3), (0.0, y2),
               (NOTCH_DEPTH, (y1 + y2) / 2.0), (0.0, y1), (0.0, -h), (NOTCHED_SIDE, -h), (NOTCHED_SIDE, h)]
    return extrude("notched_box", outline, -CUBE_SIDE / 2.0, CUBE_SIDE / 2.0)


def grooved_cylinder():
    """Frame: centre; axis z; corners of the cross-section on the x and y axes."""
    solid = Solid("grooved_cylinder")
    angles = np.arange(CYLINDER_SIDES) * 2.0 * np.pi / CYLINDER_SIDES

    def ring(radius, z):
        return np.column_stack((radius * np.cos(angles), radius * np.sin(angles), np.full(len(angles), z)))

    h, g = CYLINDER_LENGTH / 2.0, GROOVE_WIDTH / 2.0
    rings = [ring(CYLINDER_RADIUS, -h), ring(CYLINDER_RADIUS, -g), ring(CYLINDER_RADIUS - GROOVE_DEPTH, 0.0),
             ring(CYLINDER_RADIUS, g), ring(CYLINDER_RADIUS, h)]
    solid.add_face(rings[0], outward=(0, 0, -1))
    solid.add_face(rings[-1], outward=(0, 0, 1))
    for lower, upper in zip(rings, rings[1:]):
        solid.add_band(lower, upper)
    return solid


def semi_extruded():
    """Frame: middle of the base; extruded along y, with a blind pocket in the side at -y."""
    solid = Solid("semi_extruded")
    half = SEMI_EXTRUDED_DEPTH / 2.0
    front = np.array([(x, -half, z) for x, z in SEMI_EXTRUDED_PROFILE])
    back = np.array([(x, half, z) for x, z in SEMI_EXTRUDED_PROFILE])
    (x0, z0), (x1, z1) = POCKET
    corners = [(x0, z0), (x1, z0), (x1, z1), (x0, z1)]
    opening = np.array([(x, -half, z) for x, z in corners])
    floor = np.array([(x, -half + POCKET_DEPTH, z) for x, z in corners])
    solid.add_face(front, holes=[opening], outward=(0, -1, 0))
    solid.add_face(back, outward=(0, 1, 0))
    solid.add_band(back, front)
    solid.add_face(floor, outward=(0, -1, 0))
    solid.add_band(opening, floor)
    return solid


def battery(hole_sides=6):
    """Frame: centre of the bottom face, z upwards; inserted by a motion along -z."""
    solid = Solid("battery")
    sx, sy, sz = BATTERY_SIZE
    lower, upper = (-sx / 2.0, -sy / 2.0), (sx / 2.0, sy / 2.0)
    bottom, top = rectangle(lower, upper, 0.0), rectangle(lower, upper, sz)
    low_rims = [regular_polygon(c, HOLE_RADIUS, hole_sides, 0.0) for c in HOLE_CENTRES]
    high_rims = [regular_polygon(c, HOLE_RADIUS, hole_sides, sz) for c in HOLE_CENTRES]
    solid.add_face(bottom, holes=low_rims, outward=(0, 0, -1))
    solid.add_face(top, holes=high_rims, outward=(0, 0, 1))
    for low, high in zip(low_rims, high_rims):
        solid.add_band(high, low)
    for k in (0, 2):
        solid.add_face([bottom[k], bottom[k + 1], top[k + 1], top[(k + 1)]][:3] + [top[k]],
                       outward=(0, -1 if k == 0 else 1, 0))
    for sign in (1.0, -1.0):
        x = sign * sx / 2.0
        root, crest = guide(sign)
        side = np.array([(x, lower[1], 0.0), (x, upper[1], 0.0), (x, upper[1], sz), (x, lower[1], sz)])
        outward = (sign, 0, 0)
        solid.add_face(side, holes=[root], outward=outward)
        solid.add_face(crest, outward=outward)
        for k in range(4):
            n = (k + 1) % 4
            face = np.array([root[k], root[n], crest[n], crest[k]])
            solid.add_face(face if sign > 0 else face[::-1])
    return solid


def fixture(protrusions):
    """Frame: top of the plate, z upwards. `protrusions`: dictionaries with `base` (corners on the plate,
    counter-clockwise seen from +z), `shoulder` (height of the prism), `tip` (x, y, z of its point)."""
    solid = Solid("fixture")
    lower, upper = PLATE_LOWER, PLATE_UPPER
    bottom = rectangle(lower, upper, lower[2])
    top = rectangle(lower, upper, upper[2])
    bases = [np.array([(x, y, 0.0) for x, y in p["base"]]) for p in protrusions]
    solid.add_face(bottom, outward=(0, 0, -1))
    solid.add_face(top, holes=bases, outward=(0, 0, 1))
    solid.add_band(bottom, top)
    for protrusion, base in zip(protrusions, bases):
        shoulder = base.copy()
        shoulder[:, 2] = protrusion["shoulder"]
        solid.add_band(base, shoulder)
        solid.add_cone(shoulder, np.array(protrusion["tip"]))
    return solid
