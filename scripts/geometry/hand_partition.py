"""The battery and the fixture cut into convex pieces by hand: 14 and 9 (Carretero, sec. 6.3.1 and fig. 6.4).

The battery: its box is halved between the two holes; each half, less its n-sided hole, is n prisms: the wall of
the half behind side k of the hole, as far as the line of the side before it; and the two guides. 2 n + 2 pieces, as
the thesis counts them. The fixture: its plate and its protrusions, each convex as it stands.
"""

import numpy as np

from . import thesis_solids


def _float(points):
    """The coordinates as the STL files have them (geometry/solid.py)."""
    return np.array([[float(np.float32(round(float(c), 9))) + 0.0 for c in p] for p in points])


class Piece:
    """Corners and facets, counter-clockwise seen from outside."""

    def __init__(self, corners, facets):
        self.corners = np.asarray(corners, dtype=float)
        self.facets = facets


def prism(outline, lower, upper):
    """Along z over a counter-clockwise outline."""
    n = len(outline)
    corners = [(x, y, lower) for x, y in outline] + [(x, y, upper) for x, y in outline]
    facets = [list(range(n))[::-1], list(range(n, 2 * n))]
    facets += [[k, (k + 1) % n, n + (k + 1) % n, n + k] for k in range(n)]
    return Piece(corners, facets)


def pointed_prism(base, lower, shoulder, tip):
    """A prism with a point on it."""
    n = len(base)
    corners = [(x, y, lower) for x, y in base] + [(x, y, shoulder) for x, y in base] + [tuple(tip)]
    facets = [list(range(n))[::-1]]
    facets += [[k, (k + 1) % n, n + (k + 1) % n, n + k] for k in range(n)]
    facets += [[n + k, n + (k + 1) % n, 2 * n] for k in range(n)]
    return Piece(corners, facets)


def clip(outline, start, end):
    """The part of a convex outline on the left of the line from start to end."""
    def side(p):
        return (end[0] - start[0]) * (p[1] - start[1]) - (end[1] - start[1]) * (p[0] - start[0])

    result = []
    for k, p in enumerate(outline):
        q = outline[(k + 1) % len(outline)]
        sp, sq = side(p), side(q)
        if sp >= 0.0:
            result.append(tuple(p))
        if sp * sq < 0.0:
            t = sp / (sp - sq)
            result.append((p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])))
    return [p for k, p in enumerate(result) if np.hypot(*np.subtract(p, result[k - 1])) > 1e-12]


def ring_outlines(rectangle, hole):
    """A rectangle less a convex hole, both counter-clockwise: one convex outline behind each side of the hole."""
    outlines = []
    n = len(hole)
    for k in range(n):
        start, end, before = hole[k], hole[(k + 1) % n], hole[k - 1]
        outlines.append(clip(clip(rectangle, end, start), before, start))
    return outlines


def battery(hole_sides=6):
    """The pieces of thesis_solids.battery(hole_sides)."""
    sx, sy, sz = thesis_solids.BATTERY_SIZE
    x, y, z = _float([(sx / 2.0, sy / 2.0, sz)])[0]
    pieces = []
    for centre, (left, right) in zip(thesis_solids.HOLE_CENTRES, ((-x, 0.0), (0.0, x))):
        half = [(left, -y), (right, -y), (right, y), (left, y)]
        hole = _float(thesis_solids.regular_polygon(centre, thesis_solids.HOLE_RADIUS, hole_sides, 0.0))[:, :2]
        pieces += [prism(outline, 0.0, z) for outline in ring_outlines(half, [tuple(p) for p in hole])]
    for sign in (1.0, -1.0):
        root, crest = (_float(points) for points in thesis_solids.guide(sign))
        facets = [[3, 2, 1, 0], [4, 5, 6, 7]] + [[k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k] for k in range(4)]
        if sign < 0.0:
            facets = [facet[::-1] for facet in facets]
        pieces.append(Piece(np.vstack((root, crest)), facets))
    return pieces


def fixture(protrusions):
    """The pieces of thesis_solids.fixture(protrusions)."""
    lower, upper = _float([thesis_solids.PLATE_LOWER, thesis_solids.PLATE_UPPER])
    pieces = [prism([(lower[0], lower[1]), (upper[0], lower[1]), (upper[0], upper[1]), (lower[0], upper[1])],
                    lower[2], upper[2])]
    for protrusion in protrusions:
        base = _float([(px, py, protrusion["shoulder"]) for px, py in protrusion["base"]])
        pieces.append(pointed_prism(base[:, :2], 0.0, base[0, 2], _float([protrusion["tip"]])[0]))
    return pieces


def write_pieces(path, name, pieces):
    """As concave_distance::readPieces reads them."""
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(f"# convex pieces of {name}, by hand; metres\n")
        first = 1
        for k, piece in enumerate(pieces, 1):
            stream.write(f"o piece_{k}\n")
            for corner in piece.corners:
                stream.write("v " + " ".join(f"{float(c) + 0.0!r}" for c in corner) + "\n")
            for facet in piece.facets:
                stream.write("f " + " ".join(str(first + corner) for corner in facet) + "\n")
            first += len(piece.corners)
