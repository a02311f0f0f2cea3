"""The experiments, and what `evaluate` has written about them."""
import collections
import csv
import lzma
import pathlib
import re

import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


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


def order_of(experiment):
    """As in the thesis, its appendix last, then what has no number there."""
    number = experiment.get("table") or experiment.get("figure") or "99"
    return [50] * number.startswith("D") + [int(part) for part in re.findall(r"\d+", number)[:2]]


def read_experiments(folder=ROOT / "thesis" / "experiments"):
    experiments = []
    for path in sorted(folder.glob("*.yaml")):
        with open(path, encoding="utf-8") as file:
            experiments.append({"name": path.stem, **yaml.safe_load(file)})
    return sorted(experiments, key=order_of)


class Results:
    """Runs of all experiments: `runs[experiment][row, scene]` and what is true of `scenes[experiment][scene]`."""

    def __init__(self, experiments, folders):
        self.folders = folders
        self.experiments = {experiment["name"]: experiment for experiment in experiments}
        self.scenes = {}
        self.runs = {}
        for name in self.experiments:
            self.scenes[name] = {row["scene"]: row for row in read_rows(folders, name + "_scenes.csv")}
            found = collections.defaultdict(dict)
            for run in read_rows(folders, name + ".csv"):
                run["instants"] = self.scenes[name][run["scene"]]["instants"]
                found[(run["row"], run["scene"])][int(run["run"])] = run  # the same run of two folders is one
            self.runs[name] = {key: list(runs.values()) for key, runs in found.items()}

    def row(self, experiment, row_name):
        for row in self.experiments[experiment]["rows"]:
            if row["name"] == row_name:
                return row
        raise KeyError(f"{experiment} has no row '{row_name}'")


def with_counted_work(experiment, runs_of, counted):
    """The columns, after `kflop` those of everything that a run does, where scripts/evaluation/count_run_flops.py has counted it."""
    works = {(row["row"], row["scene"]): row for row in counted if row["experiment"] == experiment["name"]}
    if not works or "kflop" not in experiment["columns"]:
        return experiment["columns"]
    for key, runs in runs_of.items():
        work = works.get(key, {})
        runs[0]["kflop_executed"] = work.get("kflop", "not counted")
        runs[0]["kinstructions"] = work.get("kinstructions", "not counted")
    after = experiment["columns"].index("kflop") + 1
    return [*experiment["columns"][:after], "kflop_executed", "kinstructions", *experiment["columns"][after:]]
