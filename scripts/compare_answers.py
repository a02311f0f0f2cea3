#!/usr/bin/env python3
"""Compares the answers of two builds byte by byte, times aside.

    scripts/compare_answers.py BEFORE AFTER [--folder compare_answers] [--steps 40] [--skip evaluate]

BEFORE and AFTER are build folders; AFTER has the benchmarks, whose pairs are asked about: distance_query at every
level, cold and tracked, with niches and without, simulate on every scene of config/ with a section `simulation`, and
evaluate on every experiment in the size quick. Prints what differs; the exit status is 0 when nothing does.
"""
import argparse
import csv
import itertools
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

LEVELS = ("nodes", "refined", "certified")
TIMES = {"time_us", "microseconds"}


def program(build, name):
    for path in (os.path.join(build, "devel", "lib", "concave_distance", name),
                 os.path.join(build, "devel", "bin", name)):
        if os.path.exists(path):
            return path
    sys.exit("%s has no program %s: build it first" % (build, name))


def package_of(build):
    """The folder that a build was made from: keys of experiments and scenes may have other names there."""
    with open(os.path.join(build, "CMakeCache.txt")) as cache:
        for line in cache:
            if line.startswith("CMAKE_HOME_DIRECTORY:INTERNAL="):
                return line.split("=", 1)[1].strip()
    sys.exit(build + " is no build folder")


def run(command):
    build = command[0].split(os.sep + "devel" + os.sep)[0]
    environment = dict(os.environ, ROS_PACKAGE_PATH=package_of(build))
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
    return done.returncode, done.stdout


def without_times(path, in_any_order):
    """The cells of a CSV file but for times; the text of any other file. Runs of an experiment are written in the order
    in which threads finish them: there the order does not count."""
    with open(path, newline="") as stream:
        if not path.endswith(".csv"):
            return stream.read()
        rows = list(csv.reader(stream))
    if not rows:
        return rows
    kept = [place for place, name in enumerate(rows[0]) if name not in TIMES]
    cells = [[row[place] for place in kept if place < len(row)] for row in rows]
    return cells[:1] + sorted(cells[1:]) if in_any_order else cells


def compare_folders(before, after, in_any_order=False):
    """Names of files that differ or are missing on one side, each with the first difference."""
    differences = []
    for name in sorted(set(os.listdir(before)) | set(os.listdir(after))):
        paths = [os.path.join(folder, name) for folder in (before, after)]
        if not all(os.path.exists(path) for path in paths):
            differences.append("%s: only one build wrote it" % name)
            continue
        left, right = (without_times(path, in_any_order) for path in paths)
        if left == right:
            continue
        first = next((place for place, (l, r) in enumerate(zip(left, right)) if l != r), min(len(left), len(right)))
        differences.append("%s: differs from line %d on" % (name, first + 1))
    return differences


def queries(scenes, folder, build):
    names = sorted(name[:-len(".csv")] for name in os.listdir(scenes) if name.endswith(".csv"))
    for name, level, tracked, niches in itertools.product(names, LEVELS, (False, True), (False, True)):
        stem = os.path.join(folder, "%s_%s%s%s" % (name, level, "_tracked" * tracked, "_niches" * niches))
        command = [program(build, "distance_query"), "--mesh-a", os.path.join(scenes, name + "_a.stl"),
                   "--mesh-b", os.path.join(scenes, name + "_b.stl"), "--poses", os.path.join(scenes, name + ".csv"),
                   "--accuracy", level, "--cache", "off", "--output", stem + ".csv"]
        if tracked:
            command.append("--tracking")
        if niches:
            command += ["--niches-output", stem + "_list.csv"]
        yield command


def simulations(folder, build):
    config = os.path.join(package_of(build), "config")
    for name in sorted(os.listdir(config)):
        path = os.path.join(config, name)
        if not name.endswith(".yaml") or "\nsimulation:" not in "\n" + open(path).read():
            continue
        stem = os.path.join(folder, "simulate_" + name[:-len(".yaml")])
        yield [program(build, "simulate"), path, "--cache", "off", "--output", stem + ".csv", "--contacts",
               stem + "_contacts.csv", "--niches", stem + "_niches.csv"]


def evaluations(folder, build):
    experiments = os.path.join(package_of(build), "thesis", "experiments")
    if not os.path.isdir(experiments):
        experiments = os.path.join(package_of(build), "experiments")  # where they were up to version 0.1
    yield [program(build, "evaluate")] + sorted(os.path.join(experiments, name) for name in os.listdir(experiments)) \
        + ["--size", "quick", "--output", os.path.join(folder, "evaluate")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("--folder", default="compare_answers")
    parser.add_argument("--steps", type=int, default=40, help="poses of each pair")
    parser.add_argument("--skip", nargs="*", default=[], choices=["distance_query", "simulate", "evaluate"])
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    scenes = os.path.join(options.folder, "scenes")
    status, output = run([program(options.after, "write_benchmark_scenes"), "--all-meshes", "--steps",
                          str(options.steps), "--output", scenes])
    if status != 0:
        sys.exit("write_benchmark_scenes failed: " + output)
    differences = []
    for kind, commands in (("distance_query", lambda folder, build: queries(scenes, folder, build)),
                           ("simulate", simulations), ("evaluate", evaluations)):
        if kind in options.skip:
            continue
        folders = []
        for side, build in (("before", options.before), ("after", options.after)):
            folder = os.path.join(options.folder, side, kind)
            os.makedirs(folder, exist_ok=True)
            folders.append(folder)
            todo = list(commands(folder, build))
            with ThreadPoolExecutor(options.jobs if kind != "evaluate" else 1) as pool:
                for command, (status, output) in zip(todo, pool.map(run, todo)):
                    if status != 0:
                        differences.append("%s (%s): exit status %d: %s" % (kind, side, status, output.strip()[-300:]))
        if kind == "evaluate":
            folders = [os.path.join(folder, "evaluate") for folder in folders]
        found = compare_folders(*folders, in_any_order=kind == "evaluate")
        print("%s: %d files, %d differ" % (kind, len(os.listdir(folders[0])), len(found)), flush=True)
        differences += found
    for difference in differences:
        print("  " + difference)
    return 1 if differences else 0


if __name__ == "__main__":
    sys.exit(main())
