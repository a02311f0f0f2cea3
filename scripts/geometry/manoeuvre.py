"""The insertion manoeuvre of the battery into the fixture: 20 s, approach with rotation, then insertion.

Carretero (6.3.2) gives the phases and the rate, the curves of his fig. 6.5 are lost; these are ours. The
approach starts aside and turned about all axes, the insertion is a straight motion down the pins.
"""

import numpy as np

from . import poses

DURATION = 20.0
APPROACH = 10.0
RATE = 10.0
STEPS = 200

START_POSITION = np.array([0.35, -0.55, 1.35])
START_AXIS = np.array([0.80, 0.30, 0.52])
START_ANGLE = np.radians(65.0)
READY_HEIGHT = 0.62   # bottom of the battery above the plate, aligned, above every protrusion
REST_HEIGHT = 0.045   # inserted


def smooth(s):
    """Quintic from 0 to 1 with no speed and no acceleration at either end."""
    s = min(max(s, 0.0), 1.0)
    return s ** 3 * (10.0 + s * (-15.0 + 6.0 * s))


def pose_at(time):
    """Pose of the battery in the fixture's frame at `time` seconds."""
    pose = np.eye(4)
    if time <= APPROACH:
        progress = smooth(time / APPROACH)
        axis = START_AXIS / np.linalg.norm(START_AXIS)
        half = 0.5 * START_ANGLE * (1.0 - progress)
        pose[:3, :3] = poses.matrix_of_quaternion([*(np.sin(half) * axis), np.cos(half)])
        pose[:3, 3] = START_POSITION * (1.0 - progress) + np.array([0.0, 0.0, READY_HEIGHT]) * progress
    else:
        progress = smooth((time - APPROACH) / (DURATION - APPROACH))
        pose[2, 3] = READY_HEIGHT * (1.0 - progress) + REST_HEIGHT * progress
    return pose


def steps():
    """The 200 instants of the thesis's table: t = 0.1, 0.2, ... 20 s."""
    return [((k + 1) / RATE, pose_at((k + 1) / RATE)) for k in range(STEPS)]
