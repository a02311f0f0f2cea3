"""Rigid transforms as plain tuples, for the bridges: ((x, y, z), (qx, qy, qz, qw)), metres and a unit quaternion."""

import math

IDENTITY = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))


def is_finite(pose):
    return all(math.isfinite(number) for part in pose for number in part)


def normalized(pose):
    """The pose with a unit quaternion; one of zeros means no rotation, as in MoveIt. NaN stays NaN."""
    position, rotation = pose
    length = math.hypot(*rotation)
    if length == 0.0:
        return (position, IDENTITY[1])
    if math.isinf(length):
        rotation = tuple(0.25 * number for number in rotation)
        length = math.hypot(*rotation)
    return (position, tuple(number / length for number in rotation))


def rotated(rotation, vector):
    x, y, z, w = rotation
    a, b, c = vector
    # Twice the cross product of the quaternion's vector part with the vector.
    t = (2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a))
    return (a + w * t[0] + y * t[2] - z * t[1], b + w * t[1] + z * t[0] - x * t[2],
            c + w * t[2] + x * t[1] - y * t[0])


def transformed(pose, point):
    moved = rotated(pose[1], point)
    return tuple(moved[i] + pose[0][i] for i in range(3))


def composed(a_from_b, b_from_c):
    x1, y1, z1, w1 = a_from_b[1]
    x2, y2, z2, w2 = b_from_c[1]
    rotation = (w1 * x2 + x1 * w2 + y1 * z2 - z1 * y2, w1 * y2 - x1 * z2 + y1 * w2 + z1 * x2,
                w1 * z2 + x1 * y2 - y1 * x2 + z1 * w2, w1 * w2 - x1 * x2 - y1 * y2 - z1 * z2)
    return normalized((transformed(a_from_b, b_from_c[0]), rotation))


def inverse(pose):
    rotation = (-pose[1][0], -pose[1][1], -pose[1][2], pose[1][3])
    return (tuple(-number for number in rotated(rotation, pose[0])), rotation)


def are_near(one, other, tolerance=1e-9):
    """Whether positions and rotations differ by no more than a tolerance (m, and of the quaternion's numbers)."""
    sign = 1.0 if sum(a * b for a, b in zip(one[1], other[1])) >= 0.0 else -1.0
    return (all(abs(a - b) <= tolerance * max(1.0, abs(a)) for a, b in zip(one[0], other[0])) and
            all(abs(a - sign * b) <= tolerance for a, b in zip(one[1], other[1])))
