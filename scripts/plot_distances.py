#!/usr/bin/env python3
"""Draws the rows that distance_bag writes: the distance of each pair over time.

    rosrun concave_distance plot_distances.py d.csv --output d.png [--pairs N] [--title TEXT]

The N pairs that come nearest (10) have a colour and a name, the others are grey. A line has a gap where the pair has no
answer, and where its stamps are more than a second and five times their usual step apart; crosses at 0 are overlaps.
"""
import argparse
import array
import csv
import sys

GAP_STEPS = 5.0
LEAST_GAP = 1.0  # s


class Line:
    """One pair: times and distances, NaN where a gap begins."""

    def __init__(self):
        self.times = array.array("d")
        self.distances = array.array("d")
        self.overlaps = array.array("d")

    def add(self, time, distance, is_overlap):
        self.times.append(time)
        self.distances.append(distance)
        if is_overlap:
            self.overlaps.append(time)

    def nearest(self):
        return min((d for d in self.distances if d == d), default=float("inf"))


def seconds_since(stamp, first):
    """Of texts with nine decimals: a float has too few digits for nanoseconds since 1970."""
    whole, _, part = stamp.partition(".")
    first_whole, _, first_part = first.partition(".")
    return int(whole) - int(first_whole) + (int(part) - int(first_part)) * 1e-9


def read_lines(path):
    """{pair: Line} in seconds after the first row."""
    lines = {}
    with open(path, newline="", encoding="utf-8") as stream:
        rows = csv.reader(stream)
        header = next(rows, [])
        missing = [name for name in ("stamp", "pair", "status", "distance") if name not in header]
        if missing:
            raise SystemExit("plot_distances.py: %s: there is no column %s (name a file that distance_bag has written)"
                             % (path, ", ".join(missing)))
        stamp_at, pair_at, status_at, distance_at = (header.index(name) for name in ("stamp", "pair", "status", "distance"))
        first = None
        for row in rows:
            first = first or row[stamp_at]
            line = lines.setdefault(row[pair_at], Line())
            distance = float(row[distance_at]) if row[distance_at] else float("nan")
            line.add(seconds_since(row[stamp_at], first), distance, row[status_at] == "penetrating")
    return lines


def with_gaps(line, np):
    times, distances = np.array(line.times), np.array(line.distances)
    order = np.argsort(times, kind="stable")
    times, distances = times[order], distances[order]
    steps = np.diff(times)
    if steps.size == 0:
        return times, distances
    behind = np.flatnonzero(steps > max(LEAST_GAP, GAP_STEPS * float(np.median(steps)))) + 1
    return np.insert(times, behind, times[behind - 1]), np.insert(distances, behind, np.nan)


def counted(count, of_one, of_more):
    return "%d %s" % (count, of_one if count == 1 else of_more)


def draw(lines, options):
    import matplotlib
    matplotlib.use("Agg")
    import numpy as np
    from matplotlib import pyplot

    named = sorted(lines, key=lambda pair: (lines[pair].nearest(), pair))
    answered = [pair for pair in named if lines[pair].nearest() < float("inf")]
    figure, axes = pyplot.subplots(figsize=(11, 5.5))
    colours = pyplot.get_cmap("tab20" if options.pairs > 10 else "tab10")
    others = answered[options.pairs:]
    for pair in others:
        axes.plot(*with_gaps(lines[pair], np), color="0.8", linewidth=0.7, zorder=1)
    for place, pair in enumerate(answered[:options.pairs]):
        line, colour = lines[pair], colours(place % colours.N)
        times, distances = with_gaps(line, np)
        axes.plot(times, distances, color=colour, linewidth=1.3, label=pair, zorder=2,
                  marker="o" if len(line.times) == 1 else None, markersize=3)
        if line.overlaps:
            axes.plot(np.array(line.overlaps), np.zeros(len(line.overlaps)), "x", color=colour, zorder=3)
    if others:
        axes.plot([], [], color="0.8", label=counted(len(others), "pair stays farther", "pairs stay farther"))
    silent = len(named) - len(answered)
    if silent:
        axes.plot([], [], " ", label=counted(silent, "pair has no distance", "pairs have no distance"))
    axes.set_xlabel("time after the first stamp (s)")
    axes.set_ylabel("distance (m)")
    axes.set_ylim(bottom=0.0 if not any(lines[pair].overlaps for pair in answered) else None)
    axes.set_xlim(left=0.0)
    axes.grid(alpha=0.3)
    if options.title:
        axes.set_title(options.title)
    if named:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, fontsize="small", frameon=False)
    figure.tight_layout()
    figure.savefig(options.output, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rows", help="CSV file of distance_bag --output")
    parser.add_argument("--output", required=True, help="picture: .png, .pdf or .svg")
    parser.add_argument("--pairs", type=int, default=10, help="pairs with a colour and a name")
    parser.add_argument("--title")
    options = parser.parse_args()
    try:
        draw(read_lines(options.rows), options)
    except ImportError as problem:
        raise SystemExit("plot_distances.py: %s (install python3-matplotlib)" % problem)
    except (OSError, ValueError) as problem:
        raise SystemExit("plot_distances.py: %s" % problem)
    return 0


if __name__ == "__main__":
    sys.exit(main())
