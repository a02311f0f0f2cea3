#!/usr/bin/env python3
"""Writes doc/results/contact_scenes.md: how the scenes of contact_scenes stand to their closed forms.

    scripts/write_contact_scenes.py [--results FILE] [--output FILE]

A row outside its bound has its reason from REASONS below; the script fails after writing where one is missing, or where one is
given that no row outside its bound needs.
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
within their bounds;** {missed} are outside, and the tables say why. {cut} come from runs that were cut short after 6 s of wall clock.

![The errors of all figures over their bounds](../images/contact_scenes.png)

Every figure with its formula, expected value and bound: [contact_scenes.csv](contact_scenes.csv); the scenes:
`test/benchmark/contact_scenes.cpp`. `scripts/write_contact_scenes.py` writes this page from the file of `contact_scenes --wall 6 --output FILE`.
"""

REASONS = [  # scene, beginning of the figure, why it is outside its bound
    ('press_fit_force', 'push-out force; hunt_crossley',
     "a law of one place: the force of a ball pressed in, not of a ring around a peg; elastic_foundation has Lame's"),
    ('press_fit_force', 'push-out force; quasi_static',
     "a law of one place: the force of a ball pressed in, not of a ring around a peg; elastic_foundation has Lame's"),
    ('small_steel_ball', 'height of the tenth bounce',
     'the mesh meets the ground beside its centre and spins; ten times finer it is within (doc/effects.md)'),
    ('small_steel_ball', 'the same with what is spin',
     'on facets as large as the contact the patch changes its shape, and hertz has no potential there; ten times finer it is within'),
    ('twisting_boxes', 'spin left after half',
     'the boxes begin flush: until they have sunk in, little presses on them; twisting_boxes_settled, from rest, is within'),
    ('ball_on_vertex', 'how far a meshed ball rolls',
     'a mesh stands on one vertex, which no force holds; an exact ball stays'),
    ('peg_in_hole', 'real-time factor',
     'accuracy holds the steps: sites of contact come and go around the peg; see work_tolerance in peg_in_hole_coarse'),
    ('peg_in_hole_coarse', 'real-time factor',
     'finding the samples of the overlap takes 94 % of the time'),
    ('press_fit_released_hunt_crossley', 'real-time factor',
     "all of a hole's wall is in the region, and each step finds it again"),
    ('press_fit_released_spring_dashpot', 'real-time factor',
     "all of a hole's wall is in the region, and each step finds it again"),
    ('press_fit_released_elastic_foundation', 'real-time factor',
     "all of a hole's wall is in the region, and each step finds it again"),
    ('resting_box_defaults', 'real-time factor',
     'near the aim: above or below it by what else the machine does'),
    ('resting_box_bed', 'real-time factor',
     'near the aim: above or below it by what else the machine does'),
    ('stack_of_three_niches', 'real-time factor',
     'near the aim: above or below it by what else the machine does'),
    ('insertion', 'real-time factor',
     '17,000 of its 33,000 steps are in contact, as short as accuracy asks; 9.8 on a machine that did nothing else'),
    ('rolling_out_cylinder', 'way of a cylinder',
     'cut after 6 s of wall clock: rolling out takes 2.3 s of simulated time'),
    ('resting_box_niches', 'real-time factor',
     'near the aim: above or below it by what else the machine does'),
    ('elastic_bowl_1mm_none', 'largest kinetic energy in a bowl',
     'cut after 6 s of wall clock: 10 s are 60 swings of a ball of 1 mm; --wall 60 runs them'),
    ('elastic_bowl_1mm_bristle', 'largest kinetic energy in a bowl',
     'cut after 6 s of wall clock: 10 s are 60 swings, of which each loses 0.4 % to the bristles of a curved patch, with short steps too (doc/effects.md)'),
]


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
            scene, what, words = reason
            if row["scene"] == scene and row["what"].startswith(what):
                self.used.add(index)
                return words
        if row["within"] == "no":
            self.missing.append(f"{row['scene']}, {row['what']}: no reason")
        return ""

    def wrong(self):
        idle = [f"{scene}, {what}: a reason, but within its bound" for index, (scene, what, _) in enumerate(self.rows)
                if index not in self.used and what != SPEED]  # speeds change with the machine
        return self.missing + idle


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def short(text):
    if not text:
        return ""
    value = float(text)
    return "" if value != value else f"{value:.3g}"


def outside(rows, reasons):
    """The figures outside their bounds."""
    lines = ["| scene | figure | expected | bound | found | reason |", "| --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        reason = reasons.of(row)
        if row["what"] == SPEED or row["within"] != "no":
            continue
        unit = "" if row["unit"] == "1" else f", {row['unit']}"
        lines.append(f"| {row['scene']} | {row['what']}{unit} | {short(row['expected'])} | {short(row['bound'])} | "
                     f"{short(row['found'])} | {reason} |")
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


def scenes(rows):
    """A line for each kind of scene: how many figures are within their bounds, and which comes nearest to its bound."""
    lines = ["| scenes | within | nearest to its bound | error / bound |", "| --- | --- | --- | --- |"]
    for scene in dict.fromkeys(kind_of(row["scene"]) for row in rows):
        own = [row for row in rows if kind_of(row["scene"]) == scene and row["what"] != SPEED and row["within"]]
        if not own:
            continue
        nearest = max(own, key=share_of_bound)
        share = share_of_bound(nearest)
        lines.append(f"| `{scene}` | {count_within(own)} | {nearest['what'].split(';')[0].split(',')[0]} | "
                     f"{f'{share:.2g}' if share >= 0 else 'exact'} |")
    return lines


def speeds(rows, reasons):
    lines = ["| scene | wanted | found | reason |", "| --- | --- | --- | --- |"]
    for row in rows:
        if row["what"] == SPEED:
            lines.append(f"| {row['scene']} | {short(row['expected'])} | {short(row['found'])} | {reasons.of(row)} |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", default=os.path.join(RESULTS, "contact_scenes.csv"))
    parser.add_argument("--output", default=os.path.join(RESULTS, "contact_scenes.md"))
    options = parser.parse_args()
    rows = read(options.results)
    reasons = Reasons(REASONS)
    judged = [row for row in rows if row["within"]]
    lines = [HEAD.format(held=sum(row["within"] == "yes" for row in judged), judged=len(judged),
                         missed=sum(row["within"] == "no" for row in judged), cut=sum(row["within"] == "cut" for row in judged)),
             "## Outside their bounds", "", *outside(rows, reasons), "", "## Every scene", "", *scenes(rows),
             "", "## Simulated over processor time", "", *speeds(rows, reasons)]
    with open(options.output, "w") as file:
        file.write("\n".join(lines) + "\n")
    if reasons.wrong():
        sys.exit("\n".join(reasons.wrong()))


if __name__ == "__main__":
    main()
