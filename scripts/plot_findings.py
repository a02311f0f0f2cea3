#!/usr/bin/python3
"""Draws the pictures of findings from their results: doc/images/level_costs.png, numerics.png, contact_scenes.png.

    scripts/plot_findings.py           (needs python3-matplotlib: scripts/install_dependencies.sh plot)
"""
import csv
import math
import pathlib
import re
import statistics

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "doc" / "results"
IMAGES = ROOT / "doc" / "images"
BEFORE, NOW = "#D55E00", "#0072B2"  # Okabe and Ito's vermilion and blue
KERNEL_BOUND, WITNESS_BOUND, QUERY_BOUND = 32, 4, 64  # of doc/numerics.md, in the units of numerics.txt


def rows_of(name):
    with open(RESULTS / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def save(figure, name):
    figure.tight_layout()
    figure.savefig(IMAGES / name, dpi=90)
    plt.close(figure)


def plot_levels():
    """What a cycle takes at each level, in the middle of the pairs: exact answers beside approximate ones."""
    kinds = [("FCL's distance", "FCL", "plain", "exact", "0.35"), ("the distance, proven", "certified", "tolerance 0", "exact", NOW),
             ("the distance within 10 %", "certified", "tolerance 0.1", "", BEFORE), ("search on grid nodes", "nodes", "shipped", "", BEFORE),
             ("niches, perhaps not all", "refined", "all niches", "", BEFORE), ("every niche, proven", "certified", "all niches", "exact, complete", NOW)]
    figure, axes = plt.subplots(figsize=(8, 3.2))
    for place, (label, method, setting, promise, colour) in enumerate(reversed(kinds)):
        rows = [row for row in rows_of("accuracy.csv") if (row["method"], row["setting"], row["mode"]) == (method, setting, "tracked")]
        time = statistics.median(float(row["median_us"]) for row in rows)
        error = max(float(row["largest_error"]) for row in rows)
        axes.barh(place, time, color=colour)
        axes.text(1.08 * time, place, f"{time:.3g} us, " + (promise or f"error up to {error:.2g} of the diameter"), va="center", fontsize=8)
    axes.set_yticks(range(len(kinds)), [kind[0] for kind in reversed(kinds)], fontsize=9)
    axes.set_xscale("log")
    axes.set_xlim(1, 2e4)
    axes.set_xlabel("microseconds a cycle, tracked at 40 Hz, median of the pairs")
    save(figure, "level_costs.png")


def plot_numerics():
    """The worst error of each family of hard cases as a share of its bound."""
    shares = []
    for line in (RESULTS / "numerics.txt").read_text(encoding="utf-8").splitlines():
        kernel = re.fullmatch(r"worst: (.+) distance ([\d.]+) witness ([\d.]+)", line)
        query = re.fullmatch(r"worst: (\w+)/HardCase/(\w+) ([\d.]+) .*", line)
        if kernel:
            share = max(float(kernel[2]) / KERNEL_BOUND, float(kernel[3]) / WITNESS_BOUND)
            shares.append((f"triangles: {kernel[1]}", share, NOW))
        elif query:
            name = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", query[1]).lower()
            shares.append((f"queries, {query[2]}: {name}", float(query[3]) / QUERY_BOUND, "#009E73"))
    shares.reverse()
    figure, axes = plt.subplots(figsize=(8, 4.2))
    axes.barh(range(len(shares)), [share for _, share, _ in shares], color=[colour for *_, colour in shares])
    axes.set_yticks(range(len(shares)), [name for name, *_ in shares], fontsize=8)
    axes.axvline(1, color="black", linewidth=1.5)
    axes.set_xlim(0, 1.05)
    axes.set_xlabel("worst error seen / bound that is promised (line: the bound)")
    axes.grid(axis="x", alpha=0.3)
    save(figure, "numerics.png")


def plot_contact():
    """How the errors of all figures of contact stand to their bounds."""
    figure, axes = plt.subplots(figsize=(8, 3.2))
    decades = list(range(-10, 7))
    for name, colour, label, shift in (("contact_scenes_before.csv", BEFORE, "before", -0.2), ("contact_scenes.csv", NOW, "now", 0.2)):
        shares = [abs(float(row["error"])) / float(row["bound"]) for row in rows_of(name)
                  if row["within"] and row["bound"] and float(row["bound"]) > 0 and row["error"] not in ("", "nan")]
        places = [min(max(math.floor(math.log10(share)) if share > 0 else decades[0], decades[0]), decades[-1]) for share in shares]
        axes.bar([decade + 0.5 + shift for decade in decades], [places.count(decade) for decade in decades], 0.38, color=colour, label=label)
    axes.axvline(0, color="black", linewidth=1.5)
    axes.set_xticks(range(-10, 8, 2), [f"1e{power}" for power in range(-10, 8, 2)])
    axes.set_xlabel("error / bound (right of the line: outside)")
    axes.set_ylabel("figures")
    axes.legend()
    save(figure, "contact_scenes.png")


def main():
    plot_levels()
    plot_numerics()
    plot_contact()


if __name__ == "__main__":
    main()
