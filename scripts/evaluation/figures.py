"""One figure of a row: ours over its runs, the thesis's as its table has it."""
import math
import re
import statistics

NICHE_COUNT = 10
ROUNDING = 1e-12  # metres; what is less is none
HEADINGS = {
    "exact": "Phi*", "standing": "Phi* of who stands there", "region": "Phi", "basin": "Region", "best_iteration": "G_i", "niches": "N_Gamma",
    "distance": "distance", "kflop": "kflop", "kflop_executed": "kflop executed",
    "kinstructions": "thousand instructions", "recall": "recall", "archive_recall": "recall of all minima met",
    "precision": "precision", "best_convergence": "x*'", "population_convergence": "x'",
    "niche_members": "individuals of the nearest niches", "niche_distances": "distances of the nearest niches",
    "below_second": "nearer than the second niche", "nearest": "nearest niche met", "exact_instants": "exact",
    "proof_finds": "found by the proof", "evaluations": "node pairs looked at",
    "wrong_instants": "instants not the optimum", "worst_excess": "worst excess, m", "most_niches": "most niches",
    "ms": "ms",
}
SHARES = ("exact", "standing", "region", "basin", "below_second")


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


def values_of(column, runs):
    """A number for each run."""
    if column == "kflop":
        return [float(run["flops"]) / 1000 for run in runs]
    if column == "ms":
        return [float(run["microseconds"]) / 1000 for run in runs]
    return [float(run[column]) for run in runs]


def ours(column, runs):
    """Our figure of a column over the runs of a row on a scene, as a table shows it."""
    if column in ("kflop_executed", "kinstructions"):
        return runs[0][column]
    if column == "niche_members":
        return niche_means(runs, "members", 1)
    if column == "niche_distances":
        return niche_means(runs, "niche_distance", 4)
    if column == "exact_instants":
        return f"{1 - statistics.fmean(values_of('wrong_instants', runs)) / int(runs[0]['instants']):.3f}"
    if column not in HEADINGS:
        raise SystemExit(f"no column is called {column}")
    values = values_of(column, runs)
    if column in SHARES:
        return f"{sum(values):.0f}/{len(runs)}"
    if column == "distance":
        return median_range(values)
    if column == "kflop":
        return median_range(values, 0)
    if column == "wrong_instants":
        return spread(values, 1)
    if column in ("best_iteration", "niches"):
        return spread(values, 2)
    if column == "worst_excess":
        words = [f"{value:.1e}" if value > ROUNDING else "0" for value in (statistics.median(values), min(values), max(values))]
        return f"{words[0]} [{words[1]}-{words[2]}]"
    if column == "most_niches":
        return f"{max(values):.0f}"
    if column == "ms":
        return f"{statistics.median(values):.2f}"
    digits = {"proof_finds": 1, "evaluations": 0, "best_convergence": 5, "population_convergence": 5}.get(column, 3)
    return f"{statistics.fmean(values):.{digits}f}"


def has_column(row, column):
    """Enumeration answers with one pair and looks for no niches."""
    return row["algorithm"] != "enumeration" or column not in ("recall", "archive_recall", "precision", "nearest", "niches")


def theirs(column, thesis):
    """The thesis's figure as its table has it; "" where it has none."""
    value = thesis.get(column)
    if column == "basin" and isinstance(value, bool):
        return "yes" if value else "no"
    if column == "kflop" and value is None and "mflop" in thesis:
        return f"{1000 * thesis['mflop']:.0f}"
    return "" if value is None else str(value)


def their_number(column, thesis):
    """The thesis's figure as a number: a rate in [0, 1], a mean, or the figure itself; None where it has none."""
    text = theirs(column, thesis)
    if text in ("yes", "no"):
        return float(text == "yes")
    rate = re.fullmatch(r"(\d+)/(\d+)", text)
    if rate:
        return int(rate[1]) / int(rate[2])
    number = re.match(r"[\d.]+(?:e-?\d+)?", text)
    return float(number[0]) if number else None
