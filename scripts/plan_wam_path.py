#!/usr/bin/python3
"""Plans the closed joint paths of the demos robot and cell: config/wam_path.csv and config/cell_path.csv.

Robot: the hand goes into the shelf, down into the vase, home, through the eye and home again; each way out is
retraced on the way back. Cell: it picks a part from the crate, carries it past the shelf, puts it down on a
carton and goes home. Written are waypoints for a periodic cubic spline (joint_player, JointPath). That the
robot's path stays clear of all bodies is a test (test/ros/demo).

    scripts/plan_wam_path.py
"""

import os

import numpy as np

from geometry.wam_kinematics import Chain

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# Tip position (metres, world), direction of the hand, time at a nominal 2.5 s per leg.
LEG = 2.5
TO_VASE = [((0.72, 0.13, 0.66), (1.0, 0.0, -0.1)), ((0.64, 0.30, 0.50), (1.0, 0.0, 0.0)),
           ((0.93, 0.30, 0.49), (1.0, 0.0, 0.0)), ((0.64, 0.30, 0.50), (1.0, 0.0, 0.0)),
           ((0.31, 0.73, 0.48), (0.05, 0.1, -1.0)), ((0.30, 0.74, 0.20), (0.0, 0.05, -1.0))]
THROUGH_EYE = [((0.72, 0.13, 0.66), (1.0, 0.0, -0.1)), ((0.36, -0.36, 0.61), (1.0, 0.0, 0.0)),
               ((0.735, -0.36, 0.59), (1.0, 0.0, 0.0))]
# What each leg takes in the end, seconds: the turn of the wrist between shelf and vase needs longer.
DURATIONS = [3.0, 2.5, 2.5, 6.0, 3.0, 3.0, 6.0, 3.0, 5.0, 3.5, 3.5, 5.0]
DOWN = (0.0, 0.0, -1.0)
ABOVE_CRATE, ABOVE_CARTON = ((0.30, 0.74, 0.48), DOWN), ((0.70, -0.44, 0.62), DOWN)
IN_CRATE, AT_CARTON = ((0.30, 0.74, 0.20), DOWN), ((0.72, -0.46, 0.468), DOWN)
HALF_WAY = ((0.58, 0.36, 0.60), (0.7, 0.3, -0.7))
# Twice in the crate and at the carton: there it waits until the part is attached or detached.
PICK = [TO_VASE[0], HALF_WAY, ABOVE_CRATE, IN_CRATE, IN_CRATE, ABOVE_CRATE, ((0.60, 0.27, 0.52), (0.2, 0.0, -1.0)),
        ABOVE_CARTON, AT_CARTON, AT_CARTON, ABOVE_CARTON, TO_VASE[0]]
PICK_DURATIONS = [3.0, 5.0, 3.0, 1.5, 3.0, 5.0, 5.0, 3.0, 1.5, 3.0, 5.0]
POSTURE = np.array([0.0, 0.6, 0.0, 1.6, 0.0, 0.3, 0.0])
STEP = 0.5


def target(stations, time):
    leg = min(int(time / LEG), len(stations) - 2)
    s = time / LEG - leg
    s = s * s * (3.0 - 2.0 * s)
    (p0, d0), (p1, d1) = stations[leg], stations[leg + 1]
    direction = (1.0 - s) * np.array(d0) + s * np.array(d1)
    return (1.0 - s) * np.array(p0) + s * np.array(p1), direction / np.linalg.norm(direction)


def follow(chain, stations, start):
    """Joint positions every STEP seconds of nominal time along the stations."""
    q, result = start, []
    for k in range(int(round((len(stations) - 1) * LEG / STEP)) + 1):
        position, direction = target(stations, k * STEP)
        q, error = chain.solve(position, direction, q, POSTURE, 250)
        if error > 1e-3:
            raise ValueError(f"station at {k * STEP} s is out of reach by {error:.4f}")
        result.append(q)
    return result


def write(name, chain, path, durations):
    """Waypoints at the times that the durations of the legs give."""
    ends = np.concatenate([[0.0], np.cumsum(durations)])
    times = np.interp(np.arange(len(path)) * STEP, np.arange(len(ends)) * LEG, ends)
    gap = np.abs(path[-1] - path[0]).max()
    if gap > 1e-6:
        raise ValueError(f"{name} ends {gap:.4f} rad from where it began")
    path[-1] = path[0]
    with open(os.path.join(ROOT, "config", name), "w", encoding="ascii") as stream:
        stream.write("t," + ",".join(chain.joint_names) + "\n")
        for time, q in zip(times, path):
            stream.write(",".join(f"{v + 0.0:.9g}" for v in [time, *q]) + "\n")
    print(f"{name}: {len(path)} waypoints, {times[-1]:.1f} s")


def main():
    chain = Chain(os.path.join(ROOT, "urdf", "wam.urdf"), 0.077)
    home, _ = chain.solve(*target(TO_VASE, 0.0), POSTURE, POSTURE, 400)
    out = follow(chain, TO_VASE, home)
    eye = follow(chain, THROUGH_EYE, home)
    per_leg = int(LEG / STEP)
    # Back from the vase without the way into the shelf: legs 5, 4 and 1 reversed.
    back = out[3 * per_leg:][::-1] + out[:per_leg + 1][::-1][1:]
    path = out + back[1:] + eye[1:] + eye[::-1][1:]
    write("wam_path.csv", chain, path, DURATIONS)
    write("cell_path.csv", chain, follow(chain, PICK, home), PICK_DURATIONS)


if __name__ == "__main__":
    main()
