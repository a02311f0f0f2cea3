#!/usr/bin/env python3
"""Writes doc/results/contact_scenes.md: the figures of contact_scenes before and now.

    scripts/write_contact_scenes.py [--before FILE] [--now FILE] [--output FILE]

Rows belong together by scene and figure. A row that is not in the file from before has no figure there: its
scene or its question is new. A row outside its bound has its reason from `scripts/contact_scenes_reasons.csv`; the script
fails after writing where one is missing, or where one is given that no row outside its bound needs.
"""
import argparse
import csv
import os
import sys

import provenance

SCRIPTS = os.path.dirname(os.path.abspath(__file__))
RESULTS = os.path.join(os.path.dirname(SCRIPTS), "doc", "results")
SPEED = "real-time factor"
VERDICTS = {"yes": "within", "no": "**not**", "cut": "cut short", "": ""}
HEAD = """# Scenes of contact, before and now

Written by `scripts/write_contact_scenes.py` from `contact_scenes_before.csv` and `contact_scenes.csv`, both by
`contact_scenes --wall 6 --output FILE` (before: 60). *Before* is one force, one normal and one depth per region; *now* pressure over
the surfaces of the overlap, implicit steps and exact round solids. Each figure stands beside its closed form or
bound; where a run was cut or failed before, its figure is that of its end. What the columns mean and what the
scenes are: `test/benchmark/contact_scenes.cpp`.
"""


class Reasons:
    """Why rows are outside their bounds, by scene and the beginning of the figure."""

    def __init__(self, rows):
        self.rows = rows
        self.used = set()
        self.missing = []

    def of(self, row):
        if row["within"] not in ("no", "cut"):
            return ""
        for index, reason in enumerate(self.rows):
            if row["scene"] == reason["scene"] and row["what"].startswith(reason["what"]):
                self.used.add(index)
                return reason["reason"]
        if row["within"] == "no":
            self.missing.append(f"{row['scene']}, {row['what']}: no reason")
        return ""

    def wrong(self):
        idle = [f"{row['scene']}, {row['what']}: a reason, but within its bound"
                for index, row in enumerate(self.rows)
                if index not in self.used and row["what"] != SPEED]  # speeds change with the machine
        return self.missing + idle


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def short(text):
    if not text:
        return ""
    value = float(text)
    return "" if value != value else f"{value:.3g}"


def shown(row, key):
    return short(row[key]) if row else ""


def figures(rows, before, reasons):
    lines = ["| scene | figure | expected | bound | before | now | | reason |",
             "| --- | --- | --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        if row["unit"] == "1" and row["what"] == SPEED:
            continue
        old = before.get((row["scene"], row["what"]))
        unit = "" if row["unit"] == "1" else f", {row['unit']}"
        lines.append(f"| {row['scene']} | {row['what']}{unit} ({row['formula']}) | {short(row['expected'])} | "
                     f"{short(row['bound'])} | {shown(old, 'found')} | {short(row['found'])} | "
                     f"{VERDICTS[row['within']]} | {reasons.of(row)} |")
    return lines


def speeds(rows, before, reasons):
    lines = ["| scene | wanted | before | now | steps | what held most of them | solve, effects, integration | reason |",
             "| --- | --- | --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        if row["what"] != SPEED:
            continue
        old = before.get((row["scene"], row["what"]))
        shares = ", ".join(f"{100 * float(row[key]):.0f} %" for key in
                           ("solve_share", "effects_share", "integration_share"))
        lines.append(f"| {row['scene']} | {short(row['expected'])} | {shown(old, 'found')} | {short(row['found'])} | "
                     f"{row['steps']} | {row['limited_by']} | {shares} | {reasons.of(row)} |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--before", default=os.path.join(RESULTS, "contact_scenes_before.csv"))
    parser.add_argument("--now", default=os.path.join(RESULTS, "contact_scenes.csv"))
    parser.add_argument("--output", default=os.path.join(RESULTS, "contact_scenes.md"))
    parser.add_argument("--reasons", default=os.path.join(SCRIPTS, "contact_scenes_reasons.csv"))
    options = parser.parse_args()
    before = {(row["scene"], row["what"]): row for row in read(options.before)}
    rows = read(options.now)
    reasons = Reasons(read(options.reasons))
    missed = sum(row["within"] == "no" for row in rows)
    held = sum(row["within"] == "yes" for row in rows)
    lines = [HEAD, f"{held} figures within their bounds, {missed} not.", "", "## Figures", ""]
    lines += figures(rows, before, reasons)
    lines += ["", "## Simulated over processor time", ""]
    lines += speeds(rows, before, reasons)
    with open(options.output, "w") as file:
        file.write("\n".join(lines) + "\n")
    if options.output == parser.get_default("output"):
        provenance.record([options.output])
    if reasons.wrong():
        sys.exit("\n".join([options.reasons + ":"] + reasons.wrong()))


if __name__ == "__main__":
    main()
