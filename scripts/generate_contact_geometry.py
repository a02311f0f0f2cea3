#!/usr/bin/python3
"""Writes meshes/contact/*.stl: the bodies of the contact scenes (doc/simulation.md).

    scripts/generate_contact_geometry.py [package folder]

Deterministic: a second run changes no byte.
"""

import os
import sys

from geometry import contact_solids
from geometry.solid import write_binary_stl


def main():
    root = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else os.path.dirname(
        os.path.dirname(os.path.abspath(__file__)))
    folder = os.path.join(root, "meshes", "contact")
    os.makedirs(folder, exist_ok=True)
    for make in (contact_solids.two_feet, contact_solids.holed_plate, contact_solids.press_fit_ring):
        solid = make()
        vertices, triangles = solid.mesh()
        write_binary_stl(os.path.join(folder, solid.name + ".stl"), vertices, triangles,
                         f"concave_distance: {solid.name}")
        print(solid.describe())


if __name__ == "__main__":
    main()
