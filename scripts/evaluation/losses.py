"""Every figure in which the thesis's algorithm, run here, is worse than the thesis's own, with its reason."""
import math
import re
import statistics

from .figures import HEADINGS, SHARES, ours, their_number, theirs, values_of, wilson

NO_REASON = "no reason known"
LESS_IS_WORSE = ("niches", "most_niches")
MORE_IS_WORSE = {"distance": 0.5e-4, "worst_excess": 0.5e-5, "wrong_instants": 0.0, "kflop": 0.5,
                 "best_convergence": 0.5e-5}  # and by how much at least: half a digit of the thesis's


def is_pure(row):
    """Whether a row is the thesis's algorithm and nothing else."""
    return "thesis" in row and not row.get("variant_of") and row.get("base", "thesis") == "thesis"


def margin_of_mean(values):
    return 1.96 * statistics.pstdev(values) / math.sqrt(len(values))


def is_worse(column, thesis, runs):
    """Beyond the 95 % interval of our runs. A single run of the thesis is taken as it stands."""
    number = their_number(column, thesis)
    if number is None:
        return False
    if column in SHARES:
        successes = round(sum(values_of(column, runs)))
        if column == "basin":
            return number == 1.0 and successes < len(runs)
        return number > wilson(successes, len(runs))[1] + 1e-12
    values = values_of(column, runs) if column in LESS_IS_WORSE or column in MORE_IS_WORSE else []
    if column == "most_niches":
        return max(values) < number
    if column == "niches":
        is_mean = re.search(r"\[", theirs(column, thesis))
        return statistics.fmean(values) + margin_of_mean(values) < number - (0.005 if is_mean else 0.0)
    if column in ("best_convergence", "wrong_instants"):
        return statistics.fmean(values) - margin_of_mean(values) > number + MORE_IS_WORSE[column]
    return column in MORE_IS_WORSE and statistics.median(values) > number + MORE_IS_WORSE[column]


def reason_of(experiment, row, column, key="reasons"):
    """(text, rows that tested it, whether the reason is known); the row's own comes before its experiment's."""
    for reasons in (row.get(key, {}), experiment.get(key, {})):
        if column in reasons:
            reason = reasons[column]
            if isinstance(reason, str):
                return reason, [], True
            text = reason.get("text", "")
            return (f"**{NO_REASON}**. {text}" if reason.get("unknown") else text), reason.get("tested", []), not reason.get("unknown")
    return "", [], False


def is_single_run(column, thesis):
    return column not in ("exact", "standing", "region", "below_second", "kflop", "best_convergence") and "[" not in theirs(column, thesis)


def chance_of_counts(more, of_more, fewer, of_fewer):
    """Of two rates that are one: how often counts so far apart, or farther, are drawn (Fisher's exact test, one-sided)."""
    successes = more + fewer
    ways = sum(math.comb(of_more, i) * math.comb(of_fewer, successes - i)
               for i in range(more, min(of_more, successes) + 1))
    return ways / math.comb(of_more + of_fewer, successes)


def rate_words(column, thesis, runs):
    """(whether chance is reason enough, what it says) of two rates."""
    rate = re.fullmatch(r"(\d+)/(\d+)", theirs(column, thesis))
    if not rate:
        return False, ""
    chance = chance_of_counts(int(rate[1]), int(rate[2]), round(sum(values_of(column, runs))), len(runs))
    if chance < 0.05:
        return False, ""
    return True, f"{rate[2]} runs there: by chance counts are as far apart in {chance:.0%} of all cases (Fisher)."


def single_run_words(column, thesis, runs):
    """(whether chance is reason enough, what it says) of a single run of the thesis beside all of ours."""
    good = sum(not is_worse(column, thesis, [run]) for run in runs)
    return 20 * good >= len(runs), f"One run there; as good here: {good} of {len(runs)}."


def tested_words(runs_of, scene, column, tested):
    """The rows that test a reason, with their figures."""
    words = [f"{name.replace(';', ',')}: {ours(column, runs_of[(name, scene)])}" for name in tested if (name, scene) in runs_of]
    return f" Tried: {'; '.join(words)}." if words else ""


def losses_of(experiment, runs_of, fill):
    """Lines of the table. @param fill puts figures into a text's placeholders"""
    lines = []
    for row in filter(is_pure, experiment["rows"]):
        for scene, thesis in row["thesis"].items():
            runs = runs_of.get((row["name"], scene))
            for column in HEADINGS:
                if not runs or not is_worse(column, thesis, runs):
                    continue
                text, tested, is_known = reason_of(experiment, row, column)
                words = single_run_words if is_single_run(column, thesis) else rate_words
                is_chance, chance = words(column, thesis, runs)
                text = text if is_known else "" if is_chance else text or f"**{NO_REASON}**."
                text = fill(text, experiment["name"], scene)
                reason = " ".join(filter(None, [text, chance])) + tested_words(runs_of, scene, column, tested)
                lines.append(f"| {experiment.get('table', '')} | {row['name'].replace(';', ',')} | {scene.replace('_', ' ')} | "
                             f"{HEADINGS[column]} | {theirs(column, thesis)} | {ours(column, runs)} | {reason} |")
    return lines


def losses_section(lines):
    unexplained = sum(NO_REASON in line for line in lines)
    return ["", "## Losses", "",
            f"Every figure, {len(lines)} in all, in which the thesis's algorithm is worse here than in the thesis; "
            f"{unexplained} of them without a known reason.",
            "A rate, a mean or a count of niches is worse when the thesis's is outside of our 95 % interval; a median when it",
            "is worse by more than half of the thesis's last digit. Region: in any run, where the thesis's one run has it.",
            "Where the thesis has a single run, the reason is chance when at least one in twenty of ours is as good; of two rates,",
            "when runs of one rate differ as much in at least one of twenty cases. New pairs: see",
            "[what the losses come from](#what-the-losses-come-from-the-battery).", "",
            "| table | row | scene | figure | thesis | ours | reason |", "|---|---|---|---|---|---|---|", *lines]
