#!/usr/bin/python3
"""Fits poses and protrusions so that the distances which survive in Carretero's text come out exactly.

Writes scripts/geometry/thesis_scene.json, which generate_thesis_geometry.py reads. Every unknown has one
target, so that each is found by bisection or in closed form; nothing is random. Run again after changing
sizes in scripts/geometry/thesis_solids.py:

    scripts/fit_thesis_scene.py && scripts/generate_thesis_geometry.py
"""

import json
import os

import numpy as np

from geometry import poses, thesis_solids
from geometry.exact_distance import closest_on_triangles, mesh_distance

OUTPUT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "geometry", "thesis_scene.json")


def corners_of(solid):
    vertices, triangles = solid.mesh()
    return vertices[triangles]


def bisect(function, lower, upper):
    """Root of a function that changes sign once between the bounds."""
    sign = np.sign(function(lower))
    if sign == np.sign(function(upper)):
        raise ValueError(f"no sign change: {function(lower)} {function(upper)}")
    for _ in range(80):
        middle = 0.5 * (lower + upper)
        if np.sign(function(middle)) == sign:
            lower = middle
        else:
            upper = middle
    return 0.5 * (lower + upper)


def box_pose(beta, corner_x, corner_y):
    """Pose of the notched box in the box's frame. The box's leading edge stands at (corner_x, corner_y) in
    the notched box's frame, its upper side leans back by beta from the -x axis."""
    h = thesis_solids.CUBE_SIDE / 2.0
    upper = np.array([-np.cos(beta), np.sin(beta), 0.0])
    lower = np.array([-np.sin(beta), -np.cos(beta), 0.0])
    b_from_a = np.eye(4)
    b_from_a[:3, 0], b_from_a[:3, 1], b_from_a[:3, 2] = -upper, -lower, (0, 0, 1)
    b_from_a[:3, 3] = np.array([corner_x, corner_y, 0.0]) + h * (upper + lower)
    return poses.inverse(b_from_a)


def fit_boxes():
    """Position 1: the box's edge before the land between the notches (0.2984), its two sides before the
    outer rims (0.5245 and 0.6096). Position 2: the edge stands in the upper notch, 0.0979 from its rim."""
    y1, _, y3, y4 = thesis_solids.notch_rims()
    d1, d2, d3 = 0.2984, 0.5245, 0.6096

    def span(beta):
        return (d2 - d1 * np.sin(beta)) / np.cos(beta) + (d3 - d1 * np.cos(beta)) / np.sin(beta)

    beta = bisect(lambda b: span(b) - thesis_solids.NOTCH_SPAN, np.radians(38.0), np.radians(48.0))
    corner_y = y4 - (d2 - d1 * np.sin(beta)) / np.cos(beta)
    position_1 = box_pose(beta, -d1, corner_y)

    beta_2, corner_x = np.radians(40.0), 0.02
    # (rim - corner) . (sin, cos) = 0.0979, the distance of the upper rim from the box's upper side.
    corner_y_2 = y4 - (0.0979 + corner_x * np.sin(beta_2)) / np.cos(beta_2)
    position_2 = box_pose(beta_2, corner_x, corner_y_2)
    lower_rim = -corner_x * np.cos(beta_2) + (corner_y_2 - y3) * np.sin(beta_2)
    print(f"boxes: beta {np.degrees(beta):.4f} deg; position 2: lower rim at {lower_rim:.4f}")
    return position_1, position_2


def fit_cylinder():
    """A = semi-extruded body, B = grooved cylinder. Position 1: the cylinder lies in the slot, its lowest
    line 0.0394 above the floor. Position 2: the nose stands in the groove, 0.0114 and 0.0898 from its
    walls."""
    body, cylinder = corners_of(thesis_solids.semi_extruded()), corners_of(thesis_solids.grooved_cylinder())
    position_1 = np.eye(4)
    position_1[:3, :3] = poses.rotation("x", np.radians(90.0))
    position_1[:3, 3] = (0.03, 0.1, thesis_solids.SLOT_FLOOR + 0.0394 + thesis_solids.CYLINDER_RADIUS)

    middle = np.mean(cylinder, axis=1)[:, 2]
    half = thesis_solids.GROOVE_WIDTH / 2.0
    upper_wall = cylinder[(middle > 0.0) & (middle < half)]
    lower_wall = cylinder[(middle < 0.0) & (middle > -half)]
    nose_x = max(x for x, _ in thesis_solids.SEMI_EXTRUDED_PROFILE)
    turn = poses.rotation("z", np.radians(3.0)) @ poses.rotation("y", np.radians(4.0))
    waist = thesis_solids.CYLINDER_RADIUS - thesis_solids.GROOVE_DEPTH

    def pose(x, z):
        result = np.eye(4)
        result[:3, :3] = turn
        result[:3, 3] = (nose_x + waist + x, 0.05, 0.6 + z)
        return result

    def wall_distance(wall, x, z):
        moved = poses.apply(pose(x, z), wall.reshape(-1, 3)).reshape(-1, 3, 3)
        return mesh_distance(body, moved)[0]

    # Newton on two unknowns; both distances are smooth between the walls.
    x, z = 0.08, -0.03
    for _ in range(40):
        value = np.array([wall_distance(upper_wall, x, z) - 0.0898, wall_distance(lower_wall, x, z) - 0.0114])
        if np.max(np.abs(value)) < 1e-12:
            break
        step = 1e-6
        slope = np.column_stack([
            [(wall_distance(w, x + step, z) - wall_distance(w, x - step, z)) / (2 * step) for w in
             (upper_wall, lower_wall)],
            [(wall_distance(w, x, z + step) - wall_distance(w, x, z - step)) / (2 * step) for w in
             (upper_wall, lower_wall)]])
        x, z = np.array([x, z]) - np.clip(np.linalg.solve(slope, value), -0.02, 0.02)
    else:
        raise ValueError("the pose of the nose in the groove was not found")
    print(f"cylinder: position 2 at x {x:.6f} z {z:.6f}")
    return position_1, pose(x, z)


# Region numbers of Carretero's Table 4.6 with their node distances at grid 0.05.
REGION_DISTANCES = {1: 0.2971, 2: 0.2953, 3: 0.2039, 4: 0.1336, 5: 0.1499, 6: 0.0757, 7: 0.4026, 8: 0.3731,
                    9: 0.3938}
# A node seldom sits at the foot itself: where the foot lies inside a face or an edge the exact distance is
# made a little shorter than the thesis's node distance. Feet at corners of the battery need nothing.
NODE_ALLOWANCE = 0.003


def square(centre, half_x, half_y):
    x, y = centre
    return [(x - half_x, y - half_y), (x + half_x, y - half_y), (x + half_x, y + half_y), (x - half_x, y + half_y)]


def fit_battery():
    """A = fixture, B = battery, tilted over the fixture. Each protrusion's height is the root of one
    equation: distance of its tip from the battery = the region's distance."""
    sx, sy, _ = thesis_solids.BATTERY_SIZE
    pose = np.eye(4)
    pose[:3, :3] = (poses.rotation("z", np.radians(9.0)) @ poses.rotation("y", np.radians(4.0)) @
                    poses.rotation("x", np.radians(-18.0)))
    pose[:3, 3] = (0.0, -0.10, 0.0)
    battery = corners_of(thesis_solids.battery())
    lowest = np.min(poses.apply(pose, battery.reshape(-1, 3))[:, 2])
    pose[2, 3] = REGION_DISTANCES[9] * (1.0 - NODE_ALLOWANCE) - lowest
    placed = poses.apply(pose, battery.reshape(-1, 3)).reshape(-1, 3, 3)

    def corner(x_sign, y_sign):
        return poses.apply(pose, np.array([[x_sign * sx / 2.0, y_sign * sy / 2.0, 0.0]]))[0]

    (left, right) = thesis_solids.HOLE_CENTRES
    west, south_west, south_east = corner(-1, 1), corner(-1, -1), corner(1, -1)
    print("corners", corner(-1, 1), corner(-1, -1), corner(1, -1), corner(1, 1))
    pin = 0.055
    # region, name, base outline, tip (x, y), height of the pointed part, foot is a corner of the battery
    design = [
        (1, "left_pin", [tuple(p[:2]) for p in thesis_solids.regular_polygon(left, pin, 6, 0.0)], left, 0.055, False),
        (2, "right_pin", [tuple(p[:2]) for p in thesis_solids.regular_polygon(right, pin, 6, 0.0)], right, 0.055, False),
        (3, "east_rail", square((0.425, -0.125), 0.025, 0.035), (0.425, -0.125), 0.05, False),
        (4, "west_rail_north", square((-0.42, 0.125), 0.025, 0.035), (-0.425, 0.13), 0.06, True),
        (5, "south_west_post", square((-0.31, -0.44), 0.04, 0.03), (-0.325, -0.45), 0.07, True),
        (6, "south_east_post", square((0.395, -0.34), 0.03, 0.035), (0.40, -0.345), 0.07, True),
        (7, "south_stop", square((0.06, -0.31), 0.06, 0.03), (0.06, -0.31), 0.05, False),
        (8, "west_rail_south", square((-0.425, -0.125), 0.025, 0.035), (-0.425, -0.125), 0.05, False)]
    protrusions = []
    for region, name, base, tip, point, at_corner in design:
        target = REGION_DISTANCES[region] * (1.0 if at_corner else 1.0 - NODE_ALLOWANCE)

        def gap(height):
            return np.sqrt(np.min(closest_on_triangles(np.array([[tip[0], tip[1], height]]), placed)[1])) - target

        # From the plate up: the first height at which the tip comes near enough.
        grid = np.linspace(0.0, 0.8, 801)
        first = next((k for k in range(1, len(grid)) if gap(grid[k]) <= 0.0), None)
        if gap(grid[0]) <= 0.0 or first is None:
            print(f"region {region} {name}: no height, gap at plate {gap(0.0):.4f}")
            continue
        height = bisect(gap, grid[first - 1], grid[first])
        foot = closest_on_triangles(np.array([[tip[0], tip[1], height]]), placed)
        foot = poses.apply(poses.inverse(pose), foot[0][0][np.argmin(foot[1][0])][None])[0]
        print(f"region {region} {name}: height {height:.4f}, foot in the battery's frame {np.round(foot, 4)}")
        protrusions.append({"region": region, "name": name, "base": [list(p) for p in base],
                            "shoulder": height - point, "tip": [tip[0], tip[1], height]})
    return pose, protrusions


def main():
    boxes_1, boxes_2 = fit_boxes()
    cylinder_1, cylinder_2 = fit_cylinder()
    battery_pose, protrusions = fit_battery()
    result = {"boxes_position_1": boxes_1.tolist(), "boxes_position_2": boxes_2.tolist(),
              "cylinder_position_1": cylinder_1.tolist(), "cylinder_position_2": cylinder_2.tolist(),
              "battery_static": battery_pose.tolist(), "protrusions": protrusions}
    with open(OUTPUT, "w", encoding="utf-8") as stream:
        json.dump(result, stream, indent=1)
        stream.write("\n")


if __name__ == "__main__":
    main()
