"""The tables of an experiment, and the parameters of its rows."""
import collections
import re
import statistics

from .figures import HEADINGS, has_column, ours, theirs, their_number, values_of, wilson
from .rows import read_rows


def is_less_robust(column, thesis, runs):
    """Whether the thesis's rate is above the upper end of our interval."""
    if column not in ("exact", "region") or not re.fullmatch(r"\d+/\d+", theirs(column, thesis)):
        return False
    return their_number(column, thesis) > wilson(round(sum(values_of(column, runs))), len(runs))[1] + 1e-12


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
