#!/usr/bin/python3
"""Draws figures of the thesis that stand for no table: 5.6, 6.1 to 6.3 and 6.5 (evaluation_figure_*.png).

    scripts/plot_thesis_figures.py RESULTS [MORE_RESULTS ...] [--output doc/results/images]

RESULTS are folders that `evaluate --output` or `keep_rows.py` has filled: figure 5.6 is drawn from
figure_5_6_points.csv, and left out where it is missing. Figures 6.1 to 6.3 need a finished build for mesh_tool with CGAL.
Needs python3-matplotlib: scripts/install_dependencies.sh plot.
"""
import argparse
import collections
import csv
import lzma
import pathlib
import subprocess
import tempfile

import matplotlib

from geometry import poses, thesis_solids
from geometry.manoeuvre import APPROACH
from geometry.solid import Solid, write_binary_stl
from plot_partition import draw_pieces, read_pieces

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import numpy as np  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
MESHES = ROOT / "meshes" / "thesis"
COLOURS = ("tab:blue", "tab:orange")
# Of each scene its bodies, and elevation and azimuth of the view in degrees.
SCENES = {"boxes_position_1": ("box", "notched_box", 35, -70), "battery_static": ("fixture", "battery", 20, -62)}
RUNS = {"comb-GA-nl": 200, "comb-GA-wl": 500}  # the thesis's
SAME = 1e-9  # metres
ROUNDING = 1e-16  # metres: what is less is none


def corners_of(body):
    """The triangles of an STL file, (n, 3, 3)."""
    data = (MESHES / f"{body}.stl").read_bytes()[84:]
    return np.frombuffer(data, dtype=np.dtype([("f", "<f4", 12), ("a", "<u2")]))["f"][:, 3:].reshape(-1, 3, 3).astype(float)


def sharp_edges(corners):
    """Edges between triangles that are not in one plane."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    found = collections.defaultdict(list)
    for triangle, normal in zip(corners, normals):
        for k in range(3):
            found[tuple(sorted((tuple(triangle[k]), tuple(triangle[(k + 1) % 3]))))].append(normal)
    return [edge for edge, around in found.items() if len(around) != 2 or around[0] @ around[1] < 0.999]


def draw_body(axes, corners, pose, colour):
    placed = poses.apply(pose, corners)
    axes.add_collection3d(Poly3DCollection(placed, facecolors=colour, alpha=0.06, edgecolors="none"))
    axes.add_collection3d(Line3DCollection([poses.apply(pose, np.array(edge)) for edge in sharp_edges(corners)],
                                           colors=colour, linewidths=0.7))
    return placed.reshape(-1, 3)


def read_points(folders):
    """{(row, scene): {run: line}} of figure_5_6_points.csv; of a run that was done again the last line."""
    found = collections.defaultdict(dict)
    for folder in folders:
        for path in (pathlib.Path(folder) / "figure_5_6_points.csv", pathlib.Path(folder) / "figure_5_6_points.csv.xz"):
            if path.exists():
                with (lzma.open if path.suffix == ".xz" else open)(path, "rt", newline="", encoding="utf-8") as file:
                    for line in csv.DictReader(file):
                        found[line["row"], line["scene"]][int(line["run"])] = line
    return found


def draw_points(axes, scene, runs):
    """The best pairs of all runs, in the frame of the first body."""
    body_a, body_b, elevation, azimuth = SCENES[scene]
    pose = poses.read_poses(MESHES / f"{scene}.csv")[0][1]
    extent = np.vstack([draw_body(axes, corners_of(body_a), np.eye(4), COLOURS[0]),
                        draw_body(axes, corners_of(body_b), pose, COLOURS[1])])
    pairs = collections.Counter()
    for run in runs:
        a = np.array([float(run[name]) for name in ("ax", "ay", "az")])
        b = poses.apply(pose, np.array([float(run[name]) for name in ("bx", "by", "bz")]))
        pairs[tuple(np.round(np.concatenate((a, b)), 9))] += 1
    axes.add_collection3d(Line3DCollection([(pair[:3], pair[3:]) for pair in pairs], colors="black", linewidths=0.6))
    for colour, first in zip(COLOURS, (0, 3)):
        ends = np.array([pair[first:first + 3] for pair in pairs])
        axes.scatter(*ends.T, s=[12 + 200 * count / len(runs) for count in pairs.values()], color=colour, edgecolors="black",
                     linewidths=0.5, depthshade=False)
    low, high = extent.min(axis=0), extent.max(axis=0)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_zlim(low[2], high[2])
    axes.set_box_aspect(high - low, zoom=1.08)
    axes.set_proj_type("ortho")
    axes.view_init(elev=elevation, azim=azimuth)
    axes.set_axis_off()
    return len(pairs)


def plot_figure_5_6(folders, images):
    points = read_points(folders)
    if not points:
        print("no figure_5_6_points.csv: figure 5.6 is left out")
        return
    rows = sorted({row for row, _ in points})
    scenes = sorted({scene for _, scene in points}, reverse=True)
    figure = plt.figure(figsize=(6 * len(rows), 4.4 * len(scenes)))
    for i, scene in enumerate(scenes):
        for k, row in enumerate(rows):
            runs = [line for run, line in sorted(points[row, scene].items()) if run < RUNS[row.split(";")[0]]]
            best = min(float(line["distance"]) for of_row in rows for line in points[of_row, scene].values())
            at_best = sum(float(line["distance"]) < best + SAME for line in runs)
            axes = figure.add_subplot(len(scenes), len(rows), i * len(rows) + k + 1, projection="3d")
            places = draw_points(axes, scene, runs)
            axes.set_title(f"{row.replace(';', ',')}, {scene.replace('_', ' ')}\n{len(runs)} runs end at {places} "
                           f"pair{'s' * (places != 1)}, {at_best} of them at the nearest", fontsize=11, y=0.97)
    figure.text(0.5, 0.015, "Each line joins the best pair of a run's last population; the larger its ends, the more runs have it.",
                ha="center", fontsize=11)
    figure.subplots_adjust(left=0.0, right=1.0, bottom=0.03, top=0.95, wspace=0.0, hspace=0.06)
    save(figure, images / "evaluation_figure_5_6.png")


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
    tool = next((path for path in sorted((ROOT / "build").rglob("mesh_tool")) if path.is_file()), None)
    if tool is None:
        print("mesh_tool is not built: figures 6.1 to 6.3 are left out")
        return
    solids = [("6_1", holed_block(22), (0.5, 0.5, 0.5), 42, -60), ("6_2", slotted_block(), (0.35, 0.35, 0.35), 38, -62),
              ("6_3", thesis_solids.semi_extruded(), (0.4, 0.4, 0.4), 22, -58)]
    for number, solid, spread, elevation, azimuth in solids:
        vertices, triangles = solid.mesh()
        with tempfile.TemporaryDirectory() as folder:
            mesh, output = pathlib.Path(folder) / "body.stl", pathlib.Path(folder) / "pieces.obj"
            write_binary_stl(mesh, vertices, triangles, solid.name)
            subprocess.run([str(tool), "partition", str(mesh), str(output)], check=True, stdout=subprocess.DEVNULL)
            pieces = read_pieces(output)
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="+", type=pathlib.Path)
    parser.add_argument("--output", default=ROOT / "doc" / "results" / "images", type=pathlib.Path)
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    plot_figure_5_6(options.results, options.output)
    plot_partitions(options.output)
    plot_figure_6_5(options.output)


if __name__ == "__main__":
    main()
