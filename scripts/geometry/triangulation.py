"""Constrained Delaunay triangulation of a planar polygon with holes (ear clipping, then edge flips)."""

import numpy as np


def _cross(o, a, b):
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def _signed_area(loop):
    x, y = loop[:, 0], loop[:, 1]
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def _segments_cross(a, b, c, d):
    """True when the open segments a-b and c-d have a point in common."""
    return (_cross(a, b, c) * _cross(a, b, d) < 0.0) and (_cross(c, d, a) * _cross(c, d, b) < 0.0)


def _bridge_holes(points, outer, holes):
    """One loop of indices that runs along the outer loop and, over bridges, around each hole."""
    loop = list(outer)
    # Right-most hole first: a bridge then never has to pass a hole that is not joined yet.
    pending = sorted(holes, key=lambda hole: -max(points[i][0] for i in hole))
    while pending:
        hole = pending.pop(0)
        start = max(range(len(hole)), key=lambda k: points[hole[k]][0])
        tip = points[hole[start]]
        walls = [(loop[k], loop[(k + 1) % len(loop)]) for k in range(len(loop))]
        for other in [hole] + pending:
            walls += [(other[k], other[(k + 1) % len(other)]) for k in range(len(other))]
        candidates = sorted(range(len(loop)), key=lambda k: np.sum((points[loop[k]] - tip) ** 2))
        for k in candidates:
            target = points[loop[k]]
            before, after = points[loop[k - 1]], points[loop[(k + 1) % len(loop)]]
            # The bridge must leave the corner into the polygon's inside.
            if _cross(before, target, after) > 0.0:
                inside = _cross(before, target, tip) > 0.0 and _cross(target, after, tip) > 0.0
            else:
                inside = _cross(before, target, tip) > 0.0 or _cross(target, after, tip) > 0.0
            if inside and not any(_segments_cross(tip, target, points[i], points[j]) for i, j in walls):
                ring = hole[start:] + hole[:start] + [hole[start]]
                loop = loop[: k + 1] + ring + loop[k:]
                break
        else:
            raise ValueError("a hole of the polygon cannot be joined to its outline")
    return loop


def _clip_ears(points, loop):
    loop = list(loop)
    triangles = []
    while len(loop) > 3:
        best = None
        for k in range(len(loop)):
            i, j, l = loop[k - 1], loop[k], loop[(k + 1) % len(loop)]
            a, b, c = points[i], points[j], points[l]
            area = _cross(a, b, c)
            if area <= 1e-14:
                continue
            blocked = False
            for m in loop:
                if m in (i, j, l):
                    continue
                p = points[m]
                if _cross(a, b, p) >= 0.0 and _cross(b, c, p) >= 0.0 and _cross(c, a, p) >= 0.0:
                    blocked = True
                    break
            if blocked:
                continue
            longest = max(np.sum((a - b) ** 2), np.sum((b - c) ** 2), np.sum((c - a) ** 2))
            quality = area / longest
            if best is None or quality > best[0]:
                best = (quality, k)
        if best is None:
            raise ValueError("the polygon crosses itself")
        k = best[1]
        triangles.append((loop[k - 1], loop[k], loop[(k + 1) % len(loop)]))
        del loop[k]
    triangles.append(tuple(loop))
    return triangles


def _in_circle(a, b, c, p):
    """Positive when p lies inside the circle through the counter-clockwise a, b, c."""
    rows = np.array([[q[0] - p[0], q[1] - p[1], np.sum((q - p) ** 2)] for q in (a, b, c)])
    return float(np.linalg.det(rows))


def _flip_to_delaunay(points, triangles, constrained):
    """Lawson's flips over the edges that are not constrained."""
    triangles = [list(t) for t in triangles]
    scale = float(np.ptp(points, axis=0).max()) ** 4
    for _ in range(100):
        changed = False
        owner = {}
        for number, triangle in enumerate(triangles):
            for k in range(3):
                owner[(triangle[k], triangle[(k + 1) % 3])] = number
        for (i, j), first in list(owner.items()):
            if i > j or frozenset((i, j)) in constrained:
                continue
            if owner.get((i, j)) != first or (j, i) not in owner:
                continue
            second = owner[(j, i)]
            k = next(v for v in triangles[first] if v not in (i, j))
            l = next(v for v in triangles[second] if v not in (i, j))
            if _in_circle(points[i], points[j], points[k], points[l]) <= 1e-12 * scale:
                continue
            if _cross(points[k], points[l], points[j]) <= 0.0 or _cross(points[l], points[k], points[i]) <= 0.0:
                continue
            for a, b in ((i, j), (j, k), (k, i), (j, i), (i, l), (l, j)):
                owner.pop((a, b), None)
            triangles[first] = [k, l, j]
            triangles[second] = [l, k, i]
            for number in (first, second):
                t = triangles[number]
                for m in range(3):
                    owner[(t[m], t[(m + 1) % 3])] = number
            changed = True
        if not changed:
            return [tuple(t) for t in triangles]
    raise ValueError("edge flips did not end")


def triangulate_polygon(outer, holes=()):
    """Triangles (index triples, counter-clockwise) of the polygon; indices run over outer, then each hole.

    Loops are sequences of 2-D points without repeated end; either winding is accepted.
    """
    loops = [np.asarray(outer, dtype=float)] + [np.asarray(hole, dtype=float) for hole in holes]
    points = np.vstack(loops)
    indices = []
    start = 0
    for number, loop in enumerate(loops):
        ring = list(range(start, start + len(loop)))
        start += len(loop)
        counter_clockwise = _signed_area(loop) > 0.0
        if counter_clockwise != (number == 0):
            ring.reverse()
        indices.append(ring)
    constrained = {frozenset((ring[k - 1], ring[k])) for ring in indices for k in range(len(ring))}
    triangles = _clip_ears(points, _bridge_holes(points, indices[0], indices[1:]))
    return _flip_to_delaunay(points, triangles, constrained)
