#!/usr/bin/python3
"""Draws the constraint trees of the cylinder, the battery and the fixture, level by level: thesis/doc/images/constraint_trees.png.

    scripts/plot_constraint_trees.py     (needs a finished build for thesis_tool, and python3-matplotlib)
"""
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import numpy as np  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
BODIES = {"grooved_cylinder": (18, -55), "battery": (-28, -60), "fixture": (28, -60)}  # elevation and azimuth, degrees
LEVELS = {1: "level 1: hull", -2: "level -2: concavities", 3: "level 3: solids in them"}
SOLID, HOLE = np.array([0.45, 0.60, 0.78]), np.array([0.86, 0.55, 0.40])
LIGHT = np.array([-0.45, -0.65, 0.6]) / np.linalg.norm([-0.45, -0.65, 0.6])


def read_pieces(path):
    """{level: [triangles as arrays of three points]} of what `thesis_tool tree --pieces` writes."""
    points, levels, level = [], {}, None
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words[0] == "o":
                level = int(words[1].split("_")[1])
            elif words[0] == "v":
                points.append([float(word) for word in words[1:]])
            elif words[0] == "f":
                levels.setdefault(level, []).append(np.array([points[int(word) - 1] for word in words[1:]]))
    return levels


def pieces_of(body, folder):
    tools = [tool for tool in sorted((ROOT / "build").rglob("thesis_tool")) if tool.is_file()]
    if not tools:
        sys.exit("thesis_tool is not built: run scripts/build.sh -DCONCAVE_DISTANCE_WITH_THESIS=ON")
    path = pathlib.Path(folder) / f"{body}.obj"
    subprocess.run([str(tools[0]), "tree", str(ROOT / "meshes" / "thesis" / f"{body}.stl"),
                    str(path.with_suffix(".yaml")), "--pieces", str(path)], check=True, stdout=subprocess.DEVNULL)
    return read_pieces(path)


def shaded(triangles, colour):
    normals = np.array([np.cross(t[1] - t[0], t[2] - t[0]) for t in triangles])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    light = 0.65 + 0.35 * np.clip(normals @ LIGHT, -1.0, 1.0)
    return np.clip(light[:, None] * colour, 0.0, 1.0)


def draw(axes, triangles, level, box):
    if triangles:
        colours = shaded(triangles, SOLID if level > 0 else HOLE)
        axes.add_collection3d(Poly3DCollection(triangles, facecolors=colours, edgecolors=colours, linewidths=0.3))
    low, high = box
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_zlim(low[2], high[2])
    axes.set_box_aspect(high - low)
    axes.set_axis_off()


def main():
    figure = plt.figure(figsize=(9, 8))
    with tempfile.TemporaryDirectory() as folder:
        for row, (body, (elevation, azimuth)) in enumerate(BODIES.items()):
            levels = pieces_of(body, folder)
            everything = np.vstack([triangle for triangle in levels[1]])
            box = everything.min(axis=0), everything.max(axis=0)
            for column, (level, name) in enumerate(LEVELS.items()):
                axes = figure.add_subplot(len(BODIES), len(LEVELS), row * len(LEVELS) + column + 1, projection="3d")
                axes.view_init(elevation, azimuth)
                draw(axes, levels.get(level, []), level, box)
                if row == 0:
                    axes.set_title(name, fontsize=11)
                if column == 0:
                    axes.text2D(0.0, 0.05, body.replace("_", " "), transform=axes.transAxes, fontsize=10)
    figure.subplots_adjust(left=0.0, right=1.0, bottom=0.0, top=0.95, wspace=0.0, hspace=0.0)
    path = ROOT / "thesis" / "doc" / "images" / "constraint_trees.png"
    figure.savefig(path, dpi=90)
    print(path)


if __name__ == "__main__":
    main()
