#!/usr/bin/python3
"""Measures distance_bag on the demo robot's motion and checks its rows (doc/bags.md).

    scripts/measure_bag.py [folder for the bags and rows]

Writes ten minutes at 100 Hz with scripts/write_robot_bag.py, answers them with one thread and with all, and a round of the
path at 50 Hz with niches. Fails unless every stamp is answered and both runs give the same bytes. Writes
doc/results/bags.csv and doc/images/bags.png; some minutes. Needs a build and python3-rosbag.
"""
import argparse
import csv
import hashlib
import os
import pathlib
import re
import resource
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(os.environ.get("CONCAVE_DISTANCE_BUILD_DIR", ROOT / "build"))
PROGRAM = BUILD / "devel/lib/concave_distance/distance_bag"
SCENE = ["--scene", ROOT / "config/robot.yaml", "--robot-description", ROOT / "urdf/wam.urdf"]
ROUND = 46.0  # s of config/wam_path.csv
LAST_LINE = re.compile(r": ([\d.]+) s in ([\d.]+) s, real-time factor ([\d.]+); (\d+) stamps, (\d+) rows, (\d+) distances")
COLUMNS = ["run", "threads", "seconds", "rate", "stamps", "answered_stamps", "rows", "distances", "wall_s", "factor",
           "cpu_s", "seconds_per_cpu_s", "digest"]


def write_bag(path, seconds, rate):
    subprocess.run([ROOT / "scripts/write_robot_bag.py", "--output", path, "--seconds", str(seconds), "--rate", str(rate)],
                   check=True)


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def answered_stamps(path):
    with open(path, newline="", encoding="utf-8") as stream:
        return len({row["stamp"] for row in csv.DictReader(stream) if row["distance"]})


def measure(name, bag, rows, seconds, rate, threads, further=()):
    before = cpu_seconds()
    ended = subprocess.run([PROGRAM, "--bag", bag, *SCENE, "--output", rows, "--threads", str(threads), *further],
                           stderr=subprocess.PIPE, universal_newlines=True, check=True)
    cpu = cpu_seconds() - before
    print(ended.stderr, end="", flush=True)
    _, wall, factor, stamps, row_count, distances = LAST_LINE.search(ended.stderr).groups()
    answered = answered_stamps(rows)
    if answered != round(seconds * rate):
        raise SystemExit("%s: %d of %d stamps are answered" % (name, answered, round(seconds * rate)))
    digest = hashlib.sha256(pathlib.Path(rows).read_bytes()).hexdigest()[:16]
    return [name, threads, seconds, rate, stamps, answered, row_count, distances, wall, factor, "%.1f" % cpu,
            "%.1f" % (seconds / cpu), digest]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, help="for the bags and rows; a temporary one by default")
    folder = parser.parse_args().folder or pathlib.Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    long_bag, round_bag = folder / "long.bag", folder / "round.bag"
    write_bag(long_bag, 600.0, 100.0)
    write_bag(round_bag, ROUND, 50.0)
    lines = [measure("distances", long_bag, folder / "d1.csv", 600.0, 100.0, 1),
             measure("distances", long_bag, folder / "d.csv", 600.0, 100.0, 0),
             measure("niches", round_bag, folder / "n.csv", ROUND, 50.0, 1,
                     ["--niches-output", folder / "niches.csv", "--plot", ROOT / "doc/images/bags.png"])]
    if lines[0][-1] != lines[1][-1]:
        raise SystemExit("one thread and several give other bytes")
    with open(ROOT / "doc/results/bags.csv", "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(lines)


if __name__ == "__main__":
    main()
