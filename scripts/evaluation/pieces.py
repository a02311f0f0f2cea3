"""Convex pieces of bodies: read from OBJ files, cut by `thesis_tool partition`, drawn apart from each other."""
import pathlib
import subprocess

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import numpy as np  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

from .rows import ROOT  # noqa: E402

LIGHT = np.array([-0.45, -0.65, 0.6]) / np.linalg.norm([-0.45, -0.65, 0.6])


def read_pieces(path):
    """[(corners, facets)] of an OBJ file with one object a piece."""
    pieces, corners, facets, first = [], [], [], 1
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if not words or words[0] == "o":
                if corners:
                    pieces.append((np.array(corners), facets))
                first += len(corners)
                corners, facets = [], []
            elif words[0] == "v":
                corners.append([float(word) for word in words[1:]])
            elif words[0] == "f":
                facets.append([int(word.split("/")[0]) - first for word in words[1:]])
    return pieces + [(np.array(corners), facets)]


def thesis_tool():
    """The program, or None where it is not built."""
    return next((path for path in sorted((ROOT / "build").rglob("thesis_tool")) if path.is_file()), None)


def automatic_pieces(mesh, folder):
    """The pieces into which thesis_tool cuts a mesh."""
    path = pathlib.Path(folder) / "pieces.obj"
    subprocess.run([str(thesis_tool()), "partition", str(mesh), str(path)], check=True, stdout=subprocess.DEVNULL)
    return read_pieces(path)


def draw_pieces(axes, pieces, title, spread, elevation, azimuth, zoom=1.12):
    """Each piece moved away from the body's middle by `spread` (an axis each) times its own distance from it."""
    everything = np.vstack([corners for corners, _ in pieces])
    middle = 0.5 * (everything.min(axis=0) + everything.max(axis=0))
    colours = plt.get_cmap("tab20").colors
    placed = []
    view = np.array([np.cos(np.radians(elevation)) * np.cos(np.radians(azimuth)),
                     np.cos(np.radians(elevation)) * np.sin(np.radians(azimuth)), np.sin(np.radians(elevation))])
    for number, (corners, facets) in enumerate(pieces):
        centre = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
        moved = corners + np.array(spread) * (centre - middle)
        placed.append(moved)
        shades = []
        for facet in facets:
            normal = sum(np.cross(moved[facet[k]] - moved[facet[0]], moved[facet[k + 1]] - moved[facet[0]])
                         for k in range(1, len(facet) - 1))
            normal = normal / max(np.linalg.norm(normal), 1e-30)
            bright = 0.55 + 0.45 * max(0.0, float(normal @ LIGHT))
            shades.append(tuple(bright * c for c in colours[number % len(colours)]))
        # Facets that turn away are hidden by the piece's own front. The painter begins with what lies deepest, so that
        # a plate comes before all that stands above it, and then with what is farthest.
        shown = [k for k, facet in enumerate(facets)
                 if np.cross(moved[facet[1]] - moved[facet[0]], moved[facet[2]] - moved[facet[0]]) @ view > 0.0]
        axes.add_collection3d(Poly3DCollection([moved[facets[k]] for k in shown],
                                               facecolors=[shades[k] for k in shown], edgecolors="black",
                                               linewidths=0.5,
                                               zorder=-1e3 if moved[:, 2].max() < 0.0 else float(centre @ view)))
    extent = np.vstack(placed)
    low, high = extent.min(axis=0), extent.max(axis=0)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_zlim(low[2], high[2])
    axes.set_box_aspect(high - low, zoom=zoom)
    axes.view_init(elev=elevation, azim=azimuth)
    axes.set_proj_type("ortho")
    axes.set_axis_off()
    axes.set_title(title, y=1.0)
