#!/usr/bin/env python3
"""Refines bodies of meshes/ with mesh_tool, merges their coplanar triangles and writes what is left.

    scripts/measure_simplify.py [--output simplify.csv] [--tolerance 2e-6]      (needs a finished build)

A row: triangles of the file, of the file simplified, of the file refined to edges of a fortieth of its diagonal, and of that simplified;
the relative change of volume and area that the last step made.
"""
import argparse
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BODIES = [*(f"thesis/{name}.stl" for name in ("box", "notched_box", "semi_extruded", "grooved_cylinder", "battery", "fixture")),
          *(f"kr5/{name}.stl" for name in ("base_link", "shoulder", "bicep", "elbow", "forearm", "wrist", "palm")),
          *(f"wam/wam{number}.stl" for number in (1, 3, 5, 7)), *(f"wam/wam{number}_collision.stl" for number in (1, 3, 5, 7)),
          "demo/shelf.stl", "demo/comb.stl"]
COLUMNS = ["body", "triangles", "simplified", "refined", "refined_simplified", "volume_change", "area_change"]


def run(tool, *arguments):
    done = subprocess.run([str(tool), *map(str, arguments)], check=True, stdout=subprocess.PIPE, universal_newlines=True)
    return done.stdout


def written(output):
    return int(re.search(r"written: \d+ vertices, (\d+) triangles", output)[1])


def inspected(tool, path):
    """Triangles, area, volume (none of an open mesh) and diagonal."""
    text = run(tool, "inspect", path)
    size = [float(word) for word in re.search(r"size \(m\): (.*)", text)[1].split()]
    volume = re.search(r"volume \(m\^3\): ([-\d.e]+)", text)
    return (int(re.search(r"repaired: \d+ vertices, (\d+)", text)[1]), float(re.search(r"area \(m\^2\): (.*)", text)[1]),
            float(volume[1]) if volume else None, sum(length * length for length in size) ** 0.5)


def measure(tool, body, folder, tolerance):
    mesh, fine, coarse = ROOT / "meshes" / body, folder / "fine.ply", folder / "coarse.ply"
    triangles, _, _, diagonal = inspected(tool, mesh)
    simplified = written(run(tool, "simplify", mesh, coarse))
    refined = written(run(tool, "refine", mesh, fine, "--max-edge", diagonal / 40))
    refined_simplified = written(run(tool, "simplify", fine, coarse, "--tolerance", tolerance))
    (_, area, volume, _), (_, area_after, volume_after, _) = inspected(tool, fine), inspected(tool, coarse)
    return [body, triangles, simplified, refined, refined_simplified,
            "" if volume is None or volume_after is None else f"{volume_after / volume - 1:.1e}", f"{area_after / area - 1:.1e}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", default="simplify.csv", type=pathlib.Path)
    parser.add_argument("--tolerance", default="2e-6", help="of the refined files")
    options = parser.parse_args()
    tool = next((path for path in sorted((ROOT / "build").rglob("mesh_tool")) if path.is_file()), None)
    if tool is None:
        sys.exit("mesh_tool is not built: run scripts/build.sh")
    with tempfile.TemporaryDirectory() as folder, open(options.output, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for body in BODIES:
            writer.writerow(measure(tool, body, pathlib.Path(folder), options.tolerance))
            file.flush()
    print(options.output)


if __name__ == "__main__":
    main()
