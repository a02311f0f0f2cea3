#!/usr/bin/python3
"""Batteries with more hole facets and fixtures with more protrusions, each with its partition by hand.

    scripts/generate_partition_family.py FOLDER [--hole-facets 6,12,20,40] [--protrusions 1,4,8,16,32]

Output: FOLDER/battery_<facets>.stl, battery_<facets>_pieces.obj (2 n + 2 pieces, Carretero, sec. 6.3.1) and
fixture_<protrusions>.stl, fixture_<protrusions>_pieces.obj (one piece more than protrusions). The first eight
protrusions are the thesis's; the others are low pegs on the plate in front of the battery's place, which the insertion
manoeuvre stays clear of. For test/benchmark/partition_benchmark.cpp. Deterministic.
"""
import argparse
import json
import os

from geometry import hand_partition, thesis_solids
from geometry.solid import write_binary_stl

HERE = os.path.dirname(os.path.abspath(__file__))
PEG_SIDE, PEG_SPACING, CLEARANCE = 0.024, 0.036, 0.01


def overlaps(low, high, base):
    xs, ys = [p[0] for p in base], [p[1] for p in base]
    return (low[0] < max(xs) + CLEARANCE and high[0] > min(xs) - CLEARANCE and
            low[1] < max(ys) + CLEARANCE and high[1] > min(ys) - CLEARANCE)


def pegs(protrusions, count):
    """Up to `count` pegs on a lattice in front of the battery, clear of the protrusions that are there."""
    found = []
    for column in range(25):
        for row in range(7):
            low = (-0.455 + column * PEG_SPACING, -0.5 + row * PEG_SPACING)
            high = (low[0] + PEG_SIDE, low[1] + PEG_SIDE)
            if len(found) == count:
                return found
            if any(overlaps(low, high, p["base"]) for p in protrusions):
                continue
            height = 0.015 + 0.002 * ((7 * column + 3 * row) % 11)
            found.append({"base": [low, (high[0], low[1]), high, (low[0], high[1])], "shoulder": height,
                          "tip": (low[0] + 0.4 * PEG_SIDE, low[1] + 0.55 * PEG_SIDE, height + 0.01)})
    if len(found) < count:
        raise SystemExit(f"there is room for {len(protrusions) + len(found)} protrusions at the most")
    return found


def write(folder, name, solid, pieces):
    vertices, triangles = solid.mesh()
    write_binary_stl(os.path.join(folder, name + ".stl"), vertices, triangles, f"concave_distance: {name}")
    hand_partition.write_pieces(os.path.join(folder, name + "_pieces.obj"), name, pieces)
    print(f"{name}: {len(triangles)} triangles, {len(pieces)} pieces")


def numbers(text):
    return [int(word) for word in text.split(",")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder")
    parser.add_argument("--hole-facets", type=numbers, default=[6, 12, 20, 40])
    parser.add_argument("--protrusions", type=numbers, default=[1, 4, 8, 16, 32])
    arguments = parser.parse_args()
    os.makedirs(arguments.folder, exist_ok=True)
    with open(os.path.join(HERE, "geometry", "thesis_scene.json"), encoding="utf-8") as stream:
        thesis = json.load(stream)["protrusions"]
    for sides in arguments.hole_facets:
        write(arguments.folder, f"battery_{sides}", thesis_solids.battery(sides), hand_partition.battery(sides))
    for count in arguments.protrusions:
        every = (thesis + pegs(thesis, max(0, count - len(thesis))))[:count]
        write(arguments.folder, f"fixture_{count}", thesis_solids.fixture(every), hand_partition.fixture(every))


if __name__ == "__main__":
    main()
