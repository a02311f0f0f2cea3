#!/usr/bin/python3
"""Draws the thesis's pictures of bodies: solutions 2.19 to 2.35, populations 4.6, 4.8 and 4.12, best points 5.6, partitions
6.1 to 6.3, and the poses 6.5 (evaluation_figure_*.png); without RESULTS thesis/doc/images/partition.png, the convex pieces of the
battery and the fixture, and partition_crossing.png, the cost of a step over the number of sub-pairs from doc/results/partition.csv.

    scripts/plot_thesis_figures.py [RESULTS ...] [--output doc/results/images]

RESULTS are folders that `evaluate --output` or `keep_rows.py` has filled: pictures up to 5.6 are drawn from *_points.csv,
and left out where it is missing. Pieces need a finished build for thesis_tool with CGAL.
Needs python3-matplotlib: scripts/install_dependencies.sh plot.
"""
import argparse
import csv
import pathlib
import sys
import tempfile

import matplotlib

from evaluation.pieces import automatic_pieces, draw_pieces, read_pieces, thesis_tool
from evaluation.solution_figures import plot_pictures
from geometry import poses, thesis_solids
from geometry.manoeuvre import APPROACH
from geometry.solid import Solid, write_binary_stl

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import numpy as np  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
MESHES = ROOT / "meshes" / "thesis"
IMAGES = ROOT / "thesis" / "doc" / "images"
ROUNDING = 1e-16  # metres: what is less is none


def holed_block(sides):
    """A block with a round hole through it."""
    solid = Solid("holed_block")
    rims = [thesis_solids.regular_polygon((0.0, 0.0), 0.3, sides, z) for z in (-0.25, 0.25)]
    walls = [thesis_solids.rectangle((-0.5, -0.5), (0.5, 0.5), z) for z in (-0.25, 0.25)]
    for rim, wall, up in zip(rims, walls, (-1, 1)):
        solid.add_face(wall, holes=[rim], outward=(0, 0, up))
    solid.add_band(*walls)
    solid.add_band(*reversed(rims))
    return solid


def slotted_block():
    """A block with a slot from above, a step and a slot from the side."""
    outline = [(-0.6, -0.4), (0.6, -0.4), (0.6, -0.1), (0.3, -0.1), (0.3, 0.1), (0.6, 0.1), (0.6, 0.4), (0.1, 0.4), (0.1, 0.0),
               (-0.2, 0.0), (-0.2, 0.4), (-0.4, 0.4), (-0.4, 0.2), (-0.6, 0.2)]
    return thesis_solids.extrude("slotted_block", outline, -0.25, 0.25)


def deepest_dent(pieces):
    """How far a corner of a piece stands out of the plane of one of its facets: 0 of convex ones, metres."""
    deepest = 0.0
    for corners, facets in pieces:
        for facet in facets:
            normal = sum(np.cross(corners[facet[k]] - corners[facet[0]], corners[facet[k + 1]] - corners[facet[0]])
                         for k in range(1, len(facet) - 1))
            deepest = max(deepest, float(((corners - corners[facet[0]]) @ (normal / np.linalg.norm(normal))).max()))
    return deepest


def plot_partitions(images):
    if thesis_tool() is None:
        print("thesis_tool is not built: figures 6.1 to 6.3 are left out")
        return
    solids = [("6_1", holed_block(22), (0.5, 0.5, 0.5), 42, -60), ("6_2", slotted_block(), (0.35, 0.35, 0.35), 38, -62),
              ("6_3", thesis_solids.semi_extruded(), (0.4, 0.4, 0.4), 22, -58)]
    for number, solid, spread, elevation, azimuth in solids:
        vertices, triangles = solid.mesh()
        with tempfile.TemporaryDirectory() as folder:
            mesh = pathlib.Path(folder) / "body.stl"
            write_binary_stl(mesh, vertices, triangles, solid.name)
            pieces = automatic_pieces(mesh, folder)
        figure = plt.figure(figsize=(11, 4.8))
        whole = [(vertices, [list(triangle) for triangle in triangles])]
        for place, (shown, apart, title) in enumerate((
                (whole, (0, 0, 0), f"{solid.name.replace('_', ' ')}: {len(triangles)} triangles"),
                (pieces, spread, f"{len(pieces)} pieces, moved apart; convex to {max(deepest_dent(pieces), ROUNDING):.0e} m"))):
            axes = figure.add_subplot(1, 2, place + 1, projection="3d", computed_zorder=False)
            draw_pieces(axes, shown, title, apart, elevation, azimuth, zoom=0.9)
        figure.subplots_adjust(left=0.0, right=1.0, bottom=0.0, top=0.93, wspace=0.0)
        save(figure, images / f"evaluation_figure_{number}.png")


def roll_pitch_yaw(matrix):
    """Degrees about the fixed axes x, y, z."""
    return np.degrees([np.arctan2(matrix[2, 1], matrix[2, 2]), -np.arcsin(np.clip(matrix[2, 0], -1.0, 1.0)),
                       np.arctan2(matrix[1, 0], matrix[0, 0])])


def plot_figure_6_5(images):
    rows = poses.read_poses(MESHES / "manoeuvre_200.csv")
    times = [time for time, _ in rows]
    figure, (position, orientation) = plt.subplots(2, 1, figsize=(8, 6), sharex=True, layout="constrained")
    for axes, values, names in ((position, np.array([pose[:3, 3] for _, pose in rows]), "xyz"),
                                (orientation, np.array([roll_pitch_yaw(pose) for _, pose in rows]), ("roll", "pitch", "yaw"))):
        for k, name in enumerate(names):
            axes.plot(times, values[:, k], ("-", "--", "-.")[k], label=name)
        axes.axvline(APPROACH, color="0.5", linewidth=0.8)
        axes.grid(alpha=0.3)
        axes.legend()
    position.set_ylabel("position of the battery, m")
    orientation.set_ylabel("orientation, degrees")
    orientation.set_xlabel("time, s (approach until 10 s, then insertion)")
    position.set_title("The battery in the fixture's frame")
    save(figure, images / "evaluation_figure_6_5.png")


def save(figure, path):
    figure.savefig(path, dpi=90)
    plt.close(figure)
    print(path)


def plot_pieces():
    """The pieces of the battery and the fixture, by hand and automatic."""
    if thesis_tool() is None:
        sys.exit("thesis_tool is not built: run scripts/build.sh all")
    figure = plt.figure(figsize=(12, 8.5))
    with tempfile.TemporaryDirectory() as folder:
        for row, (body, spread, elevation, azimuth) in enumerate((("battery", (0.7, 0.7, 0.7), 38, -65),
                                                                  ("fixture", (0.15, 0.15, 0.9), 24, -60))):
            for column, kind in enumerate(("by hand", "automatic")):
                pieces = read_pieces(MESHES / f"{body}_pieces.obj") if column == 0 else automatic_pieces(MESHES / f"{body}.stl", folder)
                axes = figure.add_subplot(2, 2, 2 * row + column + 1, projection="3d", computed_zorder=False)
                draw_pieces(axes, pieces, f"{body}, {kind}: {len(pieces)} pieces", spread, elevation, azimuth)
    figure.subplots_adjust(left=0.0, right=1.0, bottom=0.0, top=0.95, wspace=0.0, hspace=0.05)
    save(figure, IMAGES / "partition.png")


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
    save(figure, IMAGES / "partition_crossing.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="*", type=pathlib.Path)
    parser.add_argument("--output", default=ROOT / "doc" / "results" / "images", type=pathlib.Path)
    options = parser.parse_args()
    if not options.results:
        plot_pieces()
        plot_crossing()
        return
    options.output.mkdir(parents=True, exist_ok=True)
    plot_pictures(options.results, options.output)
    plot_partitions(options.output)
    plot_figure_6_5(options.output)


if __name__ == "__main__":
    main()
