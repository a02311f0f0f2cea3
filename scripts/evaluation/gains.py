"""Every figure in which the thesis's algorithm, run here, is better than the thesis's own, with its reason."""
import re
import statistics

from .figures import HEADINGS, SHARES, ours, their_number, theirs, values_of, wilson
from .losses import (LESS_IS_WORSE, MORE_IS_WORSE, NO_REASON, chance_of_counts, is_pure, is_single_run, margin_of_mean, reason_of,
                     tested_words)


def is_better_rate(column, thesis, runs):
    rate = re.fullmatch(r"(\d+)/(\d+)", theirs(column, thesis))
    successes = round(sum(values_of(column, runs)))
    return (rate is not None and int(rate[1]) / int(rate[2]) < wilson(successes, len(runs))[0] - 1e-12
            and chance_of_counts(successes, len(runs), int(rate[1]), int(rate[2])) < 0.05)


def is_better_mean(column, thesis, runs):
    """Beyond the 95 % interval of our runs and half of the thesis's last digit."""
    if column not in ("niches", "best_convergence"):
        return False
    number, values = their_number(column, thesis), values_of(column, runs)
    gain = statistics.fmean(values) - number
    if column in LESS_IS_WORSE:
        return gain - margin_of_mean(values) > 0.005
    return -gain - margin_of_mean(values) > MORE_IS_WORSE[column]


def is_better_than_single_run(column, thesis, runs):
    """Fewer than one in twenty of our runs are as bad as the thesis's one."""
    number, values = their_number(column, thesis), values_of(column, runs)
    if column in LESS_IS_WORSE:
        return 20 * sum(value <= number for value in values) < len(values)
    return 20 * sum(value > number - MORE_IS_WORSE[column] for value in values) < len(values)


def is_better(column, thesis, runs):
    if column == "kflop" or their_number(column, thesis) is None:
        return False
    if column in SHARES:
        return is_better_rate(column, thesis, runs)
    if column not in LESS_IS_WORSE and column not in MORE_IS_WORSE:
        return False
    return (is_better_than_single_run if is_single_run(column, thesis) else is_better_mean)(column, thesis, runs)


def gains_of(experiment, runs_of, fill):
    """Lines of the table. @param fill puts figures into a text's placeholders"""
    lines = []
    for row in filter(is_pure, experiment["rows"]):
        for scene, thesis in row["thesis"].items():
            runs = runs_of.get((row["name"], scene))
            for column in HEADINGS:
                if not runs or not is_better(column, thesis, runs):
                    continue
                text, tested, _ = reason_of(experiment, row, column, "better")
                reason = fill(text or f"**{NO_REASON}**.", experiment["name"], scene) + tested_words(runs_of, scene, column, tested)
                lines.append(f"| {experiment.get('table', '')} | {row['name'].replace(';', ',')} | {scene.replace('_', ' ')} | "
                             f"{HEADINGS[column]} | {theirs(column, thesis)} | {ours(column, runs)} | {reason} |")
    return lines


def gains_section(lines):
    unexplained = sum(NO_REASON in line for line in lines)
    return ["", "## Better than the thesis", "",
            f"Every figure, {len(lines)} in all, in which the thesis's algorithm is better here than in the thesis; {unexplained} of them without",
            "a known reason. A rate is better when the thesis's is below our 95 % interval and chance is excluded as above; a single run of",
            "the thesis, when fewer than one in twenty of ours are as bad. kflop, fewer in nearly all rows, are left out: the thesis does not",
            "say what its counts hold.", "",
            "| table | row | scene | figure | thesis | ours | reason |", "|---|---|---|---|---|---|---|", *lines]
