"""The figures of the page."""
import collections
import pathlib

import matplotlib

from .manoeuvre import draw_manoeuvre, manoeuvre_table, read_curves
from .rows import ROOT, read_rows

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
from matplotlib.ticker import FuncFormatter, LogLocator  # noqa: E402

STYLES = ("-", "--", "-.", ":")  # lines that lie on each other stay visible


def curves_of(folders, name):
    """Averages over all runs: {(row, scene): [(iteration, best, mean square, niches, p_b)]}."""
    units = {}
    for line in read_rows(folders, name + "_curves.csv"):
        unit = (line["row"], line["scene"], line["first_run"], int(line["iteration"]))
        # A unit that was written twice, once with fewer runs, counts once.
        if unit not in units or int(units[unit]["runs"]) < int(line["runs"]):
            units[unit] = line
    sums = collections.defaultdict(lambda: collections.defaultdict(lambda: [0.0] * 5))
    for (row, scene, _, iteration), line in units.items():
        point = sums[(row, scene)][iteration]
        point[0] += int(line["runs"])
        for i, column in enumerate(("best_distance_sum", "mean_square_sum", "niches_sum", "acceptance_sum")):
            point[i + 1] += float(line[column])
    return {key: [(iteration, *(value / p[0] for value in p[1:])) for iteration, p in sorted(points.items())]
            for key, points in sums.items()}


def plot_curves(experiment, curves, images):
    """The figures that an experiment's curves stand for; returns their names and what they show."""
    scenes = list(experiment["scenes"])
    name = experiment["name"]
    wanted = [("best", 1, "distance of the best, m", True)]
    if any(key[0] for key in curves) and any(point[3] > 0 for points in curves.values() for point in points):
        wanted += [("niches", 3, "niches of the population", False),
                   ("average", 2, "average objective, m^2", True)]
    has_annealing = any("SA" in row["algorithm"] for row in experiment["rows"])
    if has_annealing:
        wanted.append(("acceptance", 4, "acceptance probability p_b", False))
    written = []
    for kind, column, label, logarithmic in wanted:
        figure, all_axes = plt.subplots(1, len(scenes), figsize=(5.5 * len(scenes), 4), squeeze=False)
        for axes, scene in zip(all_axes[0], scenes):
            for number, row in enumerate(experiment["rows"]):
                points = curves.get((row["name"], scene), [])
                annealing = "SA" in row["algorithm"]
                if not points or (kind == "acceptance") != annealing and kind != "best" or (
                        annealing and kind in ("niches", "average")):
                    continue
                # An iteration of annealing is a trial point, a generation is N_pop of them: shares of the run.
                last = (points[-1][0] or 1) if has_annealing else 1
                axes.plot([point[0] / last for point in points], [point[column] for point in points],
                          STYLES[number % len(STYLES)], label=row["name"].replace(";", ","))
            if logarithmic:
                axes.set_yscale("log")
                for axis, steps in ((axes.yaxis.set_major_locator, (1.0,)), (axes.yaxis.set_minor_locator, (2.0, 3.0, 5.0))):
                    axis(LogLocator(subs=steps))
                axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
                axes.yaxis.set_minor_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
                axes.tick_params(axis="y", which="minor", labelsize=8)
            if not has_annealing:  # most happens in the first generations
                axes.set_xscale("symlog", linthresh=1.0)
                axes.set_xlim(left=0.0)
                axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            axes.set_title(scene.replace("_", " "))
            axes.set_xlabel("share of the run" if has_annealing else "generation (0: the first population)")
            axes.set_ylabel(label)
            axes.grid(alpha=0.3)
            axes.legend(fontsize=8)
        figure.tight_layout()
        file_name = f"evaluation_{name}_{kind}.png"
        figure.savefig(images / file_name, dpi=90)
        plt.close(figure)
        written.append((file_name, label))
    return written


def plot_sharing(images):
    """Figure 5.2: the sharing function for five exponents."""
    figure, axes = plt.subplots(figsize=(5.5, 4))
    shares = [i / 200 for i in range(201)]
    for exponent in (0.1, 0.3, 1, 3, 10):
        axes.plot(shares, [1 - share ** exponent for share in shares], label=f"alpha_s = {exponent:g}")
    axes.set_xlabel("mesh distance / sharing radius")
    axes.set_ylabel("S")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(images / "evaluation_sharing.png", dpi=90)
    plt.close(figure)


def manoeuvre_section(folders, images):
    """Figures 6.6 and 6.7; nothing without their data (a build without CGAL)."""
    kept = ROOT / "doc" / "results" / "manoeuvre.csv"
    paths = [pathlib.Path(folder) / kept.name for folder in folders] + [kept]
    path = next((path for path in paths if path.exists()), None)
    if path is None:
        return []
    curves = read_curves(path)
    file_name = "evaluation_figure_6_6.png"
    draw_manoeuvre(curves, plt, images / file_name)
    return ["", "## Figures 6.6, 6.7: The manoeuvre into the fixture", "",
            f"{len(curves['nodes'])} steps at 10 Hz, the partition by hand (126 sub-pairs), grid 0.05 m; by "
            "`partition_benchmark --curves-output`. Metres, microseconds of processor time; flops by the thesis's rules "
            "([partition](../../thesis/doc/partition.md#along-the-manoeuvre)).", "",
            *manoeuvre_table(curves), "", f"![distance, error and time of every step](images/{file_name})"]


def drawn_section(images):
    """Figures 6.1 to 6.3 and 6.5, where scripts/plot_thesis_figures.py has drawn them."""
    figures = [("6_1", "a holed block in convex pieces"), ("6_2", "a slotted block in convex pieces"),
               ("6_3", "the semi-extruded body in convex pieces"), ("6_5", "position and orientation of the battery over time")]
    drawn = [(f"evaluation_figure_{number}.png", label) for number, label in figures
             if (images / f"evaluation_figure_{number}.png").exists()]
    if not drawn:
        return []
    lines = ["", "## Figures 6.1 to 6.3, 6.5: Partitions, and the manoeuvre's poses", "",
             "The bodies that the thesis partitioned are lost: these are ours, cut by this package ([partition](../../thesis/doc/partition.md)); the pieces are moved apart."]
    for file_name, label in drawn:
        lines += ["", f"![{label}](images/{file_name})"]
    return lines
