"""Rigid transforms as 4 x 4 matrices, quaternions (x, y, z, w) and the poses.csv format."""

import numpy as np


def rotation(axis, angle):
    """3 x 3 rotation about a coordinate axis ("x", "y", "z"), radians."""
    c, s = np.cos(angle), np.sin(angle)
    i = "xyz".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    matrix = np.eye(3)
    matrix[j, j], matrix[j, k], matrix[k, j], matrix[k, k] = c, -s, s, c
    return matrix


def inverse(pose):
    result = np.eye(4)
    result[:3, :3] = pose[:3, :3].T
    result[:3, 3] = -pose[:3, :3].T @ pose[:3, 3]
    return result


def apply(pose, points):
    return points @ pose[:3, :3].T + pose[:3, 3]


def quaternion(matrix):
    """Unit quaternion (x, y, z, w), w >= 0, of a rotation matrix."""
    # The eigenvector of Bar-Itzhack's symmetric matrix: well conditioned for every rotation.
    m = matrix[:3, :3]
    k = np.array([
        [m[0, 0] - m[1, 1] - m[2, 2], m[1, 0] + m[0, 1], m[2, 0] + m[0, 2], m[2, 1] - m[1, 2]],
        [m[1, 0] + m[0, 1], m[1, 1] - m[0, 0] - m[2, 2], m[2, 1] + m[1, 2], m[0, 2] - m[2, 0]],
        [m[2, 0] + m[0, 2], m[2, 1] + m[1, 2], m[2, 2] - m[0, 0] - m[1, 1], m[1, 0] - m[0, 1]],
        [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], m[0, 0] + m[1, 1] + m[2, 2]]]) / 3.0
    values, vectors = np.linalg.eigh(k)
    q = vectors[:, np.argmax(values)]
    return q if q[3] >= 0.0 else -q


def matrix_of_quaternion(q):
    x, y, z, w = np.asarray(q, dtype=float) / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def write_poses(path, rows):
    """rows: (time, pose) with the pose of B in A's frame; 17 digits."""
    with open(path, "w", encoding="ascii") as stream:
        stream.write("t,x,y,z,qx,qy,qz,qw\n")
        for time, pose in rows:
            values = [time, *pose[:3, 3], *quaternion(pose)]
            stream.write(",".join(f"{v + 0.0:.17g}" for v in values) + "\n")


def read_poses(path):
    """(time, pose) of every line."""
    rows = []
    with open(path, encoding="ascii") as stream:
        next(stream)
        for line in stream:
            v = [float(c) for c in line.split(",")]
            pose = np.eye(4)
            pose[:3, :3] = matrix_of_quaternion(v[4:8])
            pose[:3, 3] = v[1:4]
            rows.append((v[0], pose))
    return rows
