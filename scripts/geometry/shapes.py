"""Curved closed meshes: swept tubes, bodies of revolution, extruded outlines with rounded corners."""

import numpy as np


def check_closed(name, vertices, triangles):
    """Raises unless every edge is shared by two triangles in opposite directions and the volume is positive."""
    seen = set()
    for a, b, c in triangles:
        for edge in ((a, b), (b, c), (c, a)):
            if edge in seen:
                raise ValueError(f"{name}: edge {edge} twice in one direction")
            seen.add(edge)
    if any((b, a) not in seen for a, b in seen):
        raise ValueError(f"{name}: has a border")
    corners = np.asarray(vertices)[np.asarray(triangles)]
    volume = np.sum(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))) / 6.0
    if volume <= 0.0:
        raise ValueError(f"{name}: inside out")
    return np.asarray(vertices), np.asarray(triangles)


def round_corners(outline, radii, segments):
    """Replaces each corner of a polygon by an arc. radii: one number or one per corner; 0 leaves a corner."""
    outline = np.asarray(outline, dtype=float)
    radii = np.broadcast_to(radii, len(outline))
    points = []
    for k, corner in enumerate(outline):
        to_last = outline[k - 1] - corner
        to_next = outline[(k + 1) % len(outline)] - corner
        to_last, to_next = to_last / np.linalg.norm(to_last), to_next / np.linalg.norm(to_next)
        if radii[k] == 0.0:
            points.append(corner)
            continue
        half = 0.5 * np.arccos(np.clip(to_last @ to_next, -1.0, 1.0))
        bisector = (to_last + to_next) / np.linalg.norm(to_last + to_next)
        centre = corner + bisector * radii[k] / np.sin(half)
        start = corner + to_last * radii[k] / np.tan(half) - centre
        end = corner + to_next * radii[k] / np.tan(half) - centre
        angle = np.arctan2(start[0] * end[1] - start[1] * end[0], start @ end)
        for s in np.linspace(0.0, 1.0, segments + 1):
            c, n = np.cos(s * angle), np.sin(s * angle)
            points.append(centre + np.array([c * start[0] - n * start[1], n * start[0] + c * start[1]]))
    return np.array(points)


def subdivide(outline, longest):
    """Splits the sides of a closed polygon so that none is longer than `longest`."""
    points = []
    for k, start in enumerate(outline):
        end = outline[(k + 1) % len(outline)]
        parts = max(1, int(np.ceil(np.linalg.norm(end - start) / longest - 1e-9)))
        points += [start + (end - start) * s / parts for s in range(parts)]
    return np.array(points)


def loft(name, rings, closed):
    """Quads between successive rings of equally many points, split in two triangles. A ring runs
    counter-clockwise seen from the last one. `closed`: the last ring joins the first; else both ends are
    closed by fans to the ring's middle."""
    n = len(rings[0])
    vertices = np.concatenate(rings)
    triangles = []
    count = len(rings)
    for r in range(count if closed else count - 1):
        lower, upper = r * n, ((r + 1) % count) * n
        for k in range(n):
            m = (k + 1) % n
            triangles += [(lower + k, lower + m, upper + m), (lower + k, upper + m, upper + k)]
    if not closed:
        first, last = len(vertices), len(vertices) + 1
        vertices = np.vstack([vertices, np.mean(rings[0], axis=0), np.mean(rings[-1], axis=0)])
        top = (count - 1) * n
        for k in range(n):
            m = (k + 1) % n
            triangles += [(m, k, first), (top + k, top + m, last)]
    return check_closed(name, vertices, triangles)


def revolve(name, profile, sides):
    """A body of revolution about z. profile: closed loop of (radius > 0, z), counter-clockwise in the
    (radius, z) plane."""
    rings = []
    for angle in np.arange(sides) * 2.0 * np.pi / sides:
        rings.append(np.array([(r * np.cos(angle), r * np.sin(angle), z) for r, z in profile])[::-1])
    return loft(name, rings, True)


def sweep(name, path, radii, sides):
    """A tube of circular section along a path, closed at both ends by fans; rotation-minimising frame."""
    path = np.asarray(path, dtype=float)
    radii = np.broadcast_to(radii, len(path))
    tangents = np.gradient(path, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    u = np.cross(tangents[0], np.eye(3)[int(np.argmin(np.abs(tangents[0])))])
    u /= np.linalg.norm(u)
    rings = []
    angles = np.arange(sides) * 2.0 * np.pi / sides
    for centre, tangent, radius in zip(path, tangents, radii):
        u = u - tangent * (u @ tangent)
        u /= np.linalg.norm(u)
        v = np.cross(tangent, u)
        rings.append(centre + radius * (np.outer(np.cos(angles), u) + np.outer(np.sin(angles), v)))
    return loft(name, rings, False)


def cut_outline(outline, triangulate, lengths):
    """Helper of `extrude`: vertices and triangles of the two caps and the sides of a prism along y."""
    n = len(outline)
    vertices = np.concatenate([np.column_stack((outline[:, 0], np.full(n, y), outline[:, 1])) for y in lengths])
    triangles = []
    caps = triangulate(outline)
    last = (len(lengths) - 1) * n
    for a, b, c in caps:
        triangles += [(a, b, c), (last + a, last + c, last + b)]
    for r in range(len(lengths) - 1):
        lower, upper = r * n, (r + 1) * n
        for k in range(n):
            m = (k + 1) % n
            triangles += [(lower + m, lower + k, upper + k), (lower + m, upper + k, upper + m)]
    return vertices, triangles


def extrude_along_y(name, outline, lengths, triangulate):
    """A prism over a counter-clockwise outline in (x, z), seen from -y; `lengths`: rising values of y."""
    vertices, triangles = cut_outline(np.asarray(outline), triangulate, lengths)
    return check_closed(name, vertices, triangles)
