"""The dynamic comparison of the thesis's ch. 6, its picture and its table: for plot_results.py and write_evaluation.py.

Its data are `partition_benchmark --curves-output FILE`: five methods along the battery's manoeuvre.
"""
import csv
import math
import statistics

METHODS = [("partition", "convex partition + QP", "tab:brown"),
           ("comb-GA-wl-sh, Table 6.1", "comb-GA-wl-sh, Table 6.1 (thesis)", "tab:purple"),
           ("nodes", "pair tracker at nodes, shipped", "tab:blue"),
           ("refined", "pair tracker at refined, shipped", "tab:orange"),
           ("certified", "pair tracker at certified, shipped", "tab:green")]
# Carretero, sec. 6.3.3: Mflop of the first step and of all, steps that missed the best node pair and by how much, niches.
THESIS = {"partition": ("2.27", "1.545", "", ""),
          "comb-GA-wl-sh, Table 6.1": ("2.16", "2.032", "3 (9.88e-4)", "7.93 [11]")}
EXACT = 1e-12  # metres: an error of rounding alone; such points are drawn as a strip below the axis, a line for each method
STRIP = 1e-10


def read_curves(path):
    """{method: rows of numbers, in order of time}; empty without the file."""
    curves = {}
    if path.exists():
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                curves.setdefault(row["method"], []).append(
                    {key: float(value) for key, value in row.items() if key != "method"})
        missing = [method for method, _, _ in METHODS if method not in curves]
        if missing:
            raise SystemExit(f"{path}: has no {', '.join(missing)}; make it again with partition_benchmark --curves-output")
    return curves


def draw_manoeuvre(curves, plt, path):
    """Distance, error against the proven distance and processor time of every step over time."""
    figure, (distance, error, time) = plt.subplots(3, 1, figsize=(9, 10), sharex=True, layout="constrained",
                                                   gridspec_kw={"height_ratios": [1, 1.4, 1.2]})
    rows = {method: STRIP / 1.6 ** number for number, (method, _, _) in enumerate(METHODS)}

    def shown(value, row):
        return value if value > EXACT else row

    for method, label, colour in METHODS:
        steps = curves[method]
        times = [step["time"] for step in steps]
        distance.plot(times, [step["distance"] for step in steps], color=colour, label=label,
                      linewidth=1.2 if method == "certified" else 2.2, linestyle="--" if method == "certified" else "-")
        error.plot(times, [shown(abs(step["distance"] - step["exact"]), rows[method]) for step in steps], ".", color=colour,
                   label=label, markersize=4)
        time.plot(times, [step["us"] for step in steps], color=colour, label=label, linewidth=1.0)
    nodes = curves["nodes"]
    error.plot([step["time"] for step in nodes],
               [step["best_nodes"] - step["exact"] if step["best_nodes"] - step["exact"] > EXACT else math.nan for step in nodes],
               "k:", linewidth=1.0, label="best node pair (enumeration)")
    error.axhspan(0.5 * min(rows.values()), 2 * STRIP, color="0.93", zorder=0)
    error.set_ylim(0.5 * min(rows.values()), 2e-2)
    error.set_yscale("log")
    error.set_yticks([10.0 ** k for k in range(-9, -1)])
    error.text(-0.012, 0.04, "exact", transform=error.transAxes, ha="right", fontsize=9)
    distance.set_ylabel("distance, m")
    error.set_ylabel("error against the proven distance, m")
    time.set_yscale("log")
    time.set_ylabel("microseconds a step")
    time.set_xlabel("time, s")
    for axes in (distance, error, time):
        axes.grid(alpha=0.3)
    time.legend(*error.get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, -0.17), ncol=3, fontsize=8)
    distance.set_title("The battery's manoeuvre: approach until 10 s, then insertion")
    figure.savefig(path, dpi=90)
    plt.close(figure)


def manoeuvre_table(curves):
    """The lines of the table that stands below the picture."""
    lines = ["| method | error, largest (mean), ours | steps off the best node pair (most), thesis | ours | niches, mean [most], thesis | ours "
             "| Mflop, first step (mean), thesis | ours, evaluations alone | us, first step (mean) |", "|---" * 9 + "|"]
    for method, label, _ in METHODS:
        steps = curves[method]
        errors = [abs(step["distance"] - step["exact"]) for step in steps]
        off = [step["distance"] - step["best_nodes"] for step in steps if step["distance"] - step["best_nodes"] > 1e-12]
        niches = [step["niches"] for step in steps]
        times = [step["us"] for step in steps]
        mflop = [step["mflop"] for step in steps]
        first, mean, missed, found = THESIS.get(method, ("", "", "", ""))
        lines.append(
            f"| {label} | {max(errors):.1e} ({statistics.fmean(errors):.1e}) | {missed} "
            f"| {len(off)}{f' ({max(off):.1e})' if off else ''} "
            f"| {found} | {f'{statistics.fmean(niches):.2f} [{max(niches):.0f}]' if max(niches) else ''} "
            f"| {f'{first} ({mean})' if first else ''} | {mflop[0]:.2f} ({statistics.fmean(mflop):.3f}) "
            f"| {times[0]:.0f} ({statistics.fmean(times):.0f}) |")
    return lines
