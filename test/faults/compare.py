#!/usr/bin/env python3
"""Compares the results of two runs of scripts/faults.sh, group by group, as a Markdown table.

    test/faults/compare.py BEFORE AFTER

BEFORE and AFTER: what --results wrote. An attack that only one run has counts in that run alone.
"""
import collections
import csv
import sys


def results_of(path):
    """Whether each attack passed."""
    with open(path, newline="") as stream:
        return {row["attack"]: row["passed"] == "1" for row in csv.DictReader(stream)}


def counts_of(results):
    """Passed and all attacks of each group, in the order of the run."""
    counts = collections.OrderedDict()
    for attack, passed in results.items():
        count = counts.setdefault(attack.split("/")[0], [0, 0])
        count[0] += passed
        count[1] += 1
    return counts


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    before, after = (counts_of(results_of(path)) for path in sys.argv[1:])
    print("| group | before | after |\n|---|---|---|")
    none = [0, 0]
    groups = list(after) + [group for group in before if group not in after]
    for group in groups:
        print("| %s | %d of %d | %d of %d |" % ((group,) + tuple(before.get(group, none)) + tuple(after.get(group, none))))
    totals = [sum(count[place] for count in counts.values()) for counts in (before, after) for place in (0, 1)]
    print("| all | %d of %d | %d of %d |" % tuple(totals))


if __name__ == "__main__":
    main()
