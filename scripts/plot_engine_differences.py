#!/usr/bin/python3
"""Draws our simulation beside other engines from doc/results/engine_differences.csv: doc/images/engine_differences.png.

    scripts/plot_engine_differences.py            (needs python3-matplotlib: scripts/install_dependencies.sh plot)
"""
import csv
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Widest below: where curves coincide all of them show.
STYLES = {
    "concave_distance": {"color": "tab:blue", "linewidth": 4.0, "alpha": 0.45, "label": "concave_distance"},
    "simbody": {"color": "tab:orange", "linewidth": 1.8, "label": "Simbody"},
    "ode": {"color": "black", "linewidth": 1.1, "linestyle": (0, (4, 2)), "label": "ODE"},
}


def read_runs():
    """{scene: {engine: {column: [values]}}}"""
    runs = {}
    with open(ROOT / "doc" / "results" / "engine_differences.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            columns = runs.setdefault(row["scene"], {}).setdefault(row["engine"], {})
            for name, value in row.items():
                if name not in ("scene", "engine"):
                    columns.setdefault(name, []).append(float(value))
    return runs


def draw(axes, scene, value, title, unit):
    """One curve an engine; `value` makes it of the engine's columns."""
    for engine, style in STYLES.items():
        if engine in scene:
            axes.plot(scene[engine]["time"], value(scene[engine]), **style)
    axes.set_title(title, fontsize=10)
    axes.set_ylabel(unit)
    axes.grid(alpha=0.3)


def way(columns):
    """From the start along the slope's plane, metres."""
    return [((x - columns["x"][0]) ** 2 + (y - columns["y"][0]) ** 2) ** 0.5
            for x, y in zip(columns["x"], columns["y"])]


def times(factor, name):
    return lambda columns: [factor * value for value in columns[name]]


def main():
    runs = read_runs()
    figure, axes = plt.subplots(4, 2, figsize=(12, 14))
    ball, feet = runs["bouncing_ball"], runs["two_feet"]
    draw(axes[0, 0], ball, times(1e3, "z"), "Bouncing ball: height of the centre", "mm")
    draw(axes[0, 1], ball, times(1.0, "energy"), "Bouncing ball: kinetic and potential energy", "J")
    draw(axes[1, 0], runs["box_sticks"], lambda columns: [1e3 * value for value in way(columns)],
         "Box below the friction angle: way", "mm")
    draw(axes[1, 1], runs["box_sticks"], times(1e3, "pitch"), "Box below the friction angle: tilt", "mrad")
    draw(axes[2, 0], runs["box_slides"], way, "Box above the friction angle: way", "m")
    draw(axes[2, 1], runs["box_slides_diagonally"], way, "The same down the ground's diagonal: way", "m")
    draw(axes[3, 0], feet, times(1e3, "z"), "Body on two feet: height of the centre", "mm")
    draw(axes[3, 1], feet, times(1.0, "pitch"), "Body on two feet: tilt", "rad")
    for row in axes[1:2]:
        row[1].set_xlim(0.0, 0.3)
    for axis in axes[3]:
        axis.set_xlabel("s")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncol=3, frameon=False, bbox_to_anchor=(0.5, 0.995))
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 0.975))
    figure.savefig(ROOT / "doc" / "images" / "engine_differences.png", dpi=110)
    print("doc/images/engine_differences.png")


if __name__ == "__main__":
    main()
