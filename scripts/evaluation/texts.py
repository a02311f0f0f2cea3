#!/usr/bin/python3
"""Figures in the remarks, notes and reasons of the experiments.

    scripts/evaluation/texts.py [EXPERIMENT.yaml ...]     fails on a figure that is typed by hand

A figure is a Python expression in braces, with a format: `{mean("N_pop 20", "exact"):.0%}`. Functions of a row and a column:
mean, median, least, greatest, total and runs of ours, mean_root (of the square roots), thesis the thesis's; of a value, too:
share, of the runs that have at least that. Functions of a column alone: truth of a scene. All take scene="..." (by default
the experiment's only scene) and table="..." (by default the experiment itself).
"""
import math
import pathlib
import re
import statistics
import sys

import yaml

PLACEHOLDER = re.compile(r"\{(.+?)(?::([-+.,%\w]*))?\}")
# Names that hold digits, and numbers that name a place, a parameter's value or a unit's exponent.
ALLOWED = re.compile(
    r"\[[^\]]*\]\([^)]*\)|`[^`]*`|"
    r"(?:Tables?|Figures?|figs?\.|sec\.|ch\.|app\.|position|Table)\s[\dA-D][\d.]*(?:\.[a-z])?(?:(?:,| and| to) [\dA-D][\d.]*)*|"
    r"\(\d\.\d+\)|"
    r"(?:N_pop|N_popG|p_m|p_x|k_p|k_r|k_B|t_ini|G_max|alpha_s|alpha_G|sigma_\w|r_max|elite|epsilon)(?: of)?(?: =)?(?: \d[\d.]*(?:/N_pop)?"
    r"(?:(?:,| and| to) \d[\d.]*)*| = sigma_\w)?|"
    r"1/N_pop|1/d\^2|d\^2|x\*'")


def fault_of(text):
    """The first figure in a text that no placeholder gives; "" if there is none."""
    rest = ALLOWED.sub("", PLACEHOLDER.sub("", text))
    match = re.search(r".{0,30}\d[\d.,]*.{0,20}", rest)
    return match[0] if match else ""


def texts_of(experiment):
    """All texts of an experiment that may quote figures: {where: text}."""
    texts = {key: experiment[key] for key in ("remark", "note") if key in experiment}
    for owner, holder in [("", experiment)] + [(row["name"] + ", ", row) for row in experiment["rows"]]:
        reasons = [(f"{owner}{key} of {column}", reason) for key in ("reasons", "better")
                   for column, reason in holder.get(key, {}).items()]
        for place, reason in reasons:
            texts[place] = reason if isinstance(reason, str) else reason.get("text", "")
    return texts


class Quoter:
    """Fills the placeholders of texts from results."""

    def __init__(self, results, their_number, values_of):
        self.results = results
        self.their_number = their_number
        self.values_of = values_of

    def functions(self, experiment, default_scene):
        def place(scene, table):
            name = table or experiment
            scenes = list(self.results.experiments[name]["scenes"])
            chosen = scene or (default_scene if default_scene in scenes else None)
            if chosen is None and len(scenes) != 1:
                raise KeyError(f"name one of the scenes {scenes}")
            return name, chosen or scenes[0]

        def values(row, column, scene=None, table=None):
            name, where = place(scene, table)
            self.results.row(name, row)
            return self.values_of(column, self.results.runs[name][(row, where)])

        def thesis(row, column, scene=None, table=None):
            name, where = place(scene, table)
            return self.their_number(column, self.results.row(name, row)["thesis"][where])

        def share(row, column, value, **place_of):
            return statistics.fmean(one >= value for one in values(row, column, **place_of))

        def truth(column, scene=None, table=None):
            name, where = place(scene, table)
            return float(self.results.scenes[name][where][column])

        def of(function):
            return lambda *args, **named: function(values(*args, **named))

        return {"mean": of(statistics.fmean), "median": of(statistics.median), "least": of(min), "greatest": of(max),
                "total": of(sum), "runs": of(len), "mean_root": of(lambda all: statistics.fmean(map(math.sqrt, all))),
                "share": share, "thesis": thesis, "truth": truth, "__builtins__": {}}

    def fill(self, text, experiment, scene=None):
        names = self.functions(experiment, scene)

        def figure(match):
            try:
                return format(eval(match[1], names), match[2] or "")  # noqa: S307 (the expressions are our own)
            except Exception as error:
                raise SystemExit(f"thesis/experiments/{experiment}.yaml: {match[0]} has no value: {error!r}") from error

        return PLACEHOLDER.sub(figure, text)


def main(paths):
    root = pathlib.Path(__file__).resolve().parent.parent.parent
    faults = []
    for path in map(pathlib.Path, paths or sorted((root / "thesis" / "experiments").glob("*.yaml"))):
        for where, text in texts_of(yaml.safe_load(path.read_text(encoding="utf-8"))).items():
            if fault_of(text):
                faults.append(f"{path.name}: {where}: a figure typed by hand: '{fault_of(text)}'; write {{mean(...)}} instead")
    print("\n".join(faults) or "no figure is typed by hand")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
