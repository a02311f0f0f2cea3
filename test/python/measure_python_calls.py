#!/usr/bin/env python3
"""Times PairTracker.solve at 10,000 poses in one call beside the queries of distance_query at the same, in turn.

  measure_python_calls.py <folder of distance_query> <meshes/thesis> [--rounds 15]

The ratio is that of the least times of both, which other programs on the machine have disturbed least.
"""
import argparse
import csv
import os
import subprocess
import tempfile
import time

import concave_distance
import numpy as np

POSES = 10000


def random_poses():
    random = np.random.default_rng(1)
    quaternions = random.normal(size=(POSES, 4))
    quaternions /= np.linalg.norm(quaternions, axis=1)[:, None]
    return np.c_[random.uniform(-0.3, 0.3, (POSES, 2)), random.uniform(0.05, 0.6, POSES), quaternions]


def write_poses(path, poses):
    with open(path, "w", encoding="utf-8") as file:
        file.write("t,x,y,z,qx,qy,qz,qw\n")
        for index, pose in enumerate(poses):
            file.write(",".join([str(index)] + [repr(float(value)) for value in pose]) + "\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs")
    parser.add_argument("meshes")
    parser.add_argument("--rounds", type=int, default=15)
    options = parser.parse_args()
    files = [os.path.join(options.meshes, name) for name in ("fixture.stl", "battery.stl")]
    poses = random_poses()
    bodies = [concave_distance.load_body(file) for file in files]
    tracker = concave_distance.PairTracker(*bodies, name="distance_query", niches_wanted=False)
    calls, queries, runs = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        given, output = os.path.join(folder, "poses.csv"), os.path.join(folder, "out.csv")
        write_poses(given, poses)
        command = [os.path.join(options.programs, "distance_query"), "--mesh-a", files[0], "--mesh-b", files[1],
                   "--poses", given, "--output", output]
        for _ in range(options.rounds):
            start = time.perf_counter()
            answers = tracker.solve(poses)
            calls.append(time.perf_counter() - start)
            start = time.perf_counter()
            subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
            runs.append(time.perf_counter() - start)
            with open(output, encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            queries.append(sum(float(row["time_us"]) for row in rows) * 1e-6)
            if [float(row["distance"]) for row in rows] != answers.rows["distance"].tolist():
                raise SystemExit("the distances differ")
    call, query, run = (1e3 * min(times) for times in (calls, queries, runs))
    print("{} poses, {} rounds, equal distances; least: Python {:.1f} ms, queries of distance_query {:.1f} ms, all of "
          "distance_query {:.1f} ms; Python / queries {:.3f}".format(POSES, options.rounds, call, query, run,
                                                                    call / query))


if __name__ == "__main__":
    main()
