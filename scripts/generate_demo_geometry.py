#!/usr/bin/python3
"""Writes meshes/demo/*.stl, the concave things of the robot and the interactive scene, and meshes/rows/clamp.stl.

    scripts/generate_demo_geometry.py [package folder]

Deterministic: a second run changes no byte.
"""

import os
import sys

from geometry import demo_solids
from geometry.solid import write_binary_stl


def main():
    root = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else os.path.dirname(
        os.path.dirname(os.path.abspath(__file__)))
    for make in (demo_solids.clamp, demo_solids.comb, demo_solids.crane, demo_solids.eye, demo_solids.hook,
                 demo_solids.pipe, demo_solids.shelf, demo_solids.vase):
        folder = os.path.join(root, "meshes", "rows" if make is demo_solids.clamp else "demo")
        os.makedirs(folder, exist_ok=True)
        vertices, triangles = make()
        name = make.__name__
        write_binary_stl(os.path.join(folder, name + ".stl"), vertices, triangles, f"concave_distance: {name}")
        print(f"{name}: {len(vertices)} vertices, {len(triangles)} triangles")


if __name__ == "__main__":
    main()
