#!/usr/bin/python3
"""What `work_tolerance` costs and brings on config/peg_in_hole.yaml: doc/results/work_tolerance.csv.

    scripts/measure_work_tolerance.py [--simulate PROGRAM] [--output FILE]

A line each tolerance and tracking: steps, seconds of wall clock for a second of the scene, and how far the peg is from where it
is at the finest tolerance, at most and at the end, metres.
"""
import argparse
import csv
import math
import os
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOLERANCES = ("0.0005", "0.005", "0.05")


def places(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [[float(row["peg." + axis]) for axis in "xyz"] for row in csv.DictReader(file)]


def run(program, tolerance, tracking, folder):
    """Steps, seconds a second, places."""
    output = pathlib.Path(folder) / "peg.csv"
    command = [program, ROOT / "config" / "peg_in_hole.yaml", "--output", output, "--work-tolerance", tolerance, "--tracking",
               tracking]
    environment = dict(os.environ, ROS_PACKAGE_PATH=str(ROOT))
    said = subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout
    factor = float(re.search(r"real-time factor ([\d.]+)", said).group(1))
    return int(re.search(r"steps (\d+)", said).group(1)), 1.0 / factor, places(output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--simulate", default=ROOT / "build" / "devel" / "lib" / "concave_distance" / "simulate")
    parser.add_argument("--output", default=ROOT / "doc" / "results" / "work_tolerance.csv")
    arguments = parser.parse_args()
    finest = None
    with tempfile.TemporaryDirectory() as folder, open(arguments.output, "w", encoding="utf-8") as file:
        file.write("work_tolerance,tracking,steps,seconds_a_second,largest_difference,difference_at_the_end\n")
        for tolerance in TOLERANCES:
            for tracking in ("niches", "single_minimum"):
                steps, seconds, way = run(arguments.simulate, tolerance, tracking, folder)
                finest = finest or way
                differences = [math.dist(a, b) for a, b in zip(way, finest)]
                file.write(f"{tolerance},{tracking},{steps},{seconds:.3g},{max(differences):.3g},{differences[-1]:.3g}\n")


if __name__ == "__main__":
    main()
