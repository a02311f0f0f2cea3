#!/usr/bin/env python3
"""Compares the answers of two builds byte by byte, times aside.

    scripts/compare_answers.py BEFORE AFTER [--folder compare_answers] [--steps 40] [--skip evaluate]
                               [--except origin,niche] [--recall 8]

BEFORE and AFTER are build folders; AFTER has the benchmarks, whose pairs are asked about: distance_query at every
level, cold and tracked, with niches and without, simulate on every scene of config/ with a section `simulation`, and
evaluate on every experiment in the size quick. Prints what differs; the exit status is 0 when nothing does. Columns
named by --except are not compared. With --recall N, levels that prove nothing are not compared but judged, for N
seeds: a niche counts as found where both its points are within 5 % (`nodes`) or 1e-6 (`refined`) of the smaller
body's diameter; `recall` is the share of the certified niches that are found, `precision` the share of the reported
ones that are certified, each a mean over the poses of all pairs and, behind +-, its deviation over the seeds.
"""
import argparse
import csv
import itertools
import math
import os
import re
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

LEVELS = ("nodes", "refined", "certified")
UNPROVEN = {"nodes": 0.05, "refined": 1e-6}  # level: how far points may be apart, in diameters of the smaller body
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
    # Older builds keep prepared bodies in the user's cache.
    environment = dict(os.environ, ROS_PACKAGE_PATH=package_of(build), XDG_CACHE_HOME=os.path.join(build, "compared"))
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
    return done.returncode, done.stdout


def compared_cells(path, left_out, in_any_order):
    """The cells of a CSV file but for columns that are left out; the text of any other file. Runs of an experiment are written in the order
    in which threads finish them: there the order does not count."""
    with open(path, newline="") as stream:
        if not path.endswith(".csv"):
            return stream.read()
        rows = list(csv.reader(stream))
    if not rows:
        return rows
    kept = [place for place, name in enumerate(rows[0]) if name not in left_out]
    cells = [[row[place] for place in kept if place < len(row)] for row in rows]
    return cells[:1] + sorted(cells[1:]) if in_any_order else cells


def compare_folders(before, after, left_out, judged, in_any_order=False):
    """Names of files that differ or are missing on one side, each with the first difference."""
    differences = []
    for name in sorted(set(os.listdir(before)) | set(os.listdir(after))):
        if any("_" + level in name for level in judged):
            continue
        paths = [os.path.join(folder, name) for folder in (before, after)]
        if not all(os.path.exists(path) for path in paths):
            differences.append("%s: only one build wrote it" % name)
            continue
        left, right = (compared_cells(path, left_out, in_any_order) for path in paths)
        if left == right:
            continue
        first = next((place for place, (l, r) in enumerate(zip(left, right)) if l != r), min(len(left), len(right)))
        differences.append("%s: differs from line %d on" % (name, first + 1))
    return differences


def pair_names(scenes):
    return sorted(name[:-len(".csv")] for name in os.listdir(scenes) if name.endswith(".csv"))


def query(scenes, name, level, tracked, stem, niches, build):
    command = [program(build, "distance_query"), "--mesh-a", os.path.join(scenes, name + "_a.stl"),
               "--mesh-b", os.path.join(scenes, name + "_b.stl"), "--poses", os.path.join(scenes, name + ".csv"),
               "--accuracy", level, "--output", stem + ".csv"]
    return command + ["--tracking"] * tracked + ["--niches-output", stem + "_list.csv"] * niches


def queries(scenes, folder, build):
    for name, level, tracked, niches in itertools.product(pair_names(scenes), LEVELS, (False, True), (False, True)):
        stem = os.path.join(folder, "%s_%s%s%s" % (name, level, "_tracked" * tracked, "_niches" * niches))
        yield query(scenes, name, level, tracked, stem, niches, build)


def lists_of(path):
    """Of each pose, its niches: six coordinates of the points, and how far a segment or patch reaches from them."""
    lists = {}
    with open(path, newline="") as stream:
        for row in csv.DictReader(stream):
            lists.setdefault(row["index"], []).append(
                [float(row[name]) for name in ("ax", "ay", "az", "bx", "by", "bz")] + [0.5 * float(row["extent"] or 0)])
    return lists


def agree(niche, truth, tolerance, on_patch):
    tolerance += truth[6] * on_patch
    return math.dist(niche[:3], truth[:3]) <= tolerance and math.dist(niche[3:6], truth[3:6]) <= tolerance


def recall_and_precision(path, truth_path, tolerance, on_patch):
    """For each pose that has niches: the found share of the truth, and the right share of the list."""
    found, truth = lists_of(path), lists_of(truth_path)
    recalls = [sum(any(agree(other, niche, tolerance, on_patch) for other in found.get(pose, [])) for niche in niches)
               / len(niches) for pose, niches in truth.items()]
    precisions = [sum(any(agree(niche, other, tolerance, on_patch) for other in truth.get(pose, [])) for niche in niches)
                  / len(niches) for pose, niches in found.items()]
    return recalls, precisions


def smaller_diameters(scenes, names, build):
    """Diagonal of the smaller body's box, of each pair."""
    diameters = {}
    for name in names:
        diagonals = []
        for side in "ab":
            status, output = run([program(build, "mesh_tool"), "inspect", os.path.join(scenes, "%s_%s.stl" % (name, side))])
            size = re.search(r"^size \(m\): (.*)$", output, re.MULTILINE)
            if status != 0 or not size:
                sys.exit("mesh_tool inspect: " + output)
            diagonals.append(math.hypot(*map(float, size.group(1).split())))
        diameters[name] = min(diagonals)
    return diameters


def judge(scenes, folder, builds, seeds, jobs):
    """Prints recall and precision of the levels that prove nothing, of each build, with the noise of seeds."""
    names = pair_names(scenes)
    diameters = smaller_diameters(scenes, names, builds["after"])
    for (side, build), level, tracked in itertools.product(builds.items(), UNPROVEN, (False, True)):
        kept = os.path.join(folder, side, "seeds")
        os.makedirs(kept, exist_ok=True)
        means = []
        for seed in range(1, seeds + 1):
            todo, lists = [], []
            for name in names:
                stem = os.path.join(kept, "%s_%s%s_%d" % (name, level, "_tracked" * tracked, seed))
                todo.append(query(scenes, name, level, tracked, stem, True, build) + ["--seed", str(seed)])
                truth = os.path.join(folder, side, "distance_query", "%s_certified_niches_list.csv" % name)
                lists.append((stem + "_list.csv", truth, UNPROVEN[level] * diameters[name], level == "nodes"))
            with ThreadPoolExecutor(jobs) as pool:
                failed = [output for status, output in pool.map(run, todo) if status != 0]
            if failed:
                sys.exit(failed[0])
            shares = [recall_and_precision(*paths) for paths in lists]
            means.append([statistics.mean(statistics.mean(pair[part]) for pair in shares if pair[part])
                          for part in (0, 1)])
        recalls, precisions = zip(*means)
        print("%-6s %-8s %-7s recall %.4f +- %.4f, precision %.4f +- %.4f" % (
            side, level, "tracked" if tracked else "cold", statistics.mean(recalls), statistics.pstdev(recalls),
            statistics.mean(precisions), statistics.pstdev(precisions)), flush=True)


def simulations(folder, build):
    config = os.path.join(package_of(build), "config")
    for name in sorted(os.listdir(config)):
        path = os.path.join(config, name)
        if not name.endswith(".yaml") or "\nsimulation:" not in "\n" + open(path).read():
            continue
        stem = os.path.join(folder, "simulate_" + name[:-len(".yaml")])
        yield [program(build, "simulate"), path, "--output", stem + ".csv", "--contacts",
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
    parser.add_argument("--except", dest="left_out", default="", help="names of columns, separated by commas")
    parser.add_argument("--recall", type=int, default=0, help="seeds")
    options = parser.parse_args()
    left_out = TIMES | set(options.left_out.split(","))
    judged = UNPROVEN if options.recall else {}
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
        found = compare_folders(*folders, left_out, judged, in_any_order=kind == "evaluate")
        print("%s: %d files, %d differ" % (kind, len(os.listdir(folders[0])), len(found)), flush=True)
        differences += found
    for difference in differences:
        print("  " + difference)
    if options.recall:
        judge(scenes, options.folder, {"before": options.before, "after": options.after}, options.recall, options.jobs)
    return 1 if differences else 0


if __name__ == "__main__":
    sys.exit(main())
