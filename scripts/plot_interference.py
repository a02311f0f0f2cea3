#!/usr/bin/python3
"""Draws where the battery, pushed into its fixture, overlaps it: doc/images/interference.png, from the pose and the
regions in doc/results/interference.csv. The curves are cut here, triangle by triangle, from the mesh files.

    scripts/plot_interference.py            (needs python3-matplotlib: scripts/install_dependencies.sh plot)
"""
import csv
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import numpy as np  # noqa: E402
from geometry.poses import matrix_of_quaternion  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
COLOURS = ["tab:red", "tab:blue", "tab:green", "tab:purple"]


def read_stl(path):
    """Triangles of a binary STL file, (n, 3, 3)."""
    data = path.read_bytes()
    count = int.from_bytes(data[80:84], "little")
    facet = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    return np.frombuffer(data, facet, count, 84)["corners"].astype(float)


def read_scene(path):
    pose, regions = None, []
    with open(path, encoding="utf-8") as file:
        for row in csv.reader(file):
            if row[0] == "pose":
                pose = np.array([float(cell) for cell in row[2:9]])
            elif row[0] == "region":
                regions.append(np.array([float(cell) for cell in row[2:17]]))
    return pose, regions


def crossings(edges_of, through):
    """Points where the edges of one triangle run through another."""
    a, b, c = through
    normal = np.cross(b - a, c - a)
    points = []
    for k in range(3):
        p, q = edges_of[k], edges_of[(k + 1) % 3]
        height_p, height_q = normal @ (p - a), normal @ (q - a)
        if (height_p > 0) == (height_q > 0):
            continue
        point = p + height_p / (height_p - height_q) * (q - p)
        if all(normal @ np.cross(through[(i + 1) % 3] - through[i], point - through[i]) >= 0 for i in range(3)):
            points.append(point)
    return points


def curves(first, second):
    segments = []
    for s in first:
        for t in second:
            if (s.min(axis=0) > t.max(axis=0)).any() or (t.min(axis=0) > s.max(axis=0)).any():
                continue
            points = crossings(s, t) + crossings(t, s)
            if len(points) == 2:
                segments.append(points)
    return np.array(segments)


def main():
    pose, regions = read_scene(ROOT / "doc" / "results" / "interference.csv")
    fixture = read_stl(ROOT / "meshes" / "thesis" / "fixture.stl")
    battery = read_stl(ROOT / "meshes" / "thesis" / "battery.stl") @ matrix_of_quaternion(pose[3:]).T + pose[:3]
    segments = curves(fixture, battery)
    everything = np.vstack([fixture.reshape(-1, 3), battery.reshape(-1, 3)])
    whole = 0.5 * (everything.min(axis=0) + everything.max(axis=0))
    reach = 0.42 * np.ptp(everything, axis=0).max()
    nearest = [int(np.argmin([np.linalg.norm(segment.mean(axis=0) - r[3:6]) for r in regions])) for segment in segments]
    figure = plt.figure(figsize=(13, 4.6))
    views = [(whole, reach, "battery and fixture")]
    for index, region in enumerate(regions[:2]):
        own = segments[[n == index for n in nearest]].reshape(-1, 3)
        views.append((region[3:6], 1.1 * np.ptp(own, axis=0).max(),
                      f"depth {1e3 * region[0]:.2f} mm, contact area {1e4 * region[1]:.2f} cm$^2$,\n"
                      f"volume {1e6 * region[2]:.3f} cm$^3$"))
    for place, (centre, half, title) in enumerate(views):
        axes = figure.add_subplot(1, len(views), place + 1, projection="3d")
        for triangles, colour in ((fixture, (0.45, 0.45, 0.5)), (battery, (1.0, 0.6, 0.1))):
            axes.add_collection3d(Poly3DCollection(triangles, facecolors=[(*colour, 0.02 if place else 0.12)],
                                                   edgecolors=[(*colour, 0.35)], linewidths=0.4))
        for index, region in enumerate(regions):
            if place not in (0, index + 1):
                continue
            colour = COLOURS[index % len(COLOURS)]
            own = segments[[n == index for n in nearest]]
            axes.add_collection3d(Line3DCollection(own, colors=colour, linewidths=2.2))
            axes.quiver(*region[3:6], *(0.6 * half * region[6:9]), color=colour, linewidth=1.6, arrow_length_ratio=0.2)
        for axis, at in zip("xyz", centre):
            getattr(axes, f"set_{axis}lim")(at - half, at + half)
        axes.set_box_aspect((1, 1, 1), zoom=1.25)
        axes.view_init(elev=24, azim=-58)
        axes.set_axis_off()
        axes.set_title(title, fontsize=10, y=1.04,
                       color="black" if place == 0 else COLOURS[(place - 1) % len(COLOURS)])
    figure.subplots_adjust(left=0.0, right=1.0, bottom=0.0, top=0.88, wspace=0.02)
    figure.savefig(ROOT / "doc" / "images" / "interference.png", dpi=110)


if __name__ == "__main__":
    main()
