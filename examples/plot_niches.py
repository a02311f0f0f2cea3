#!/usr/bin/env python3
"""Draws the distance of a battery that is lowered into its fixture, and every other place where the two could touch.

  plot_niches.py picture.png       from this package's folder; needs python3-matplotlib
"""
import sys

import concave_distance as cd
import matplotlib.pyplot as plt
import numpy as np

fixture, battery = (cd.load_body("meshes/thesis/%s.stl" % name) for name in ("fixture", "battery"))
poses = np.tile([0.0, 0, 0.6, 0, 0, 0, 1], (100, 1))
poses[:, 2] -= np.linspace(0, 0.4, 100)
answers = cd.PairTracker(fixture, battery).update(poses, np.linspace(0, 1, 100))
rows = np.repeat(np.arange(100), np.diff(answers.niche_offsets))
plt.scatter(poses[rows, 2], answers.niches["distance"], s=2, c=answers.niches["id"], cmap="tab20")
plt.plot(poses[:, 2], answers.rows["distance"], "k")
plt.xlabel("height of the battery (m)"), plt.ylabel("distance (m)")
plt.savefig(sys.argv[1])
print("{} places in {} poses: {}".format(len(rows), len(poses), sys.argv[1]))
