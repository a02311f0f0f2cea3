"""Brute-force distances between small triangle meshes, vectorised over all pairs (double precision)."""

import numpy as np


def closest_on_triangles(points, corners):
    """For every point and every triangle the closest point: arrays (P, T, 3) and squared distances (P, T)."""
    p = points[:, None, :]
    a, b, c = corners[None, :, 0], corners[None, :, 1], corners[None, :, 2]

    def on_segment(s, e):
        d = e - s
        length = np.sum(d * d, axis=-1)
        t = np.clip(np.sum((p - s) * d, axis=-1) / np.where(length > 0.0, length, 1.0), 0.0, 1.0)
        return s + t[..., None] * d

    n = np.cross(b - a, c - a)
    nn = np.sum(n * n, axis=-1)
    height = np.sum((p - a) * n, axis=-1) / nn
    foot = p - height[..., None] * n
    inside = np.ones(foot.shape[:2], dtype=bool)
    for s, e in ((a, b), (b, c), (c, a)):
        inside &= np.sum(np.cross(e - s, foot - s) * n, axis=-1) >= 0.0
    candidates = [np.where(inside[..., None], foot, a)] + [on_segment(s, e) for s, e in ((a, b), (b, c), (c, a))]
    squares = [np.sum((q - p) ** 2, axis=-1) for q in candidates]
    best = np.argmin(np.stack(squares), axis=0)
    closest = np.take_along_axis(np.stack(candidates), best[None, ..., None], axis=0)[0]
    return closest, np.take_along_axis(np.stack(squares), best[None], axis=0)[0]


def segment_distances(p0, p1, q0, q1):
    """Closest points of segments p (P, 3) and q (Q, 3), all pairs: points on p, on q, squared distance."""
    p0, p1 = p0[:, None], p1[:, None]
    q0, q1 = q0[None], q1[None]
    d1, d2, r = p1 - p0, q1 - q0, p0 - q0
    a = np.sum(d1 * d1, -1)
    e = np.sum(d2 * d2, -1)
    f = np.sum(d2 * r, -1)
    c = np.sum(d1 * r, -1)
    b = np.sum(d1 * d2, -1)
    denominator = a * e - b * b
    s = np.where(denominator > 1e-14 * a * e,
                 np.clip((b * f - c * e) / np.where(denominator == 0, 1, denominator), 0, 1), 0.0)
    t = np.clip((b * s + f) / e, 0, 1)
    s = np.clip((b * t - c) / a, 0, 1)
    t = np.clip((b * s + f) / e, 0, 1)
    x = p0 + s[..., None] * d1
    y = q0 + t[..., None] * d2
    return x, y, np.sum((x - y) ** 2, -1)


def triangles_intersect_segments(starts, ends, corners):
    """(S, T) booleans: the segment passes through the triangle's plane inside the triangle."""
    a, b, c = corners[None, :, 0], corners[None, :, 1], corners[None, :, 2]
    n = np.cross(b - a, c - a)
    s, e = starts[:, None], ends[:, None]
    hs, he = np.sum((s - a) * n, -1), np.sum((e - a) * n, -1)
    crossing = hs * he < 0
    t = hs / np.where(hs - he == 0, 1.0, hs - he)
    x = s + t[..., None] * (e - s)
    for u, v in ((a, b), (b, c), (c, a)):
        crossing &= np.sum(np.cross(v - u, x - u) * n, -1) >= 0
    return crossing


def mesh_distance(corners_a, corners_b):
    """Distance of two triangle sets and the closest points; 0 when an edge of one pierces the other."""
    best = (np.inf, None, None)
    points_a, points_b = corners_a.reshape(-1, 3), corners_b.reshape(-1, 3)
    closest, square = closest_on_triangles(points_a, corners_b)
    i, j = np.unravel_index(np.argmin(square), square.shape)
    best = min(best, (square[i, j], points_a[i], closest[i, j]), key=lambda x: x[0])
    closest, square = closest_on_triangles(points_b, corners_a)
    i, j = np.unravel_index(np.argmin(square), square.shape)
    best = min(best, (square[i, j], closest[i, j], points_b[i]), key=lambda x: x[0])
    edges_a = np.concatenate([corners_a[:, [k, (k + 1) % 3]] for k in range(3)])
    edges_b = np.concatenate([corners_b[:, [k, (k + 1) % 3]] for k in range(3)])
    x, y, square = segment_distances(edges_a[:, 0], edges_a[:, 1], edges_b[:, 0], edges_b[:, 1])
    i, j = np.unravel_index(np.argmin(square), square.shape)
    best = min(best, (square[i, j], x[i, j], y[i, j]), key=lambda x: x[0])
    if np.any(triangles_intersect_segments(edges_a[:, 0], edges_a[:, 1], corners_b)) or np.any(
            triangles_intersect_segments(edges_b[:, 0], edges_b[:, 1], corners_a)):
        return 0.0, best[1], best[2]
    return float(np.sqrt(best[0])), best[1], best[2]
