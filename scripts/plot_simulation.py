#!/usr/bin/python3
"""Draws doc/images/simulation_*.png from what `simulate` wrote, and doc/results/two_feet.csv, the story of fig. 4.1.

    scripts/plot_simulation.py <folder of what `simulate` wrote, as in scripts/measure.sh>     (needs python3-matplotlib)
"""
import csv
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

ROOT = pathlib.Path(__file__).resolve().parent.parent
IMAGES = ROOT / "doc" / "images"
GRAVITY = 9.81


class Table:
    """The columns of a CSV file; empty cells are NaN."""

    def __init__(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            self.rows = list(csv.DictReader(file))

    def __getitem__(self, name):
        return [float(row[name]) if row[name] else math.nan for row in self.rows]


def save(figure, name):
    figure.tight_layout()
    figure.savefig(IMAGES / name, dpi=100)
    plt.close(figure)
    print(f"doc/images/{name}")


def spans(times, flags):
    """[begin, end] of every stretch where the flag is set."""
    found, begin = [], None
    for time, flag in zip(times, flags):
        if flag and begin is None:
            begin = time
        if not flag and begin is not None:
            found.append((begin, time))
            begin = None
    if begin is not None:
        found.append((begin, times[-1]))
    return found


def plot_energies(axes, table):
    t = table["t"]
    axes.plot(t, table["kinetic"], label="kinetic")
    axes.plot(t, table["gravity_potential"], label="gravity")
    axes.plot(t, table["normal_work"], label="work of normal forces")
    total = [k + g + d for k, g, d in zip(table["kinetic"], table["gravity_potential"], table["drive_potential"])]
    axes.plot(t, total, "k", linewidth=1, label="mechanical")
    axes.plot(t, [100 * e for e in table["balance_error"]], ":", color="grey", label="100 x balance error")
    axes.set_ylabel("energy, J")
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8, loc="lower left")


def plot_two_feet(folder):
    table, niches = Table(folder / "two_feet.csv"), Table(folder / "two_feet_niches.csv")
    contacts = Table(folder / "two_feet_contacts.csv")
    t = table["t"]
    feet = {}
    for time, niche, distance, x in zip(niches["t"], niches["id"], niches["distance"], niches["b_x"]):
        foot = "right" if x > 0 else "left"
        if time not in feet.setdefault(foot, {}) or distance < feet[foot][time]:
            feet[foot][time] = distance
    wrong = table["feet_ground.single_is_wrong"]
    figure, (top, middle, bottom) = plt.subplots(3, figsize=(9, 9), sharex=True)
    top.plot(t, table["two_feet.z"], label="height of the body's frame, m")
    tilt = [2.0 * math.atan2(y, w) for y, w in zip(table["two_feet.qy"], table["two_feet.qw"])]
    top.plot(t, tilt, label="tilt, rad (> 0: right foot lower)")
    top.grid(alpha=0.3)
    top.legend(fontsize=8)
    top.set_title("Fig. 4.1: the contact jumps from one foot to the other")
    for foot, colour in (("right", "tab:blue"), ("left", "tab:orange")):
        times = sorted(feet[foot])
        middle.plot(times, [1e3 * feet[foot][time] for time in times], color=colour, label=f"niche of the {foot} foot")
    middle.plot(t, [1e3 * d for d in table["feet_ground.single_distance"]], "k--", linewidth=1,
                label="single minimum, from the last cycle's")
    for begin, end in spans(t, wrong):
        middle.axvspan(begin, end, color="tab:red", alpha=0.15, label="single minimum is wrong" if begin == spans(t, wrong)[0][0] else None)
    middle.set_ylabel("distance, mm")
    middle.set_ylim(-1, 40)
    middle.grid(alpha=0.3)
    middle.legend(fontsize=8, loc="upper center")
    plot_energies(bottom, table)
    bottom.set_xlabel("t, s")
    save(figure, "simulation_two_feet.png")

    events = []
    for time, niche, x in zip(contacts["t"], contacts["id"], contacts["point_x"]):
        foot = "right" if x > 0 else "left"
        going = next((event for event in reversed(events) if event[1] == foot), None)
        if going is None or time - going[3] > 1.5e-3:
            going = [time, foot, int(niche), time]
            events.append(going)
        going[3] = time
    with open(ROOT / "doc" / "results" / "two_feet.csv", "w", encoding="utf-8") as file:
        file.write("from,until,what,niche\n")
        rows = [(begin, end, f"contact of the {foot} foot", niche) for begin, foot, niche, end in events]
        rows += [(begin, end, "single minimum is wrong", "") for begin, end in spans(t, wrong)]
        for begin, end, what, niche in sorted(rows):
            file.write(f"{begin:.4f},{end:.4f},{what},{niche}\n")
    print("doc/results/two_feet.csv")


def plot_ball(folder):
    table = Table(folder / "bouncing_ball.csv")
    figure, (top, bottom) = plt.subplots(2, figsize=(9, 6), sharex=True)
    top.plot(table["t"], table["ball.z"])
    top.set_ylabel("height of the centre, m")
    top.grid(alpha=0.3)
    top.set_title("A bouncing ball, Hunt and Crossley")
    plot_energies(bottom, table)
    bottom.set_xlabel("t, s")
    save(figure, "simulation_ball.png")


def plot_slope(folder):
    figure, axes = plt.subplots(figsize=(7, 4))
    for name, tilt in (("sticks", 0.35), ("slides", 0.55)):
        table = Table(folder / f"box_{name}.csv")
        t = table["t"]
        axes.plot(t, [x + 1.0 for x in table["box.x"]], label=f"slope of {tilt} rad: {name}")
        a = max(0.0, GRAVITY * (math.sin(tilt) - 0.45 * math.cos(tilt)))
        axes.plot(t[::10], [0.5 * a * s * s for s in t[::10]], "k.", markersize=3, label="Coulomb, closed form" if name == "slides" else None)
    axes.set_xlabel("t, s")
    axes.set_ylabel("way along the slope, m")
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    axes.set_title("Box on a slope, friction angle 0.423 rad")
    save(figure, "simulation_slope.png")


def plot_insertion(folder, scene, body, pair, title, name, target):
    table, contacts = Table(folder / f"{scene}.csv"), Table(folder / f"{scene}_contacts.csv")
    t = table["t"]
    figure, (top, middle, bottom) = plt.subplots(3, figsize=(9, 9), sharex=True)
    for axis in "xyz":
        top.plot(t, table[f"{body}.{axis}"], label=f"{axis}, m")
    for label, times, values in target:
        top.plot(times, values, "k--", linewidth=0.8, label=label)
    top.grid(alpha=0.3)
    top.legend(fontsize=8)
    top.set_title(title)
    middle.plot(contacts["t"], contacts["normal_force"], ".", markersize=3, label="normal force of each region")
    middle.plot(t, [-f for f in table[f"{body}.drive_fz"]], "k", linewidth=1, label="drive's push, -z")
    middle.set_ylabel("N")
    middle.grid(alpha=0.3)
    middle.legend(fontsize=8)
    bottom.plot(t, table[f"{pair}.niches"], label="niches")
    bottom.plot(t, table[f"{pair}.regions"], label="regions in contact")
    bottom.grid(alpha=0.3)
    bottom.legend(fontsize=8, loc="upper left")
    bottom.set_xlabel("t, s")
    save(figure, name)


def main():
    folder = pathlib.Path(sys.argv[1])
    IMAGES.mkdir(exist_ok=True)
    plot_two_feet(folder)
    plot_ball(folder)
    plot_slope(folder)
    plot_insertion(folder, "peg_in_hole", "peg", "peg_plate", "A tilted peg pushed into its hole", "simulation_peg.png",
                   [("z of the drive's target", [0.0, 1.5, 2.0], [0.065, -0.015, -0.015])])
    with open(ROOT / "meshes" / "thesis" / "manoeuvre_200.csv", newline="", encoding="utf-8") as file:
        path = list(csv.DictReader(file))
    plot_insertion(folder, "insertion_simulation", "battery", "battery_fixture",
                   "The battery pushed onto its pins along a path 36 mm off", "simulation_insertion.png",
                   [("z of the drive's target", [float(row["t"]) for row in path], [float(row["z"]) for row in path])])


if __name__ == "__main__":
    main()
