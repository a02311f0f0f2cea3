#!/usr/bin/python3
"""Draws the figures of doc/results from its CSV files: doc/images/proof_*.png, niche_recall.png.

    scripts/plot_results.py            (needs python3-matplotlib: scripts/install_dependencies.sh plot)
"""
import csv
import math
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "doc" / "results"
IMAGES = ROOT / "doc" / "images"
RATES = {49: "10 Hz", 499: "100 Hz", 4999: "1000 Hz"}


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


def plot_recall(default, all_cones, tracking):
    """Recall of the tracked niches, and what a cycle costs beside FCL's one distance."""
    pairs = [row["pair"] for row in default]
    everything = {row["pair"]: row for row in all_cones}
    fcl = {row["pair"]: float(row["fcl_us"]) for row in tracking}
    figure, (above, below) = plt.subplots(2, 1, figsize=(11, 7.5), sharex=True)
    places = range(len(pairs))
    above.bar([i - 0.25 for i in places], [float(row["tracked_recall"]) for row in default], 0.25,
              label="defaults, prominence >= 1e-2")
    above.bar(places, [float(row["tracked_prominent_recall"]) for row in default], 0.25,
              label="defaults, prominence >= 5e-2")
    above.bar([i + 0.25 for i in places], [float(everything[pair]["tracked_recall"]) for pair in pairs], 0.25,
              label="all cones swept, >= 1e-2")
    above.set_ylabel("niches reported in the same cycle")
    below.plot(places, [fcl[pair] for pair in pairs], "k_", markersize=18, label="FCL, one distance")
    for rows, column, label in ((default, "cycle_ms", "all niches, defaults"),
                                ([everything[pair] for pair in pairs], "cycle_ms", "all niches, all cones swept"),
                                (default, "complete_ms", "level complete, anew")):
        below.plot(places, [1000 * float(row[column]) for row in rows], "o", label=label)
    below.set_yscale("log")
    below.set_ylabel("microseconds a cycle (mean)")
    below.set_xticks(list(places), pairs, rotation=40, ha="right")
    for axes in (above, below):
        axes.grid(axis="y", alpha=0.3)
        axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.01, 1.0))
    above.set_title("Tracked niches at 100 Hz")
    save(figure, "niche_recall.png")


def main():
    IMAGES.mkdir(exist_ok=True)
    certificate = rows_of("certificate.csv")
    plot_speed(certificate)
    plot_steps(certificate)
    plot_scale(rows_of("scale.csv"))
    plot_recall(rows_of("complete.csv"), rows_of("complete_all_cones.csv"), rows_of("tracking.csv"))


if __name__ == "__main__":
    main()
