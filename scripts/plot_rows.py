#!/usr/bin/python3
"""Draws doc/images/rows.png and rows_arm.png and writes doc/results/rows.csv from the runs of scripts/measure.sh rows.

    scripts/plot_rows.py <folder with a folder for each setting>     (needs python3-matplotlib)
"""
import csv
import pathlib
import re
import shutil
import sys
import xml.etree.ElementTree as ElementTree

import matplotlib
import numpy as np
import yaml

from geometry.demo_solids import clamp_outline
from geometry.wam_kinematics import Chain

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS, IMAGES = ROOT / "doc" / "results", ROOT / "doc" / "images"
COLOURS = {"all": "tab:blue", "nearest": "tab:red"}
WORDS = {"all": "all rows", "nearest": "nearest row only"}
MARGINS = {"clamp": 4.0, "arm": 20.0}  # mm, of the runs that are drawn


class Run:
    """One CSV file of follow_rows.py, as arrays with a row for each step; velocities as parts of their limits."""

    def __init__(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            lines = list(csv.DictReader(file))
        self.path = path
        self.joints = [name[2:] for name in lines[0] if name.startswith("v_")]
        self.rows = path.stem.split("_")[1]
        self.scene = path.stem.split("_")[0]
        self.time = np.array([float(line["t"]) for line in lines])
        self.positions = np.array([[float(line[name]) for name in self.joints] for line in lines])
        self.velocities = np.array([[float(line["v_" + name]) for name in self.joints] for line in lines])
        self.tip = np.array([[float(line["tip_" + axis]) for axis in "xyz"] for line in lines])
        self.value = np.array([1e3 * float(line["value"] or "nan") for line in lines])
        self.end = lines[-1]["state"]

    def summary(self, limits):
        """`limits`: of the joints' velocities."""
        jumps = np.diff(self.velocities / limits, axis=0)
        moves = np.where(np.abs(self.velocities) < 0.01 * limits, 0.0, self.velocities)
        turns = moves[1:] * moves[:-1] < 0.0  # without those below a hundredth of the limit
        return {"end": self.end, "time": f"{self.time[-1]:.2f}", "least_mm": f"{np.nanmin(self.value):.2f}",
                "largest_jump": f"{np.abs(jumps).max():.2f}", "total_variation": f"{np.abs(jumps).sum():.1f}",
                "sign_changes": int(turns.sum())}


def limits_of(urdf):
    joints = ElementTree.parse(ROOT / "urdf" / urdf).getroot().findall("joint")
    return np.array([float(joint.find("limit").get("velocity")) for joint in joints if joint.get("type") != "fixed"])


def outline_at(outline, position):
    """The tool's outline in the plane of its jaws: x, z of its frame, turned about y."""
    x, z, turn = position
    c, s = np.cos(turn), np.sin(turn)
    return np.array([c * outline[:, 0] + s * outline[:, 1] + x, -s * outline[:, 0] + c * outline[:, 1] + z]).T


def draw_clamp(axes, runs):
    outline = clamp_outline()
    for box in (((-0.3, -0.02), 0.3, 0.04), ((-0.18, -0.105), 0.03, 0.09)):
        axes.add_patch(plt.Rectangle(*box, color="0.6", zorder=1, linewidth=0))
    axes.text(-0.19, -0.006, "table", fontsize=8, color="w", zorder=6)
    every, nearest = runs["all"], runs["nearest"]
    for k, words, place in ((0, "start", (0.19, 0.145)), (len(every.time) - 1, "goal", (0.085, -0.072))):
        axes.add_patch(plt.Polygon(outline_at(outline, every.positions[k]), closed=True, zorder=2, linewidth=0.8,
                                   facecolor=(0.35, 0.5, 0.72, 0.5 if k else 0.15), edgecolor=COLOURS["all"]))
        axes.text(*place, words, fontsize=8, color=COLOURS["all"])
    axes.add_patch(plt.Polygon(outline_at(outline, nearest.positions[-1]), closed=True, fill=False, zorder=3,
                               linewidth=1.2, edgecolor=COLOURS["nearest"]))
    axes.text(-0.1, 0.09, "contact", fontsize=8, color=COLOURS["nearest"])
    for name in ("all", "nearest"):
        axes.plot(runs[name].tip[:, 0], runs[name].tip[:, 2], color=COLOURS[name], linewidth=1.5, zorder=4)
    axes.plot(*nearest.tip[-1][[0, 2]], "x", color=COLOURS["nearest"], markersize=8, markeredgewidth=2, zorder=5)
    axes.set_xlim(-0.2, 0.36)
    axes.set_ylim(-0.12, 0.2)
    axes.set_title("a C-shaped tool around a table's edge", fontsize=9)


def draw_arm(axes, runs):
    chain = Chain(ROOT / "urdf" / "wam.urdf", 0.077)

    def skeleton(positions):
        poses = chain.poses(positions)
        points = [poses[f"wam{k}"][:3, 3] for k in (1, 4, 5, 6)]
        return np.array(points + [chain.tip(positions)[0]])
    for name, share, alpha in (("all", 0.0, 0.3), ("all", 0.5, 0.5), ("all", 1.0, 1.0), ("nearest", 1.0, 1.0)):
        run = runs[name]
        points = skeleton(run.positions[int(share * (len(run.time) - 1))])
        axes.plot(points[:, 0], points[:, 1], "-o", color=COLOURS[name], alpha=alpha, linewidth=3, markersize=4)
    for body in yaml.safe_load((ROOT / "config" / "rows_arm.yaml").read_text(encoding="utf-8"))["bodies"]:
        axes.add_patch(plt.Circle(body["pose"]["xyz"][:2], body["cylinder"]["radius"], color="0.6", zorder=1))
        axes.text(body["pose"]["xyz"][0] + 0.05, body["pose"]["xyz"][1], "post", fontsize=8, color="0.35", va="center")
    for name in ("all", "nearest"):
        axes.plot(runs[name].tip[:, 0], runs[name].tip[:, 1], ":", color=COLOURS[name], linewidth=1.5)
    axes.text(-0.11, 0.0, "start", fontsize=8, color=COLOURS["all"])
    axes.text(0.86, 0.06, "goal", fontsize=8, color=COLOURS["all"])
    axes.set_ylim(-0.08, 0.4)
    axes.set_title("an arm between two posts, from above", fontsize=9)


def draw(name, runs, picture, limits, joint):
    """Three panels: the path, the commanded velocity of one joint, the least distance."""
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(12, 3.6), gridspec_kw={"width_ratios": [1.45, 1, 1]})
    picture(left, runs)
    left.set_aspect("equal")
    left.set_xticks([])
    left.set_yticks([])
    for which in ("nearest", "all"):
        run = runs[which]
        middle.plot(run.time, run.velocities[:, joint] / limits[joint], color=COLOURS[which], linewidth=1.2, label=WORDS[which])
        right.plot(run.time, run.value, color=COLOURS[which], linewidth=1.2, label=WORDS[which])
        if run.end == "contact":
            right.plot(run.time[-1], 0.0, "x", color=COLOURS[which], markersize=9, markeredgewidth=2)
            right.annotate("contact", (run.time[-1], 0.0), (8, 3), textcoords="offset points", color=COLOURS[which], fontsize=9)
        for axes in (middle, right):
            axes.set_xlim(*WINDOWS[name])
    margin = MARGINS[name]
    right.axhline(margin, color="k", linewidth=0.8, linestyle="--")
    right.text(WINDOWS[name][1], 0.93 * margin, f"margin {margin:g} mm ", ha="right", va="top", fontsize=8)
    right.set_ylim(-0.2 * margin, 3 * margin)
    middle.set_ylim(-1.05, 1.05)
    middle.set_title("commanded velocity: " + TURNS[name] + ", part of its limit", fontsize=9)
    right.set_title("distance of the nearest place, mm", fontsize=9)
    for axes in (middle, right):
        axes.set_xlabel("time, s", fontsize=8)
        axes.tick_params(labelsize=8)
        axes.grid(alpha=0.3)
    middle.legend(fontsize=8, loc=LEGENDS[name])
    figure.tight_layout()
    figure.savefig(IMAGES / PICTURES[name], dpi=85)
    plt.close(figure)
    print(f"doc/images/{PICTURES[name]}")


TURNS = {"clamp": "the tool's turn", "arm": "shoulder j1"}
LEGENDS = {"clamp": "lower right", "arm": "upper right"}
WINDOWS = {"clamp": (0.3, 1.3), "arm": (0.0, 4.0)}  # s, that are drawn
PICTURES = {"clamp": "rows.png", "arm": "rows_arm.png"}
SCENES = {"clamp": ("clamp.urdf", draw_clamp, 2), "arm": ("wam.urdf", draw_arm, 0)}


def main():
    folder = pathlib.Path(sys.argv[1])
    table = []
    for name, (urdf, picture, joint) in SCENES.items():
        limits = limits_of(urdf)
        for place, setting in enumerate(sorted(folder.glob(f"*_{name}_*"))):
            values = dict(re.findall(r"(step|gain|margin|pace)=([\d.]+)", setting.name))
            called = re.match(rf"\d+_{name}_(.*)_step=", setting.name)[1]
            runs = {path.stem.split("_")[1]: Run(path) for path in sorted(setting.glob("*.csv"))}
            for which, run in runs.items():
                table.append({"scene": name, "setting": called, "rows": which, **values, **run.summary(limits * float(values["pace"]))})
                if place == 0:
                    shutil.copy(run.path, RESULTS / f"rows_{name}_{which}.csv")
            if place == 0:
                draw(name, runs, picture, limits * float(values["pace"]), joint)
    with open(RESULTS / "rows.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, table[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(table)
    print("doc/results/rows.csv")


if __name__ == "__main__":
    main()
