#!/usr/bin/python3
"""Writes doc/results/evaluation.md and its plots from the results of `evaluate`.

    scripts/write_evaluation.py RESULTS [MORE_RESULTS ...] [--output doc/results/evaluation.md]

RESULTS are folders that `evaluate --output` or `keep_rows.py` has filled; the files of several, one for each shard, are
joined.
Every experiment of thesis/experiments/*.yaml that has results is written, with the thesis's figures beside ours, before them every
figure in which ours is worse or better. How a remark quotes a figure: scripts/evaluation/texts.py.
"""
import argparse
import pathlib

from evaluation.figures import their_number, values_of
from evaluation.gains import gains_of, gains_section
from evaluation.introduction import introduction
from evaluation.losses import losses_of, losses_section
from evaluation.plots import curves_of, drawn_section, manoeuvre_section, plot_curves, plot_sharing
from evaluation.rows import ROOT, Results, order_of, read_experiments, read_rows, with_counted_work
from evaluation.solution_figures import pictures_of
from evaluation.tables import described, parameters_section, write_by_scene, write_table
from evaluation.texts import Quoter


def experiment_section(experiment, results, quoter, counted, images):
    """Heading, scenes, table, remarks, parameters and figures of an experiment."""
    name = experiment["name"]
    runs_of, scenes = results.runs[name], results.scenes[name]
    number = (f"Table {experiment['table']}: " if "table" in experiment
              else f"Figures {experiment['figure']}: " if "figure" in experiment else "")
    experiment["columns"] = with_counted_work(experiment, runs_of, counted)
    counts = set()
    lines = []
    write = write_by_scene if experiment.get("layout") == "by_scene" else write_table
    write(lines, experiment, runs_of, counts, scenes)
    places = "; ".join(described(scene, scenes[scene]) for scene in experiment["scenes"] if scene in scenes)
    remark = quoter.fill(experiment.get("remark", ""), name)
    section = ["", f"## {number}{experiment['title']}", "",
               f"Runs of each row: {', '.join(str(count) for count in sorted(counts))}. Metres; {places}. {remark}".rstrip(), "",
               *lines]
    if experiment.get("note"):
        section += ["", quoter.fill(experiment["note"], name).strip()]
    section += parameters_section(experiment, results.folders)
    curves = curves_of(results.folders, name)
    for file_name, label in plot_curves(experiment, curves, images) if curves else []:
        section += ["", f"![{label}](images/{file_name})"]
    for file_name, label in pictures_of(name, images):  # by scripts/plot_thesis_figures.py
        section += ["", f"![{label}](images/{file_name})"]
    return section


def page(results, images):
    """All lines of the page; its plots are written on the way."""
    quoter = Quoter(results, their_number, values_of)
    counted = read_rows(results.folders, "run_flops.csv")
    manoeuvre = drawn_section(images) + manoeuvre_section(results.folders, images)
    plot_sharing(images)
    body = []
    losses, gains = [], []
    for name, experiment in results.experiments.items():
        if order_of(experiment) > [6, 7]:
            body += manoeuvre
            manoeuvre = []
        if results.runs[name]:
            body += experiment_section(experiment, results, quoter, counted, images)
            losses += losses_of(experiment, results.runs[name], quoter.fill)
            gains += gains_of(experiment, results.runs[name], quoter.fill)
    return introduction(quoter) + losses_section(losses) + gains_section(gains) + body + manoeuvre


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="+")
    parser.add_argument("--output", default=str(ROOT / "doc" / "results" / "evaluation.md"))
    options = parser.parse_args()
    images = pathlib.Path(options.output).parent / "images"
    images.mkdir(exist_ok=True)
    results = Results(read_experiments(), options.results)
    pathlib.Path(options.output).write_text("\n".join(page(results, images)) + "\n", encoding="utf-8")
    print(options.output)


if __name__ == "__main__":
    main()
