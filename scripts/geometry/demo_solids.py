"""The concave things the robot and the interactive scene move beside. Lengths in metres."""

import numpy as np

from .shapes import extrude_along_y, revolve, round_corners, subdivide, sweep
from .triangulation import triangulate_polygon


def _arc(centre, radius, start, end, count, plane="xz"):
    """Points of an arc, angles in degrees from the first axis of the plane towards the second."""
    angles = np.radians(np.linspace(start, end, count))
    points = np.zeros((count, 3))
    points[:, "xyz".index(plane[0])] = radius * np.cos(angles)
    points[:, "xyz".index(plane[1])] = radius * np.sin(angles)
    return points + np.asarray(centre)


def _line(start, end, count):
    return np.linspace(start, end, count)[:-1]


def _ball_end(path, radii, radius, count=10):
    """Lets a tube end in a ball of the given radius."""
    direction = path[-1] - path[-2]
    direction /= np.linalg.norm(direction)
    neck = np.arcsin(radii[-1] / radius)
    angles = np.linspace(neck, np.pi - 0.08, count + 1)[1:]
    start = path[-1] + direction * radius * np.cos(neck)
    extra = [start - direction * radius * np.cos(a) for a in angles]
    return np.vstack([path, extra]), np.concatenate([radii, radius * np.sin(angles)])


def hook():
    """A hanging hook: round plate, shank along -z, bend of 200 degrees, ball at the end.

    Frame: middle of the plate's upper face, z upwards; it reaches to z = -0.36 and along +x."""
    tube, bend = 0.014, 0.075
    plate = np.array([(0, 0, z) for z in (0.0, -0.004, -0.010, -0.014)])
    plate_radii = np.array([0.050, 0.055, 0.055, 0.050])
    shank = np.vstack([_line((0, 0, -0.016), (0, 0, -0.27), 40)])
    curve = _arc((bend, 0, -0.27), bend, 180, 395, 56)
    path = np.vstack([plate, shank, curve])
    radii = np.concatenate([plate_radii, np.full(len(shank) + len(curve), tube)])
    path, radii = _ball_end(path, radii, 0.022)
    return sweep("hook", path, radii, 28)


def eye():
    """A pole with a round foot that ends in a wide loop, almost closed.

    Frame: middle of the foot's lower face, z upwards; the loop's middle stands 0.62 m above it, its axis is x."""
    tube, loop, height = 0.016, 0.145, 0.62
    foot = np.array([(0, 0, z) for z in (0.0, 0.006, 0.012, 0.018)])
    foot_radii = np.array([0.090, 0.090, 0.085, 0.030])
    pole = _line((0, 0, 0.03), (0, 0, height - loop - 0.10), 24)
    # A gentle swing leads the pole's middle line onto the loop.
    swing = _arc((0, 0.10, height - loop - 0.10), 0.10, 180, 125, 8, "yz")[:-1]
    ring_start = swing[-1]
    angle = np.degrees(np.arctan2(ring_start[2] - height, ring_start[1]))
    ring = _arc((0, 0, height), loop, angle + 14, angle + 14 + 318, 66, "yz")
    path = np.vstack([foot, pole, swing, ring])
    radii = np.concatenate([foot_radii, np.full(len(pole) + len(swing) + len(ring), tube)])
    path, radii = _ball_end(path, radii, 0.022)
    return sweep("eye", path, radii, 28)


def vase():
    """An open vessel with a foot, belly and neck. Frame: middle of the foot, z upwards; 0.30 m tall."""
    outer = [(0.070, 0.0), (0.075, 0.006), (0.070, 0.016), (0.080, 0.04), (0.105, 0.08), (0.122, 0.12), (0.125, 0.15),
             (0.118, 0.18), (0.104, 0.21), (0.094, 0.24), (0.093, 0.26), (0.100, 0.28), (0.112, 0.296),
             (0.116, 0.300)]
    inner = [(0.112, 0.303), (0.106, 0.301), (0.092, 0.283), (0.084, 0.262), (0.085, 0.24), (0.095, 0.21),
             (0.109, 0.18), (0.116, 0.15), (0.113, 0.12), (0.096, 0.08), (0.068, 0.042), (0.030, 0.024)]
    rim = np.array(outer + inner)
    rim = np.vstack([rim, (0.004, 0.020), (0.004, 0.0)])
    profile = subdivide(rim, 0.014)
    return revolve("vase", profile, 56)


def pipe():
    """An S-bend with flanges. Frame: middle of the lower flange's face, z upwards; it ends at x = 0.24."""
    tube, bend = 0.030, 0.12

    def flange(centre, axis, sign):
        steps = np.array([0.0, 0.003, 0.015, 0.018]) * sign
        return np.array([np.asarray(centre) + s * np.asarray(axis) for s in steps])

    first = flange((0, 0, 0), (0, 0, 1), 1)
    rise = _line((0, 0, 0.022), (0, 0, 0.25), 20)
    up = _arc((bend, 0, 0.25), bend, 180, 90, 20)[:-1]
    down = _arc((bend, 0, 0.25 + 2 * bend), bend, -90, 0, 20)
    top = _line((2 * bend, 0, 0.25 + 2 * bend + 0.01), (2 * bend, 0, 0.60), 8)
    last = flange((2 * bend, 0, 0.604), (0, 0, 1), 1)
    path = np.vstack([first, rise, up, down, top, last])
    n = len(rise) + len(up) + len(down) + len(top)
    radii = np.concatenate([[0.055, 0.058, 0.058, 0.055], np.full(n, tube), [0.055, 0.058, 0.058, 0.055]])
    return sweep("pipe", path, radii, 36)


def crane():
    """A tube bent to a gallows, with a round foot and a ball at the free end. Frame: on the floor; the post stands
    at y = -0.95, the beam reaches to y = 0.62, its upper edge is at z = 1.30."""
    tube, post, bend = 0.025, -0.95, 0.15
    height = 1.30 - tube
    foot = np.array([(0, post, z) for z in (0.0, 0.006, 0.014, 0.02)])
    foot_radii = np.array([0.080, 0.080, 0.075, tube])
    rise = _line((0, post, 0.03), (0, post, height - bend), 34)
    corner = _arc((0, post + bend, height - bend), bend, 180, 90, 12, "yz")[:-1]
    beam = _line((0, post + bend, height), (0, 0.62, height), 40)
    path = np.vstack([foot, rise, corner, beam])
    radii = np.concatenate([foot_radii, np.full(len(path) - len(foot), tube)])
    path, radii = _ball_end(path, radii, 0.035)
    return sweep("crane", path, radii, 30)


def shelf():
    """A shelf of three boards before a back wall, all corners rounded.

    Frame: lower edge of the front, middle of the width; x points into the shelf, z upwards; boards at z = 0, 0.32 and
    0.64, 0.30 deep, 0.60 wide."""
    depth, board, gap, wall = 0.30, 0.025, 0.32, 0.02
    outline = [(0.0, 0.0), (depth, 0.0), (depth, 2 * gap + board), (0.0, 2 * gap + board), (0.0, 2 * gap),
               (depth - wall, 2 * gap), (depth - wall, gap + board), (0.0, gap + board), (0.0, gap),
               (depth - wall, gap), (depth - wall, board), (0.0, board)]
    radii = [0.010, 0.004, 0.004, 0.010, 0.010, 0.030, 0.030, 0.010, 0.010, 0.030, 0.030, 0.010]
    outline = subdivide(round_corners(outline, radii, 6), 0.05)
    return extrude_along_y("shelf", outline, np.linspace(-0.30, 0.30, 21), triangulate_polygon)


def comb():
    """A base with five teeth of different lengths and slopes. Frame: middle of the base's lower face, z upwards;
    0.64 long along x, 0.12 deep along y."""
    outline = [(-0.32, 0.0), (0.32, 0.0), (0.32, 0.20), (0.27, 0.20), (0.24, 0.05), (0.17, 0.05), (0.15, 0.16),
               (0.11, 0.16), (0.08, 0.05), (0.02, 0.05), (0.01, 0.24), (-0.03, 0.24), (-0.05, 0.05), (-0.12, 0.05),
               (-0.13, 0.14), (-0.17, 0.14), (-0.19, 0.05), (-0.25, 0.05), (-0.27, 0.19), (-0.32, 0.19)]
    outline = subdivide(round_corners(outline, 0.012, 5), 0.03)
    return extrude_along_y("comb", outline, np.linspace(-0.06, 0.06, 13), triangulate_polygon)


def clamp_outline():
    """The outline of `clamp` in (x, z)."""
    outline = np.array([(0.34, -0.025), (0.34, 0.025), (0.16, 0.03), (0.145, 0.078), (-0.02, 0.068), (-0.02, 0.026),
                        (0.012, 0.026), (0.024, 0.042), (0.11, 0.042),
                        (0.11, -0.042), (0.024, -0.042), (0.012, -0.026), (-0.02, -0.026), (-0.02, -0.068), (0.145, -0.078),
                        (0.16, -0.03)])
    radii = [0.008, 0.008, 0.02, 0.02, 0.008, 0.006, 0.004, 0.008, 0.02, 0.02, 0.008, 0.004, 0.006, 0.008, 0.02, 0.02]
    return round_corners(outline, radii, 6)


def clamp():
    """A C-shaped tool: two jaws with a pad each around a mouth 0.052 m high and 0.13 m deep, and a shank behind.

    Frame: between the pads, from which the tool reaches to x = 0.34; the mouth opens to -x, the jaws lie above and
    below (z). It is 0.06 m wide (y)."""
    return extrude_along_y("clamp", clamp_outline(), np.linspace(-0.03, 0.03, 2), triangulate_polygon)
