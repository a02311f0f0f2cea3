"""A closed solid given by planar faces, welded, checked and written as binary STL."""

import struct
from collections import Counter

import numpy as np

from .triangulation import triangulate_polygon


class Solid:
    """Collects planar faces; `mesh()` gives vertices and outward triangles, checked for closedness."""

    def __init__(self, name):
        self.name = name
        self._vertices = []
        self._index = {}
        self._triangles = []
        self.face_count = 0

    def _vertex(self, point):
        # Coordinates are rounded to what the STL can carry, so that files and fits speak of one geometry.
        key = tuple(float(np.float32(round(float(c), 9))) + 0.0 for c in point)
        if key not in self._index:
            self._index[key] = len(self._vertices)
            self._vertices.append(key)
        return self._index[key]

    def add_face(self, outer, holes=(), outward=None):
        """A planar polygon with holes. The outer loop runs counter-clockwise seen from outside, unless
        `outward` names a direction on the outer side."""
        outer = np.asarray(outer, dtype=float)
        holes = [np.asarray(hole, dtype=float) for hole in holes]
        normal = np.sum(np.cross(outer, np.roll(outer, -1, axis=0)), axis=0)
        normal /= np.linalg.norm(normal)
        if outward is not None and np.dot(normal, outward) < 0.0:
            outer, normal = outer[::-1], -normal
        first = np.eye(3)[int(np.argmin(np.abs(normal)))]
        u = np.cross(normal, first)
        u /= np.linalg.norm(u)
        v = np.cross(normal, u)
        frame = np.column_stack((u, v))
        points = np.vstack([outer] + holes)
        offset = (points - outer[0]) @ normal
        if np.max(np.abs(offset)) > 1e-6:
            raise ValueError(f"{self.name}: a face is not planar ({np.max(np.abs(offset)):.2e})")
        for triangle in triangulate_polygon(outer @ frame, [hole @ frame for hole in holes]):
            self._triangles.append([self._vertex(points[i]) for i in triangle])
        self.face_count += 1

    def add_band(self, lower, upper):
        """Quads between two loops of equally many points; counter-clockwise seen along the way from lower to
        upper reversed, that is: for a solid whose axis runs from lower to upper, loops counter-clockwise seen
        from the upper end give outward faces."""
        n = len(lower)
        for k in range(n):
            self.add_face([lower[k], lower[(k + 1) % n], upper[(k + 1) % n], upper[k]])

    def add_cone(self, loop, apex):
        """Triangles from a loop to a point; winding as add_band with the apex at the upper end."""
        n = len(loop)
        for k in range(n):
            self.add_face([loop[k], loop[(k + 1) % n], apex])

    def mesh(self):
        vertices = np.array(self._vertices)
        triangles = np.array(self._triangles)
        edges = Counter()
        for a, b, c in self._triangles:
            edges.update([(a, b), (b, c), (c, a)])
        for (a, b), count in edges.items():
            if count != 1 or edges.get((b, a)) != 1:
                raise ValueError(f"{self.name}: not closed at {self._vertices[a]} - {self._vertices[b]}")
        corners = vertices[triangles]
        volume = np.sum(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))) / 6.0
        if volume <= 0.0:
            raise ValueError(f"{self.name}: the surface is inside out")
        return vertices, triangles

    def describe(self):
        vertices, triangles = self.mesh()
        corners = vertices[triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = 0.5 * np.sum(np.linalg.norm(normals, axis=1))
        return (f"{self.name}: {self.face_count} faces, {len(vertices)} vertices, {len(triangles)} triangles, "
                f"area {area:.4f}")


def write_binary_stl(path, vertices, triangles, header):
    """Little-endian binary STL; the header is text of at most 80 bytes."""
    corners = np.asarray(vertices)[np.asarray(triangles)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    with open(path, "wb") as stream:
        stream.write(header.encode("ascii")[:80].ljust(80))
        stream.write(struct.pack("<I", len(corners)))
        for normal, corner in zip(normals, corners):
            stream.write(struct.pack("<12fH", *normal, *corner.reshape(-1), 0))
