#!/usr/bin/env python3
"""Writes doc/results/contact_scenes.md: how the scenes of contact_scenes stand to their closed forms, before and now.

    scripts/write_contact_scenes.py [--before FILE] [--now FILE] [--output FILE]

Rows belong together by scene and figure. A row that is not in the file from before has no figure there: its
scene or its question is new. A row outside its bound has its reason from `scripts/contact_scenes_reasons.csv`; the script
fails after writing where one is missing, or where one is given that no row outside its bound needs.
"""
import argparse
import csv
import os
import re
import sys

SCRIPTS = os.path.dirname(os.path.abspath(__file__))
RESULTS = os.path.join(os.path.dirname(SCRIPTS), "doc", "results")
SPEED = "real-time factor"
VARIANT = re.compile("(_(none|bristle|regularised_coulomb|hunt_crossley|spring_dashpot|elastic_foundation|quasi_static|"
                     "defaults|bed|niches|exact|coarse|settled|[0-9]+(m|mm|_times_finer)?))+$")
HEAD = """# Scenes of contact beside closed forms

Read this to see how far the simulated contact can be trusted, and where it cannot. **{held} of {judged} figures and speeds are
within their bounds, {held_before} of {judged_before} were before;** {missed} are outside, and the tables say why. {cut} come from runs that were cut short after 6 s of wall clock.

![The errors of all figures over their bounds, before and now](../images/contact_scenes.png)

*Before* is one force, one normal and one depth per region; *now* is pressure over the surfaces of the overlap, implicit steps and exact
round solids. Every figure with its formula, expected value and bound: [contact_scenes.csv](contact_scenes.csv); the scenes:
`test/benchmark/contact_scenes.cpp`. `scripts/write_contact_scenes.py` writes this page from the two files of `contact_scenes --wall 6 --output FILE` (before: 60).
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


def outside(rows, before, reasons):
    """The figures outside their bounds."""
    lines = ["| scene | figure | expected | bound | before | now | reason |", "| --- | --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        reason = reasons.of(row)
        if row["what"] == SPEED or row["within"] != "no":
            continue
        unit = "" if row["unit"] == "1" else f", {row['unit']}"
        old = before.get((row["scene"], row["what"]))
        lines.append(f"| {row['scene']} | {row['what']}{unit} | {short(row['expected'])} | {short(row['bound'])} | "
                     f"{shown(old, 'found')} | {short(row['found'])} | {reason} |")
    return lines


def share_of_bound(row):
    """The error over its bound; -1 for a row without a bound, and for one that has to be exact."""
    bound = float(row["bound"] or "nan")
    return abs(float(row["error"] or "nan")) / bound if bound > 0 else -1.0


def count_within(rows):
    judged = [row for row in rows if row["within"] and row["what"] != SPEED]
    cut = sum(row["within"] == "cut" for row in judged)
    return f"{sum(row['within'] == 'yes' for row in judged)} of {len(judged)}" + f", {cut} cut" * (cut > 0) if judged else ""


def kind_of(scene):
    """A scene's name without the law, the friction and the size that it is repeated with."""
    return VARIANT.sub("", scene)


def scenes(rows, before):
    """A line for each kind of scene: how many figures are within their bounds, and which comes nearest to its bound."""
    lines = ["| scenes | within, before | within, now | nearest to its bound | error / bound |", "| --- | --- | --- | --- | --- |"]
    for scene in dict.fromkeys(kind_of(row["scene"]) for row in rows):
        own = [row for row in rows if kind_of(row["scene"]) == scene and row["what"] != SPEED and row["within"]]
        if not own:
            continue
        old = [row for (name, _), row in before.items() if kind_of(name) == scene]
        nearest = max(own, key=share_of_bound)
        share = share_of_bound(nearest)
        lines.append(f"| `{scene}` | {count_within(old)} | {count_within(own)} | {nearest['what'].split(';')[0].split(',')[0]} | "
                     f"{f'{share:.2g}' if share >= 0 else 'exact'} |")
    return lines


def speeds(rows, before, reasons):
    lines = ["| scene | wanted | before | now | reason |", "| --- | --- | --- | --- | --- |"]
    for row in rows:
        if row["what"] == SPEED:
            old = before.get((row["scene"], row["what"]))
            lines.append(f"| {row['scene']} | {short(row['expected'])} | {shown(old, 'found')} | {short(row['found'])} | "
                         f"{reasons.of(row)} |")
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
    judged, old = [[row for row in table if row["within"]] for table in (rows, list(before.values()))]
    lines = [HEAD.format(held=sum(row["within"] == "yes" for row in judged), judged=len(judged),
                         held_before=sum(row["within"] == "yes" for row in old), judged_before=len(old),
                         missed=sum(row["within"] == "no" for row in judged), cut=sum(row["within"] == "cut" for row in judged)),
             "## Outside their bounds", ""]
    lines += outside(rows, before, reasons)
    lines += ["", "## Every scene", ""]
    lines += scenes(rows, before)
    lines += ["", "## Simulated over processor time", ""]
    lines += speeds(rows, before, reasons)
    with open(options.output, "w") as file:
        file.write("\n".join(lines) + "\n")
    if reasons.wrong():
        sys.exit("\n".join([options.reasons + ":"] + reasons.wrong()))


if __name__ == "__main__":
    main()
