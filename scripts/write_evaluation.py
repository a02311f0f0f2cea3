#!/usr/bin/python3
"""Writes doc/results/evaluation.md and its plots from the results of `evaluate`.

    scripts/write_evaluation.py RESULTS [MORE_RESULTS ...] [--output doc/results/evaluation.md]

RESULTS are folders that `evaluate --output` or `keep_rows.py` has filled; the files of several, one for each shard, are
joined.
Every experiment of experiments/*.yaml that has results is written, with the thesis's figures beside ours.
"""
import argparse
import collections
import csv
import lzma
import math
import pathlib
import re
import statistics

import matplotlib
import yaml

from manoeuvre import draw_manoeuvre, manoeuvre_table, read_curves

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

ROOT = pathlib.Path(__file__).resolve().parent.parent
NICHE_COUNT = 10
ROUNDING = 1e-12  # metres; what is less is none
HEADINGS = {
    "exact": "Phi*", "region": "Phi", "basin": "Region", "best_iteration": "G_i", "niches": "N_Gamma", "distance": "distance",
    "kflop": "kflop", "kflop_executed": "kflop executed", "kinstructions": "thousand instructions", "recall": "recall", "archive_recall": "recall of all minima met", "precision": "precision", "best_convergence": "x*'",
    "population_convergence": "x'", "niche_members": "individuals of the nearest niches",
    "niche_distances": "distances of the nearest niches", "below_second": "nearer than the second niche",
    "nearest": "nearest niche met", "exact_instants": "exact", "proof_finds": "found by the proof",
    "evaluations": "node pairs looked at", "wrong_instants": "instants not the optimum", "worst_excess": "worst excess, m",
    "most_niches": "most niches", "ms": "ms",
}


def read_rows(folders, file_name):
    """Rows by column name; an empty cell was not computed and becomes "nan"."""
    rows = []
    for folder in folders:
        for path in (pathlib.Path(folder) / file_name, pathlib.Path(folder) / (file_name + ".xz")):
            if not path.exists():
                continue
            with (lzma.open if path.suffix == ".xz" else open)(path, "rt", newline="", encoding="utf-8") as file:
                rows += [{name: text or "nan" for name, text in row.items()} for row in csv.DictReader(file)]
    return rows


def with_counted_work(experiment, runs_of, counted):
    """The columns, after `kflop` those of everything that a run does, where scripts/count_run_flops.py has counted it."""
    works = {(row["row"], row["scene"]): row for row in counted if row["experiment"] == experiment["name"]}
    if not works or "kflop" not in experiment["columns"]:
        return experiment["columns"]
    for key, runs in runs_of.items():
        work = works.get(key, {})
        runs[0]["kflop_executed"] = work.get("kflop", "not counted")
        runs[0]["kinstructions"] = work.get("kinstructions", "not counted")
    after = experiment["columns"].index("kflop") + 1
    return [*experiment["columns"][:after], "kflop_executed", "kinstructions", *experiment["columns"][after:]]


def wilson(successes, runs, z=1.959964):
    """The 95 % interval of a rate (Wilson 1927)."""
    rate = successes / runs
    centre = rate + z * z / (2 * runs)
    margin = z * math.sqrt(rate * (1 - rate) / runs + z * z / (4 * runs * runs))
    return (centre - margin) / (1 + z * z / runs), (centre + margin) / (1 + z * z / runs)


def spread(values, digits):
    deviation = statistics.pstdev(values)
    return f"{statistics.fmean(values):.{digits}f} [{min(values):g}-{max(values):g}] {deviation:.{max(1, digits - 1)}f}"


def median_range(values, digits=4):
    return f"{statistics.median(values):.{digits}f} [{min(values):.{digits}f}-{max(values):.{digits}f}]"


def niche_means(runs, column, digits):
    """Of the niches that at least half of the runs have."""
    cells = []
    for i in range(1, NICHE_COUNT + 1):
        values = [float(run[f"{column}_{i}"]) for run in runs if float(run[f"members_{i}"]) > 0]
        if 2 * len(values) < len(runs):
            break
        cells.append(f"{statistics.median(values):.{digits}f}" if digits == 4
                     else f"{sum(values) / len(runs):.{digits}f}")
    return " ".join(cells)


def ours(column, runs):
    """Our figure of a column over the runs of a row on a scene."""
    if column in ("exact", "region", "basin", "below_second"):
        return f"{sum(int(run[column]) for run in runs)}/{len(runs)}"
    if column == "distance":
        return median_range([float(run["distance"]) for run in runs])
    if column == "kflop":
        return median_range([int(run["flops"]) / 1000 for run in runs], 0)
    if column in ("kflop_executed", "kinstructions"):
        return runs[0][column]
    if column == "wrong_instants":
        return spread([int(run[column]) for run in runs], 1)
    if column in ("best_iteration", "niches"):
        return spread([float(run[column]) for run in runs], 2)
    if column == "proof_finds":
        return f"{statistics.fmean(int(run[column]) for run in runs):.1f}"
    if column == "worst_excess":
        values = [float(run[column]) for run in runs]
        words = [f"{value:.1e}" if value > ROUNDING else "0" for value in (statistics.median(values), min(values), max(values))]
        return f"{words[0]} [{words[1]}-{words[2]}]"
    if column == "most_niches":
        return str(max(int(run[column]) for run in runs))
    if column == "evaluations":
        return f"{statistics.fmean(int(run[column]) for run in runs):.0f}"
    if column == "ms":
        return f"{statistics.median(float(run['microseconds']) for run in runs) / 1000:.2f}"
    if column == "exact_instants":
        return f"{1 - statistics.fmean(int(run['wrong_instants']) for run in runs) / int(runs[0]['instants']):.3f}"
    if column in ("recall", "precision", "archive_recall", "nearest"):
        return f"{statistics.fmean(float(run[column]) for run in runs):.3f}"
    if column in ("best_convergence", "population_convergence"):
        return f"{statistics.fmean(float(run[column]) for run in runs):.5f}"
    if column == "niche_members":
        return niche_means(runs, "members", 1)
    if column == "niche_distances":
        return niche_means(runs, "niche_distance", 4)
    raise SystemExit(f"no column is called {column}")


def has_column(row, column):
    """Enumeration answers with one pair and looks for no niches."""
    return row["algorithm"] != "enumeration" or column not in ("recall", "archive_recall", "precision", "nearest", "niches")


def theirs(column, thesis):
    value = thesis.get(column)
    if column == "basin" and isinstance(value, bool):
        return "yes" if value else "no"
    if column == "kflop" and value is None and "mflop" in thesis:
        return f"{1000 * thesis['mflop']:.0f}"
    return "" if value is None else str(value)


def is_less_robust(column, thesis, runs):
    """Whether the thesis's rate is above the upper end of our interval."""
    match = re.fullmatch(r"(\d+)/(\d+)", str(thesis.get(column, "")))
    if column not in ("exact", "region") or not match:
        return False
    upper = wilson(sum(int(run[column]) for run in runs), len(runs))[1]
    return int(match[1]) / int(match[2]) > upper + 1e-12


def write_table(out, experiment, runs_of, counts, _):
    scenes = list(experiment["scenes"])
    columns = experiment["columns"]
    compared = [column for column in columns if any(
        theirs(column, row.get("thesis", {}).get(scene, {})) for row in experiment["rows"] for scene in scenes)]
    header = ["algorithm"] + (["scene"] if len(scenes) > 1 else [])
    for column in columns:
        if column in compared:
            header.append(f"{HEADINGS[column]}, thesis")
        header.append(HEADINGS[column] + (", ours" if column in compared else ""))
    header.append("ms a run")
    out.append("| " + " | ".join(header) + " |")
    out.append("|---" * len(header) + "|")
    for row in experiment["rows"]:
        for scene in scenes:
            runs = runs_of.get((row["name"], scene))
            if not runs:
                continue
            counts.add(len(runs))
            thesis = row.get("thesis", {}).get(scene, {})
            cells = [row["name"].replace(";", ",")] + ([scene.replace("_", " ")] if len(scenes) > 1 else [])
            for column in columns:
                if column in compared:
                    cells.append(theirs(column, thesis))
                mark = " (below)" if is_less_robust(column, thesis, runs) else ""
                cells.append(ours(column, runs) + mark if has_column(row, column) else "")
            cells.append(f"{statistics.median(float(run['microseconds']) for run in runs) / 1000:.2f}")
            out.append("| " + " | ".join(cells) + " |")


def write_by_scene(out, experiment, runs_of, counts, truths):
    """A table for each measure, or for two with a stroke between, with the scenes side by side."""
    scenes = list(experiment["scenes"])
    titles = [f"{scene.replace('_', ' ')}, {float(truths[scene]['niches']):.0f} niches" if experiment.get("niches") and
              scene in truths else scene.replace("_", " ") for scene in scenes]
    for measure in experiment["columns"]:
        columns = measure.split("/")
        out += [f"**{' / '.join(HEADINGS[column] for column in columns)}**", "",
                "| | " + " | ".join(titles) + " |", "|---" * (len(scenes) + 1) + "|"]
        for row in experiment["rows"]:
            cells = [row["name"].replace(";", ",")]
            for scene in scenes:
                runs = runs_of.get((row["name"], scene))
                cells.append(" / ".join(ours(column, runs) for column in columns
                                        if has_column(row, column)) if runs else "")
                counts.update([len(runs)] if runs else [])
            out.append("| " + " | ".join(cells) + " |")
        out.append("")
    del out[-1]


def described(scene, truth):
    """What a scene is, in words."""
    nodes = f"{truth['nodes_a']} and {truth['nodes_b']} nodes"
    name = scene.replace("_", " ")
    if int(truth["instants"]) > 1:
        return f"{name}: {truth['instants']} instants, {nodes}, {float(truth['niches']):.1f} niches at an instant"
    return (f"{name}: edges up to {float(truth['max_edge_length']):.3g} m, {nodes}, enumeration "
            f"{26e-6 * int(truth['nodes_a']) * int(truth['nodes_b']):.0f} Mflop, best node pair "
            f"{float(truth['node_distance']):.4f}, exact {float(truth['exact_distance']):.4f}")


def parameters_section(experiment, folders):
    """What every row has run, from the file that `evaluate` writes beside its results: what all rows of a kind share
    once, then what each adds."""
    lines = read_rows(folders, experiment["name"] + "_rows.csv")
    if not lines:
        raise SystemExit(f"{experiment['name']}: its results have no {experiment['name']}_rows.csv; run `evaluate` on it "
                         "again, which adds the file and repeats no run")
    kinds = collections.defaultdict(lambda: collections.defaultdict(dict))
    for line in lines:
        text = "" if line["parameters"] == "nan" else line["parameters"]
        kinds["-".join(line["algorithm"].split("-")[:2])][line["row"]][line["scene"]] = dict(
            item.split("=", 1) for item in text.split("; ") if item)
    out = ["", "<details><summary>The parameters of every row</summary>", ""]
    for kind, rows in kinds.items():
        sets = [values for scenes in rows.values() for values in scenes.values()]
        shared = {name: value for name, value in sets[0].items() if all(one.get(name) == value for one in sets)}
        shown = ", ".join(f"{name} {value}" for name, value in shared.items())
        words = [shown] if shown else []
        if kind == "tracker":
            words.append("as shipped but for what is named")
        out.append(f"- {kind}, all rows: {', '.join(words) or 'none'}")
        for row, scenes in rows.items():
            own = {scene: ", ".join(f"{name} {value}" for name, value in values.items() if name not in shared)
                   for scene, values in scenes.items()}
            texts = sorted(set(own.values()))
            if texts == [""]:
                continue
            words = texts[0] if len(texts) == 1 else "; ".join(
                f"{scene.replace('_', ' ')}: {text or 'the same'}" for scene, text in own.items())
            out.append(f"  - {row.replace(';', ',')}: {words}")
    return out + ["", "</details>"]


def lost_rows(experiment, runs_of):
    """The thesis's rows in which it is more robust than its algorithm here and every variant of it."""
    lost = []
    for row in experiment["rows"]:
        if row.get("variant_of"):
            continue
        family = [row] + [other for other in experiment["rows"] if other.get("variant_of") == row["name"]]
        for scene in experiment["scenes"]:
            for column in ("exact", "region"):
                if all(is_less_robust(column, one.get("thesis", {}).get(scene, {}), runs_of[(one["name"], scene)])
                       for one in family if (one["name"], scene) in runs_of):
                    lost.append(f"{experiment.get('table')} {row['name'].replace(';', ',')} "
                                f"({scene.replace('_', ' ')}, {HEADINGS[column]})")
    return lost


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
    if any("SA" in row["algorithm"] for row in experiment["rows"]):
        wanted.append(("acceptance", 4, "acceptance probability p_b", False))
    written = []
    for kind, column, label, logarithmic in wanted:
        figure, all_axes = plt.subplots(1, len(scenes), figsize=(5.5 * len(scenes), 4), squeeze=False)
        for axes, scene in zip(all_axes[0], scenes):
            for row in experiment["rows"]:
                points = curves.get((row["name"], scene), [])
                annealing = "SA" in row["algorithm"]
                if not points or (kind == "acceptance") != annealing and kind != "best" or (
                        annealing and kind in ("niches", "average")):
                    continue
                # An iteration of annealing is a trial point, a generation is N_pop of them: shares of the run.
                last = points[-1][0] or 1
                axes.plot([point[0] / last for point in points], [point[column] for point in points],
                          label=row["name"].replace(";", ","))
            if logarithmic:
                axes.set_yscale("log")
            axes.set_title(scene.replace("_", " "))
            axes.set_xlabel("share of the run")
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
            "([partition](../partition.md#along-the-manoeuvre)).", "",
            *manoeuvre_table(curves), "", f"![distance, error and time of every step](images/{file_name})"]


def order_of(experiment):
    """As in the thesis, its appendix last, then what has no number there."""
    number = experiment.get("table") or experiment.get("figure") or "99"
    return [50] * number.startswith("D") + [int(part) for part in re.findall(r"\d+", number)[:2]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="+")
    parser.add_argument("--output", default=str(ROOT / "doc" / "results" / "evaluation.md"))
    options = parser.parse_args()
    images = pathlib.Path(options.output).parent / "images"
    images.mkdir(exist_ok=True)

    experiments = []
    for path in sorted((ROOT / "experiments").glob("*.yaml")):
        with open(path, encoding="utf-8") as file:
            experiments.append({"name": path.stem, **yaml.safe_load(file)})
    experiments.sort(key=order_of)

    body = []
    less_robust = []
    counted = read_rows(options.results, "run_flops.csv")
    manoeuvre = manoeuvre_section(options.results, images)
    for experiment in experiments:
        if order_of(experiment) > [6, 7]:
            body += manoeuvre
            manoeuvre = []
        runs_of = collections.defaultdict(dict)
        for run in read_rows(options.results, experiment["name"] + ".csv"):
            runs_of[(run["row"], run["scene"])][int(run["run"])] = run  # the same run of two folders is one
        runs_of = {key: list(runs.values()) for key, runs in runs_of.items()}
        if not runs_of:
            continue
        table = experiment.get("table")
        number = f"Table {table}: " if table else f"Figures {experiment['figure']}: " if "figure" in experiment else ""
        body += ["", f"## {number}{experiment['title']}", ""]
        counts = set()
        lines = []
        scenes = {row["scene"]: row for row in read_rows(options.results, experiment["name"] + "_scenes.csv")}
        for (_, scene), runs in runs_of.items():
            for run in runs:
                run["instants"] = scenes[scene]["instants"]
        experiment["columns"] = with_counted_work(experiment, runs_of, counted)
        write = write_by_scene if experiment.get("layout") == "by_scene" else write_table
        write(lines, experiment, runs_of, counts, scenes)
        places = "; ".join(described(scene, scenes[scene]) for scene in experiment["scenes"] if scene in scenes)
        body += [f"Runs of each row: {', '.join(str(c) for c in sorted(counts))}. Metres; {places}."
                 + (f" {experiment['remark']}" if experiment.get("remark") else ""), ""] + lines
        if experiment.get("note"):
            body += ["", experiment["note"].strip()]
        body += parameters_section(experiment, options.results)
        less_robust += lost_rows(experiment, runs_of)
        curves = curves_of(options.results, experiment["name"])
        if curves:
            for file_name, label in plot_curves(experiment, curves, images):
                body += ["", f"![{label}](images/{file_name})"]
    body += manoeuvre
    plot_sharing(images)

    head = ["# The thesis's algorithms, evaluated", "",
            "Every table of the thesis (Carretero) that its algorithms fill, with its figures beside ours. Written by",
            "`scripts/report.sh` (`quick`, or `full` for the counts of runs kept here); the experiments are `experiments/*.yaml`.",
            "Below each table stands what every row has run.",
            "", "- **Rows of the thesis** come first and have nothing of ours: no elite, both children near the fitter parent (sec. 3.3.2.b),",
            "  descents along edges and after mutation only (fig. 2.13), mating restriction with sharing only (4.7) and strict (4.6.3), annealing",
            "  without new points (5.3.1.b), inheritance by (6.7) alone. A row that changes something names it.",
            "- **`our operators`** are this package's: exchange of genes, random immigrants, an elite, conserved niches, an epsilon in the fitness,",
            "  children on all of the path, mating restriction, descents in long steps, also of the first population. One at a time: see",
            "  [the switches](#from-the-thesiss-algorithm-to-ours-one-switch-at-a-time). **`shipped`** is what a pair's tracker runs by default,",
            "  of a search its cold one.", "- Phi*: runs that end at the best node pair there is (by enumeration); Phi: in its region (1.1 times its distance, nearer than the",
            "  second local minimum). `(below)`: the thesis's rate is above the upper end of our 95 % interval (Wilson).",
            "- Region (Tables 2.3 to 3.5): the thesis's sign of an answer in the neighbourhood of the optimum, which it gives at distances far above Phi's",
            "  limit. Ours: Phi, or a descent over the nodes from the answer ends in the region of the optimum on the surfaces.",
            "- G_i: the generation (iteration) in which the run's best appeared; N_Gamma: niches of the final population: mean [least-most] deviation.",
            "- x*', x': averages of the best and of the mean objective over a run, over the optimum's (5.1, 5.2).",
            "- kflop: by the thesis's rule, 26 for each point pair looked at (a step of a descent looks at about five) and 6 for each constraint: median [least-most].",
            "  These are the evaluations alone; the thesis does not say whether its counts hold more. kflop executed, thousand instructions: of all that a run does,",
            "  selection, sharing, sorting and random numbers included, counted by `scripts/count_run_flops.py` (each addition, multiplication, division and root;",
            "  median of a few runs). An evaluation in a descent takes fewer than 26, as the moving body is not transformed for each neighbour.",
            "  Times are of one core of a shared machine.",
            "- recall, precision: of the outward niches of prominence 1e-2 that are proven to be all, in the final population (of a",
            "  tracker: those it lists), by regions of the surfaces ([experiments](../experiments.md)). Nearest niche met: runs that have met it at all.",
            "- Along a motion (`instants`) every figure is a mean over them.", "",
            "![Figure 5.2: the sharing function](images/evaluation_sharing.png)"]
    if less_robust:
        head += ["", "Rows in which the thesis is more robust than its algorithm here and every variant of it beside it: "
                 + "; ".join(less_robust) + "."]
    else:
        head += ["", "In no row is the thesis more robust than its algorithm here or a variant of it beside it."]
    pathlib.Path(options.output).write_text("\n".join(head + body) + "\n", encoding="utf-8")
    print(options.output)


if __name__ == "__main__":
    main()
