#!/usr/bin/env python3
"""Writes the table of contact scenes in doc/results/engine_differences.md from engine_table.csv.

    scripts/write_engine_table.py [--table FILE] [--page FILE]

The table stands between the page's comments `engine table` and `end of engine table`. A cell is the figure that
was found and, in brackets, the seconds of wall clock for a second of the scene.
"""
import argparse
import csv
import os

RESULTS = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "doc", "results")
BEGIN, END = "<!-- engine table -->\n", "<!-- end of engine table -->\n"
ENGINES = {"concave_distance": "ours", "simbody": "Simbody", "simbody semi-explicit": "the same, semi-explicit",
           "ode 0.1 ms": "ODE, 0.1 ms", "ode 1 ms": "ODE, 1 ms", "bullet 0.1 ms": "Bullet, 0.1 ms",
           "bullet 1 ms": "Bullet, 1 ms"}


def cell(row):
    if row["found"]:
        text = f"{float(row['found']):.4g}"
    else:
        text = "not finished" if row["complete"] == "no" else "never"
    return f"{text} ({float(row['seconds_per_second']):.2g})"


def table(rows):
    lines = ["| scene | closed form | " + " | ".join(ENGINES.values()) + " |",
             "| --- | --- |" + " --- |" * len(ENGINES)]
    for scene in dict.fromkeys(row["scene"] for row in rows):
        of_scene = {row["engine"]: row for row in rows if row["scene"] == scene}
        first = next(iter(of_scene.values()))
        cells = [cell(of_scene[engine]) for engine in ENGINES]
        lines.append(f"| {scene.replace('_', ' ')}: {first['what']}, {first['unit']} | {float(first['expected']):.4g} | " +
                     " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--table", default=os.path.join(RESULTS, "engine_table.csv"))
    parser.add_argument("--page", default=os.path.join(RESULTS, "engine_differences.md"))
    arguments = parser.parse_args()
    with open(arguments.table, newline="") as file:
        text = table(list(csv.DictReader(file)))
    with open(arguments.page) as file:
        before, rest = file.read().split(BEGIN)
    after = rest.split(END)[1]
    with open(arguments.page, "w") as file:
        file.write(before + BEGIN + text + END + after)


if __name__ == "__main__":
    main()
