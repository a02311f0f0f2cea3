"""The bodies of the thesis's scenes, and pairs of points on them."""
import collections
import pathlib

import numpy as np
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from geometry import poses

MESHES = pathlib.Path(__file__).resolve().parent.parent.parent / "meshes" / "thesis"
COLOURS = ("tab:blue", "tab:orange")
# The bodies of each scene, and elevation and azimuth of the view in degrees.
SCENES = {
    "boxes_position_1": ("box", "notched_box", 35, -70), "boxes_position_2": ("box", "notched_box", 35, -70),
    "cylinder_position_1": ("semi_extruded", "grooved_cylinder", 25, -60),
    "cylinder_position_2": ("semi_extruded", "grooved_cylinder", 25, -60),
    "battery_static": ("fixture", "battery", 20, -62),
}


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


def colour_words(scene):
    """Which body has which colour."""
    return f"Blue: {SCENES[scene][0].replace('_', ' ')}; orange: {SCENES[scene][1].replace('_', ' ')}."


def pose_of(scene):
    return poses.read_poses(MESHES / f"{scene}.csv")[0][1]


def draw_scene(axes, scene):
    """Both bodies in the frame of the first, and the view."""
    body_a, body_b, elevation, azimuth = SCENES[scene]
    extent = np.vstack([draw_body(axes, corners_of(body_a), np.eye(4), COLOURS[0]),
                        draw_body(axes, corners_of(body_b), pose_of(scene), COLOURS[1])])
    low, high = extent.min(axis=0), extent.max(axis=0)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_zlim(low[2], high[2])
    axes.set_box_aspect(high - low, zoom=1.08)
    axes.set_proj_type("ortho")
    axes.view_init(elev=elevation, azim=azimuth)
    axes.set_axis_off()


def pair_of(line, pose):
    """The two points of a line of *_points.csv in the frame of the first body, (6,)."""
    a = np.array([float(line[name]) for name in ("ax", "ay", "az")])
    b = poses.apply(pose, np.array([float(line[name]) for name in ("bx", "by", "bz")]))
    return np.concatenate((a, b))


def counted_pairs(lines, scene):
    """{pair: how many lines have it}."""
    pose = pose_of(scene)
    return collections.Counter(tuple(np.round(pair_of(line, pose), 9)) for line in lines)


def draw_pairs(axes, pairs, colour="black", width=0.6, least=12.0, whole=200.0, edge=0.5, above=3):
    """A line for each pair. Its ends are the larger the more of all there are, from the area `least` for none to `whole`
    more for all."""
    axes.add_collection3d(Line3DCollection([(pair[:3], pair[3:]) for pair in pairs], colors=colour, linewidths=width,
                                           zorder=above))
    total = sum(pairs.values())
    for body_colour, first in zip(COLOURS, (0, 3)):
        ends = np.array([pair[first:first + 3] for pair in pairs])
        axes.scatter(*ends.T, s=[least + whole * count / total for count in pairs.values()], color=body_colour, edgecolors="black",
                     linewidths=edge, depthshade=False, zorder=above + 1)
