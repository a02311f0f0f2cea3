#!/usr/bin/python3
"""Draws the figures of doc/results from its files: doc/images/proof_*.png, niche_*.png, level_costs.png, numerics.png,
contact_scenes.png; thesis/doc/images/manoeuvre.png.

    scripts/plot_results.py            (needs python3-matplotlib: scripts/install_dependencies.sh plot)
"""
import csv
import math
import pathlib
import re
import statistics

import matplotlib

from evaluation.manoeuvre import draw_manoeuvre, read_curves

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "doc" / "results"
IMAGES = ROOT / "doc" / "images"
BLUE, VERMILION = "#0072B2", "#D55E00"  # of Okabe and Ito
KERNEL_BOUND, WITNESS_BOUND, QUERY_BOUND = 32, 4, 64  # of doc/numerics.md, in the units of numerics.txt
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
    """How many times faster than FCL's plain distance, pair by pair, at 100 Hz along a motion."""
    ratios = {row["pair"]: float(row["fcl_over_certified"]) for row in rows if (row["kind"], row["queries"]) == ("front", "499")}
    figure, axes = plt.subplots(figsize=(8, 3.6))
    axes.plot(list(ratios.values()), range(len(ratios)), "o", color=BLUE)
    axes.set_yticks(range(len(ratios)), list(ratios), fontsize=8)
    axes.set_xscale("log")
    axes.set_xlabel("FCL's time / ours (medians), 100 Hz")
    axes.axvline(1, color="black", linewidth=0.8)
    axes.grid(axis="x", alpha=0.3)
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


def plot_levels(rows):
    """What a cycle takes at each level, medians of the pairs: exact answers (blue) beside approximate ones."""
    kinds = [("every niche, proven", "certified", "all niches", "exact, complete"), ("niches, perhaps not all", "refined", "all niches", ""),
             ("search on grid nodes", "nodes", "shipped", ""), ("the distance within 10 %", "certified", "tolerance 0.1", ""),
             ("the distance, proven", "certified", "tolerance 0", "exact"), ("FCL's distance", "FCL", "plain", "exact")]
    figure, axes = plt.subplots(figsize=(8, 3.2))
    for place, (label, method, setting, promise) in enumerate(kinds):
        of_kind = [row for row in rows if (row["method"], row["setting"], row["mode"]) == (method, setting, "tracked")]
        time = statistics.median(float(row["median_us"]) for row in of_kind)
        error = max(float(row["largest_error"]) for row in of_kind)
        axes.plot(time, place, "o", color=BLUE if promise else VERMILION)
        axes.text(1.25 * time, place, f"{time:.3g} us, " + (promise or f"error up to {error:.2g} of the diameter"), va="center", fontsize=8)
    axes.set_yticks(range(len(kinds)), [kind[0] for kind in kinds], fontsize=9)
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
            shares.append((f"triangles: {kernel[1]}", share, BLUE))
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


def plot_contact(rows):
    """How the errors of all figures of contact stand to their bounds."""
    figure, axes = plt.subplots(figsize=(8, 3.2))
    decades = list(range(-10, 7))
    shares = [abs(float(row["error"])) / float(row["bound"]) for row in rows
              if row["within"] and row["bound"] and float(row["bound"]) > 0 and row["error"] not in ("", "nan")]
    places = [min(max(math.floor(math.log10(share)) if share > 0 else decades[0], decades[0]), decades[-1]) for share in shares]
    axes.bar([decade + 0.5 for decade in decades], [places.count(decade) for decade in decades], 0.8, color=BLUE)
    axes.axvline(0, color="black", linewidth=1.5)
    axes.set_xticks(range(-10, 8, 2), [f"1e{power}" for power in range(-10, 8, 2)])
    axes.set_xlabel("error / bound (right of the line: outside)")
    axes.set_ylabel("figures")
    save(figure, "contact_scenes.png")


def main():
    IMAGES.mkdir(exist_ok=True)
    certificate = rows_of("certificate.csv")
    plot_speed(certificate)
    plot_steps(certificate)
    plot_scale(rows_of("scale.csv"))
    plot_recall(rows_of("budget.csv"), rows_of("budget_cold.csv"))
    plot_cycles(rows_of("front.csv"))
    plot_levels(rows_of("accuracy.csv"))
    plot_numerics()
    plot_contact(rows_of("contact_scenes.csv"))
    curves = read_curves(RESULTS / "manoeuvre.csv")
    if curves:  # of a build with CGAL
        draw_manoeuvre(curves, plt, MANOEUVRE)
        print(MANOEUVRE)


if __name__ == "__main__":
    main()
