#!/usr/bin/python3
"""Draws the convex pieces of the battery and the fixture, by hand and automatic: thesis/doc/images/partition.png; and the
cost of a step over the number of sub-pairs from doc/results/partition.csv: thesis/doc/images/partition_crossing.png.

    scripts/plot_partition.py            (needs a finished build for thesis_tool, and
    python3-matplotlib: scripts/install_dependencies.sh plot)
"""
import csv
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
MESHES = ROOT / "meshes" / "thesis"
IMAGES = ROOT / "thesis" / "doc" / "images"
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


def automatic_pieces(body, folder):
    tools = sorted((ROOT / "build").rglob("thesis_tool"))
    tools = [tool for tool in tools if tool.is_file()]
    if not tools:
        sys.exit("thesis_tool is not built: run scripts/build.sh -DCONCAVE_DISTANCE_WITH_THESIS=ON")
    path = pathlib.Path(folder) / f"{body}.obj"
    subprocess.run([str(tools[0]), "partition", str(MESHES / f"{body}.stl"), str(path)], check=True,
                   stdout=subprocess.DEVNULL)
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


def plot_pieces():
    figure = plt.figure(figsize=(12, 8.5))
    with tempfile.TemporaryDirectory() as folder:
        for row, (body, spread, elevation, azimuth) in enumerate((("battery", (0.7, 0.7, 0.7), 38, -65),
                                                                  ("fixture", (0.15, 0.15, 0.9), 24, -60))):
            for column, kind in enumerate(("by hand", "automatic")):
                pieces = read_pieces(MESHES / f"{body}_pieces.obj") if column == 0 else automatic_pieces(body, folder)
                axes = figure.add_subplot(2, 2, 2 * row + column + 1, projection="3d", computed_zorder=False)
                draw_pieces(axes, pieces, f"{body}, {kind}: {len(pieces)} pieces", spread, elevation, azimuth)
    figure.subplots_adjust(left=0.0, right=1.0, bottom=0.0, top=0.95, wspace=0.0, hspace=0.05)
    figure.savefig(IMAGES / "partition.png", dpi=90)
    plt.close(figure)
    print("thesis/doc/images/partition.png")


def plot_crossing():
    path = ROOT / "doc" / "results" / "partition.csv"
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["partition"] != "automatic"]
    sizes = {(row["hole_facets"], row["protrusions"]): int(row["sub_pairs"]) for row in rows
             if row["partition"] == "hand"}
    figure, axes = plt.subplots(figsize=(10.5, 5.5), layout="constrained")
    styles = (("QP, warm", "o-", "all sub-pairs, QP, warm"), ("GJK", "o-", "all sub-pairs, GJK"),
              ("QP, warm, culled", ".:", "culled, QP, warm"), ("GJK, culled", ".:", "culled, GJK"),
              ("hybrid: nodes + QP", "^--", "hybrid: nodes, then QP"), ("nodes", "s-", "search, nodes"),
              ("certified", "d-", "search, certified, with niches"),
              ("certified, distance only", "x-", "certified, distance only"))
    for method, style, label in styles:
        points = sorted((sizes[row["hole_facets"], row["protrusions"]], float(row["mean_us"])) for row in rows
                        if row["method"] == method)
        axes.plot([p[0] for p in points], [p[1] for p in points], style, label=label, markersize=5)
    axes.axvline(150, color="black", linewidth=0.8)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.text(155, 1.15 * axes.get_ylim()[0], "the thesis's guess: 150", fontsize=9)
    axes.set_xlabel("sub-pairs of the partition by hand")
    axes.set_ylabel("microseconds a step, mean of the manoeuvre's 200")
    axes.grid(alpha=0.3, which="both")
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))
    axes.set_title("Battery into fixture: partition against search")
    figure.savefig(IMAGES / "partition_crossing.png", dpi=100)
    plt.close(figure)
    print("thesis/doc/images/partition_crossing.png")


if __name__ == "__main__":
    plot_pieces()
    plot_crossing()
