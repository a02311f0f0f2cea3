#!/usr/bin/python3
"""Draws the figures of doc/results from its CSV files: doc/images/proof_*.png, niche_*.png,
accuracy_*.png, stages.png; thesis/doc/images/manoeuvre.png.

    scripts/plot_results.py            (needs python3-matplotlib: scripts/install_dependencies.sh plot)
"""
import csv
import math
import pathlib

import matplotlib

from accuracy_plots import draw_budgets, draw_pairs, draw_summary
from manoeuvre import draw_manoeuvre, read_curves

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "doc" / "results"
IMAGES = ROOT / "doc" / "images"
MANOEUVRE = ROOT / "thesis" / "doc" / "images" / "manoeuvre.png"


def rows_of(name):
    with open(RESULTS / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def save(figure, name):
    figure.tight_layout()
    figure.savefig(IMAGES / name, dpi=110)
    plt.close(figure)
    print(f"doc/images/{name}")


def plot_speed(rows):
    """How many times faster than FCL's plain distance, pair by pair."""
    pairs = list(dict.fromkeys(row["pair"] for row in rows))
    kinds = [("cold", 2000, "cold"), ("near", 500, "cold, near contact"), ("seeded", 499, "seeded, 100 Hz"), ("front", 499, "front, 100 Hz"),
             ("front", 4999, "front, 1000 Hz")]
    figure, axes = plt.subplots(figsize=(11, 5))
    width = 0.8 / len(kinds)
    for place, (kind, queries, label) in enumerate(kinds):
        ratio = {row["pair"]: float(row["fcl_over_certified"]) for row in rows
                 if row["kind"] == kind and int(row["queries"]) == queries}
        axes.bar([i + (place - 0.5 * (len(kinds) - 1)) * width for i in range(len(pairs))], [ratio.get(pair, 0) for pair in pairs],
                 width, label=label)
    axes.set_yscale("log")
    axes.set_ylabel("FCL's time / ours (medians)")
    axes.set_xticks(range(len(pairs)), pairs, rotation=40, ha="right")
    axes.axhline(1, color="black", linewidth=0.8)
    axes.grid(axis="y", alpha=0.3)
    limit = {row["pair"]: float(row["fcl_us"]) / float(row["limit_us"]) for row in rows
             if row["kind"] == "front" and int(row["queries"]) == 499}
    axes.plot(range(len(pairs)), [limit.get(pair, math.nan) for pair in pairs], "k_", markersize=18,
              label="limit, 100 Hz")
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))
    axes.set_title("Proven distance against FCL's plain distance")
    save(figure, "proof_speed.png")


def plot_steps(rows):
    """The cost of a proof as steps become smaller."""
    figure, axes = plt.subplots(figsize=(9, 5))
    axes.set_prop_cycle(color=plt.get_cmap("tab20").colors)
    for pair in dict.fromkeys(row["pair"] for row in rows):
        points = sorted((int(row["queries"]), float(row["certified_us"])) for row in rows
                        if row["pair"] == pair and row["kind"] == "front")
        axes.plot([count + 1 for count, _ in points], [time for _, time in points], marker="o", label=pair)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("instants along the same motion")
    axes.set_ylabel("microseconds a proof (median, front kept)")
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.01, 1.0))
    axes.set_title("A proof as the steps become smaller")
    save(figure, "proof_steps.png")


def plot_scale(rows):
    figure, axes = plt.subplots(figsize=(7, 5))
    triangles = [int(row["triangles"]) for row in rows]
    for column, label in (("fcl_us", "FCL, plain"), ("cold_us", "proof, cold"), ("seeded_us", "proof, seeded"),
                          ("front_us", "proof, front kept"), ("tracked_us", "cycle with all niches, certified")):
        axes.plot(triangles, [float(row[column]) for row in rows], marker="o", label=label)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("triangles of each body")
    axes.set_ylabel("microseconds (median)")
    axes.grid(alpha=0.3)
    axes.legend()
    axes.set_title("Two bumpy rings, one passing close by the other")
    save(figure, "proof_scale.png")


def mean_recall(rows, proposer, share):
    """Budgets in microseconds, and the mean over the pairs of what is reported then."""
    budgets = sorted({float(row["budget_us"]) for row in rows})
    means = []
    for budget in budgets:
        recalls = [float(row["recall"]) for row in rows
                   if float(row["budget_us"]) == budget and row["proposer"] == proposer and float(row["share"]) == share]
        means.append(sum(recalls) / len(recalls))
    return budgets, means


def plot_recall(tracked, cold):
    """What a time budget leaves of the list of niches, with the search and without."""
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.5), sharey=True)
    for axes, rows, title in ((panels[0], tracked, "tracked at 100 Hz"), (panels[1], cold, "first cycles")):
        for pair in dict.fromkeys(row["pair"] for row in rows):
            of_pair = [row for row in rows if row["pair"] == pair]
            axes.plot(*mean_recall(of_pair, "none", 0.0), color="0.8", linewidth=1)
        for proposer, share, label in (("none", 0.0, "no search"), ("evolution", 0.05, "evolution, share 0.05"),
                                       ("random", 0.05, "random starts, share 0.05")):
            axes.plot(*mean_recall(rows, proposer, share), marker="o", label=label)
        axes.set_xscale("log")
        axes.set_xlabel("time budget of a cycle, microseconds")
        axes.set_title(f"{title}: mean of 12 pairs (grey: each, no search)")
        axes.grid(alpha=0.3)
    panels[0].set_ylabel("visible niches reported with their place")
    panels[1].legend(fontsize=9, loc="lower right")
    save(figure, "niche_recall.png")


def plot_cycles(rows):
    """All minima and which are niches, beside FCL's one distance."""
    pairs = list(dict.fromkeys(row["pair"] for row in rows))
    figure, axes = plt.subplots(figsize=(11, 4.5))
    for k, (steps, rate) in enumerate((("500", "100 Hz"), ("5000", "1 kHz"))):
        of_rate = {row["pair"]: row for row in rows if row["steps"] == steps}
        places = [i + (k - 0.5) * 0.35 for i in range(len(pairs))]
        bottom = [0.0] * len(pairs)
        for column, label, shade in (("front_us", "normal cones", 0), ("judge_us", "decisions", 1)):
            heights = [float(of_rate[pair][column]) / float(of_rate[pair]["fcl_us"]) for pair in pairs]
            axes.bar(places, heights, 0.32, bottom=bottom, color=plt.get_cmap("tab20")(2 * k + shade),
                     label=f"{rate}, {label}")
            bottom = [low + height for low, height in zip(bottom, heights)]
    axes.axhline(1.0, color="black", linewidth=1)
    axes.set_yscale("symlog", linthresh=1.0)
    axes.set_yticks([0, 0.25, 0.5, 0.75, 1, 2, 5, 10], ["0", "0.25", "0.5", "0.75", "1", "2", "5", "10"])
    axes.set_ylabel("median of a cycle / FCL's one distance")
    axes.set_xticks(range(len(pairs)), pairs, rotation=40, ha="right")
    axes.grid(axis="y", alpha=0.3)
    axes.legend(fontsize=8)
    save(figure, "niche_cycles.png")


def plot_accuracy(rows):
    draw_summary(rows, plt, IMAGES / "accuracy_summary.png")
    draw_pairs(rows, "cold", plt, IMAGES / "accuracy_cold.png")
    draw_pairs(rows, "tracked", plt, IMAGES / "accuracy_tracked.png")
    draw_budgets(rows, plt, IMAGES / "accuracy_budget.png")
    print("doc/images/accuracy_*.png")


def plot_stages(rows, message_rows):
    """Where the time of a warm cycle goes, and what it takes to tell its answer."""
    stages = [name for name in rows[0] if name not in ("pair", "level", "whole")] + ["messages", "markers"]
    told = {(row["pair"], row["level"]): row for row in message_rows}
    levels = ["nodes", "refined", "certified", "certified, distance alone"]
    pairs = list(dict.fromkeys(row["pair"] for row in rows))
    figure, axes = plt.subplots(figsize=(11, 5))
    ticks = []
    for i, pair in enumerate(pairs):
        for k, level in enumerate(levels):
            row = next(row for row in rows if row["pair"] == pair and row["level"] == level)
            tell = told[pair, level]
            row = {**row, "messages": float(tell["message"]) + float(tell["wire"]), "markers": tell["markers"]}
            place = i * (len(levels) + 1) + k
            ticks.append((place, level))
            bottom = 0.0
            for number, stage in enumerate(stages):
                axes.bar(place, float(row[stage]), bottom=bottom, color=plt.get_cmap("tab10")(number), width=0.8,
                         label=stage if place == 0 else None)
                bottom += float(row[stage])
        axes.text(i * (len(levels) + 1) + 1.5, -0.42, pair, ha="center", fontsize=9,
                  transform=axes.get_xaxis_transform())
    axes.set_xticks([place for place, _ in ticks], [level.replace("certified, ", "") for _, level in ticks], rotation=60, ha="right", fontsize=7)
    axes.set_ylabel("microseconds a warm cycle (mean)")
    axes.grid(axis="y", alpha=0.3)
    axes.legend(fontsize=8)
    save(figure, "stages.png")


def main():
    IMAGES.mkdir(exist_ok=True)
    certificate = rows_of("certificate.csv")
    plot_speed(certificate)
    plot_steps(certificate)
    plot_scale(rows_of("scale.csv"))
    plot_recall(rows_of("budget.csv"), rows_of("budget_cold.csv"))
    plot_cycles(rows_of("front.csv"))
    plot_accuracy(rows_of("accuracy.csv"))
    plot_stages(rows_of("stages.csv"), rows_of("messages.csv"))
    curves = read_curves(RESULTS / "manoeuvre.csv")
    if curves:  # of a build with CGAL
        draw_manoeuvre(curves, plt, MANOEUVRE)
        print(MANOEUVRE)


if __name__ == "__main__":
    main()
