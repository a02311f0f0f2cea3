#!/usr/bin/env python3
"""The soak from outside (scripts/soak.sh starts it beside launch/soak.launch; doc/soak.md).

  soak.py --launch-pid PID --program DISTANCE_NODE --folder FOLDER [--minutes 180] [--output FILE] [--seed 1]
  soak.py --write-scene FILE      the scene of launch/soak.launch: config/cell.yaml with the camera of config/clouds.yaml

Subscribes as five users do, edits the scene at random, and writes a row for every minute:
  minute, time (UTC); node_mb, bridge_mb, guard_mb: largest VmRSS; cycles, late, failed, largest_cycle_ms: the node's own
  diagnostics; messages, gaps: of `distances`, and how often more than two periods passed between two, as this program
  saw it; compared, different, unfinished, unsolved, largest_difference (m), cloud_pairs: pairs beside a fresh node's answers;
  lists, lists_different, lists_open: of niches, and those that were not complete; failed_comparisons; ids, ids_lost: of
  niches that began; edits, refused, nonsense, taken, lost: requests by service, good ones that were refused, bad ones that
  were not, and calls that got no answer; moves, diffs: messages of scene_moves and of the planning scene; errors: in
  rosout; restarts: since the beginning; voxels; bags_mb; node_cores, all_cores: processor time over real time; load.
The last lines say what has to hold; the status is 0 when all of it does.
"""

import argparse
import csv
import os
import sys
import time
from datetime import datetime, timezone

import rospy
import yaml

PACKAGE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..")
sys.path.insert(0, os.path.join(PACKAGE, "scripts", "soak"))

NODES = {"node": "/concave_distance", "bridge": "/moveit_bridge", "guard": "/velocity_guard"}
RATE = 50.0              # Hz, of launch/soak.launch
EDIT_PERIOD = 0.5        # s
CAMERA = {"voxel_size": 0.05, "range": 2.6, "stale_after": 8.0}    # some 1,000 voxels; it rests for a comparison
CUTOFF = 0.15            # m, beyond constraint_distance of launch/soak.launch
LONGEST_START = 120.0    # s
PAIR_TOPICS = (("wam7/shelf_board_3", "b"), ("wam6/crate_front", "b"), ("wam7/camera", None))
COLUMNS = ["minute", "time", "node_mb", "bridge_mb", "guard_mb", "cycles", "late", "failed", "largest_cycle_ms", "messages",
           "gaps", "compared", "different", "unfinished", "unsolved", "largest_difference", "cloud_pairs", "lists", "lists_different",
           "lists_open", "failed_comparisons", "ids", "ids_lost", "edits", "refused", "nonsense", "taken", "lost", "moves",
           "diffs", "errors", "restarts", "voxels", "bags_mb", "node_cores", "all_cores", "load"]


def write_scene(path):
    scenes = []
    for name in ("cell", "clouds"):
        with open(os.path.join(PACKAGE, "config", name + ".yaml"), encoding="utf-8") as stream:
            scenes.append(yaml.safe_load(stream))
    cell, clouds = scenes
    cell["clouds"] = clouds["clouds"]
    cell["clouds"][0].update(CAMERA)
    cell["defaults"]["cutoff"] = CUTOFF
    cell["pairs"].append({"between": ["arm", cell["clouds"][0]["name"]]})
    with open(path, "w", encoding="utf-8") as stream:
        yaml.safe_dump(cell, stream)


class Soak:
    def __init__(self, options):
        from edits import Edits
        from fresh import Comparer
        from listeners import KEPT, PairTopic, Reports, Stream
        from processes import Processes
        self.options = options
        self.bags = os.path.join(options.folder, "bags")
        self.distances = Stream("concave_distance/distances", 1.0 / RATE, KEPT)
        self.others = [Stream("concave_distance/" + topic) for topic in ("nearest", "markers", "constraints")]
        self.camera = Stream("camera/points", kept=5)
        self.pair_topics = [PairTopic(pair, rests) for pair, rests in PAIR_TOPICS]
        self.reports = Reports(quiet=("/soak_fresh",))
        self.edits = Edits(options.seed)
        self.comparer = Comparer(options.program, options.folder, self.distances, self.camera, self.pair_topics,
                                 self.reports)
        self.wait_for_all()
        self.processes = Processes(NODES, options.launch_pid)

    def wait_for_all(self):
        end = time.monotonic() + LONGEST_START
        while not all(stream.count for stream in [self.distances, self.camera] + self.others):
            if time.monotonic() > end or rospy.is_shutdown():
                sys.exit("soak: not all topics have come within %d s" % LONGEST_START)
            time.sleep(0.2)

    def minute(self, number, began):
        """Edits, one comparison in the middle, and what was seen until the minute is over."""
        from fresh import Comparison
        ends = began + 60.0 * number
        compares_at = ends - 30.0
        comparison = None
        last = time.monotonic()
        while time.monotonic() < ends and not rospy.is_shutdown():
            if comparison is None and time.monotonic() >= compares_at:
                self.edits.rest()
                comparison = self.comparer.compare()
            self.edits.step()
            time.sleep(max(0.0, min(EDIT_PERIOD, ends - time.monotonic())))
        return self.row(number, comparison or Comparison(), time.monotonic() - last)

    def row(self, number, comparison, seconds):
        memory, used, used_by_all, restarts = self.processes.take()
        cycles, largest_ms, voxels, errors = self.reports.take()
        messages, gaps = self.distances.take()
        ids = [topic.ids.take() for topic in self.pair_topics]
        counts = self.edits.take()
        row = {name + "_mb": "%.1f" % value for name, value in memory.items()}
        row.update({name: counts[name] for name in ("edits", "refused", "nonsense", "taken", "lost", "moves", "diffs")})
        row.update({name: getattr(comparison, name) for name in ("different", "unfinished", "unsolved", "cloud_pairs", "lists",
                                                                 "lists_different", "lists_open")})
        row.update(
            minute=number, time=datetime.now(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"), cycles=cycles["cycles"],
            late=cycles["late cycles"], failed=cycles["failed cycles"], largest_cycle_ms="%.2f" % largest_ms,
            messages=messages, gaps=gaps, compared=comparison.pairs, largest_difference="%.3g" % comparison.largest,
            failed_comparisons=int(not comparison.pairs), ids=sum(one[0] for one in ids), ids_lost=sum(one[1] for one in ids),
            errors=errors, restarts=restarts, voxels=voxels, bags_mb="%.1f" % self.bag_megabytes(),
            node_cores="%.2f" % (used["node"] / seconds), all_cores="%.2f" % (used_by_all / seconds),
            load="%.1f" % os.getloadavg()[0])
        self.explain(row, comparison)
        return row

    def explain(self, row, comparison):
        """Prints what is behind the numbers that should be 0."""
        words = list(comparison.differences) + ([comparison.failed] if comparison.failed else [])
        for topic in self.pair_topics:
            words += [topic.pair + ": " + reason for reason in topic.ids.reasons]
            topic.ids.reasons.clear()
        words += self.edits.reasons
        self.edits.reasons.clear()
        if row["errors"]:
            words.append(self.reports.last_error)
        for word in words:
            print("  minute %d: %s" % (row["minute"], word[:1000]))

    def bag_megabytes(self):
        return sum(os.path.getsize(os.path.join(self.bags, name)) for name in os.listdir(self.bags)) / 2.0 ** 20

    def run(self):
        rows = []
        began = time.monotonic()
        with open(self.options.output, "w", newline="", encoding="utf-8") as stream:
            writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
            writer.writeheader()
            for number in range(1, self.options.minutes + 1):
                rows.append(self.minute(number, began))
                if rospy.is_shutdown():
                    break
                writer.writerow(rows[-1])
                stream.flush()
                print(" ".join("%s=%s" % item for item in rows[-1].items()), flush=True)
        self.processes.end()
        return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--write-scene")
    parser.add_argument("--launch-pid", type=int)
    parser.add_argument("--program")
    parser.add_argument("--folder")
    parser.add_argument("--minutes", type=int, default=180)
    parser.add_argument("--output", default="soak.csv")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if options.write_scene:
        write_scene(options.write_scene)
        return 0
    from verdict import verdict
    rospy.init_node("soak")
    rows = Soak(options).run()
    if len(rows) < options.minutes:
        return 1
    lines = verdict(rows)
    for line, is_right in lines:
        print(("as it should be  " if is_right else "NOT AS IT SHOULD ") + line)
    return 0 if all(is_right for _, is_right in lines) else 1


if __name__ == "__main__":
    sys.exit(main())
