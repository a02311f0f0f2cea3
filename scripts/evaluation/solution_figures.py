"""The thesis's pictures of solutions on the bodies: figures 2.19 to 2.35, 4.6, 4.8, 4.12 and 5.6."""
import collections

import matplotlib

from .rows import read_experiments, read_rows
from .scene_drawing import colour_words, counted_pairs, draw_pairs, draw_scene

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

RUNS = {"comb-GA-nl": 200, "comb-GA-wl": 500}  # the thesis's, of figure 5.6
SAME = 1e-9  # metres
# Each picture has a name, the figures of the thesis that it stands for, and the experiments whose rows it shows.
PICTURES = [
    ("figure_2_19", "Figures 2.19 and 2.21: answers of cont-GA", ["table_2_3"]),
    ("figure_2_23", "Figures 2.23 and 2.25: answers of cont-SA", ["table_2_5"]),
    ("figure_2_29", "Figures 2.29 and 2.31: answers of cont-GA", ["table_2_6"]),
    ("figure_2_33", "Figures 2.33 and 2.35: answers of cont-SA", ["table_2_7"]),
    ("figure_4_6", "Figure 4.6: final populations with sharing and crowding", ["table_4_2", "table_4_3"]),
    ("figure_4_8", "Figure 4.8: final populations with sharing and crowding", ["table_4_4", "table_4_5"]),
    ("figure_4_12", "Figure 4.12: final populations with sharing and crowding", ["table_4_6", "table_4_7"]),
    ("figure_5_6", "Figure 5.6: best points of the final populations", ["figure_5_6"]),
]


def read_points(folders, experiment):
    """{(row, scene): lines} of an experiment's points; of a run that was done again its last ones."""
    found = collections.defaultdict(dict)
    for line in read_rows(folders, experiment + "_points.csv"):
        found[line["row"], line["scene"]][int(line["run"]), int(line["individual"])] = line
    return {key: [line for _, line in sorted(lines.items())] for key, lines in found.items()}


def row_title(row, scene):
    return f"{row.replace(';', ',')}, {scene.replace('_', ' ')}"


def panels(rows, columns, height=4.4):
    """A figure, and its axes one after another."""
    figure = plt.figure(figsize=(6 * columns, height * rows))
    return figure, (figure.add_subplot(rows, columns, place + 1, projection="3d", computed_zorder=False) for place in range(rows * columns))


def finish(figure, explanation, path):
    figure.text(0.5, 0.015, explanation, ha="center", fontsize=11)
    figure.subplots_adjust(left=0.0, right=1.0, bottom=0.04, top=0.94, wspace=0.0, hspace=0.06)
    figure.savefig(path, dpi=90)
    plt.close(figure)
    print(path)


def thesis_rows(experiment):
    return [row for row in experiment["rows"] if "thesis" in row and not row.get("variant_of")]


def plot_answers(experiment, folders, path):
    """Chapter 2: of each row on each scene the answers of all runs, and that of the median run."""
    points = read_points(folders, experiment["name"])
    scenes, rows = list(experiment["scenes"]), thesis_rows(experiment)
    if not points:
        return False
    figure, all_axes = panels(len(scenes), len(rows))
    for scene in scenes:
        for row in rows:
            axes = next(all_axes)
            lines = sorted(points[row["name"], scene], key=lambda line: float(line["distance"]))
            middle = lines[(len(lines) - 1) // 2]
            draw_scene(axes, scene)
            draw_pairs(axes, counted_pairs(lines, scene), colour="0.6", width=0.3, least=3.0, whole=0.0, edge=0.0)
            draw_pairs(axes, counted_pairs([middle], scene), width=2.5, whole=70.0, edge=1.5, above=10)
            axes.set_title(f"{row_title(row['name'], scene)}\nmedian run {float(middle['distance']):.4f} m; the thesis's run "
                           f"{row['thesis'][scene]['distance']} m", fontsize=11, y=0.99)
    finish(figure, f"Each line joins the two points that a run answers with ({len(lines)} runs); black: the run of the median distance. "
           "Points may lie off the bodies, or inside.\n"
           + colour_words(scenes[0]), path)
    return True


def plot_populations(experiments, folders, path):
    """Chapter 4: the final population of the first run with sharing and with crowding."""
    chosen = []
    for experiment in experiments:
        points, runs = read_points(folders, experiment["name"]), read_rows(folders, experiment["name"] + ".csv")
        for row in thesis_rows(experiment):
            for scene in experiment["scenes"]:
                first = [run for run in runs if run["run"] == "0" and (run["row"], run["scene"]) == (row["name"], scene)]
                if points.get((row["name"], scene)) and first:
                    chosen.append((row, scene, points[row["name"], scene], first[0]))
    if len(chosen) < len(experiments):
        return False
    figure, all_axes = panels(1, len(chosen), height=5.4)
    for (row, scene, lines, run), axes in zip(chosen, all_axes):
        draw_scene(axes, scene)
        draw_pairs(axes, counted_pairs(lines, scene), whole=500.0)
        draw_niche_numbers(axes, run, lines, scene)
        niches = [f"{float(run[f'niche_distance_{i}']):.4f} ({run[f'members_{i}']})" for i in range(1, 11)
                  if run[f"members_{i}"] != "0"]
        half = 5
        axes.set_title(f"{row_title(row['name'], scene)}: N_Gamma {float(run['niches']):.0f} ({row['thesis'][scene]['niches']} in the thesis)\n"
                       + ", ".join(niches[:half]) + (",\n" + ", ".join(niches[half:]) if niches[half:] else ""), fontsize=10, y=0.95)
    finish(figure, "The final population of the first run; above: distance in metres (and individuals) of each niche, by number in the "
           "picture.\nEach line joins the two nodes of an individual; the larger its ends, the more individuals are there. "
           + colour_words(chosen[0][1]), path)
    return True


def draw_niche_numbers(axes, run, lines, scene):
    """The number of each niche in the middle of the line of the individual that stands for it."""
    numbered = set()
    for i in range(1, 11):
        distance = float(run[f"niche_distance_{i}"])
        best = [line for line in lines if abs(float(line["distance"]) - distance) < SAME]
        pair = next((pair for pair in counted_pairs(best, scene) if pair not in numbered), None)
        if run[f"members_{i}"] == "0" or pair is None:
            continue
        numbered.add(pair)
        middle = [0.5 * (pair[axis] + pair[axis + 3]) for axis in range(3)]
        axes.text(*middle, str(i), fontsize=9, fontweight="bold", ha="center", va="center",
                  bbox={"facecolor": "white", "edgecolor": "0.4", "pad": 1.2, "alpha": 0.85}, zorder=100)


def plot_best_points(experiment, folders, path):
    """Figure 5.6: the best pairs of the final populations of all runs."""
    points = read_points(folders, experiment["name"])
    if not points:
        return False
    rows = sorted({row for row, _ in points})
    scenes = sorted({scene for _, scene in points}, reverse=True)
    figure, all_axes = panels(len(scenes), len(rows))
    for scene in scenes:
        best = min(float(line["distance"]) for row in rows for line in points[row, scene])
        for row in rows:
            lines = [line for line in points[row, scene] if int(line["run"]) < RUNS[row.split(";")[0]]]
            at_best = sum(float(line["distance"]) < best + SAME for line in lines)
            axes = next(all_axes)
            draw_scene(axes, scene)
            pairs = counted_pairs(lines, scene)
            draw_pairs(axes, pairs)
            axes.set_title(f"{row_title(row, scene)}\n{len(lines)} runs end at {len(pairs)} pair{'s' * (len(pairs) != 1)}, {at_best} of "
                           "them at the nearest", fontsize=11, y=0.99)
    finish(figure, "Each line joins the best pair of a run's last population; the larger its ends, the more runs have it.", path)
    return True


def plot_pictures(folders, images):
    """All pictures that the folders have points for; of the others it says so."""
    experiments = {experiment["name"]: experiment for experiment in read_experiments()}
    for name, label, shown in PICTURES:
        path = images / f"evaluation_{name}.png"
        if label.startswith("Figures 2"):
            is_drawn = plot_answers(experiments[shown[0]], folders, path)
        elif len(shown) > 1:
            is_drawn = plot_populations([experiments[one] for one in shown], folders, path)
        else:
            is_drawn = plot_best_points(experiments[shown[0]], folders, path)
        if not is_drawn:
            print(f"no points of {', '.join(shown)}: left out: {label}")


def pictures_of(experiment, images):
    """[(file, label)] of the pictures that end with an experiment, where they are drawn."""
    return [(f"evaluation_{name}.png", label) for name, label, shown in PICTURES
            if shown[-1] == experiment and (images / f"evaluation_{name}.png").exists()]
