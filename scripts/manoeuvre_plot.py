"""The dynamic comparison of the thesis's ch. 6 as a picture: for plot_results.py and write_evaluation.py.

Its data are `partition_benchmark --curves-output FILE`: four methods along the battery's manoeuvre.
"""
import csv

METHODS = [("partition", "convex partition + QP", "tab:brown"), ("nodes", "comb-GA-wl-sh, nodes", "tab:blue"),
           ("refined", "the same, refined", "tab:orange"), ("certified", "the same, certified", "tab:green")]
FLOOR = 1e-17  # an error of nothing, on a logarithmic axis


def read_curves(path):
    """{method: rows of numbers, in order of time}; empty without the file."""
    curves = {}
    if path.exists():
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                curves.setdefault(row["method"], []).append(
                    {key: float(value) for key, value in row.items() if key != "method"})
    return curves


def draw_manoeuvre(curves, plt, path):
    """Distance, error against the proven distance and processor time of every step over time."""
    figure, (distance, error, time) = plt.subplots(3, 1, figsize=(9, 10), sharex=True,
                                                   gridspec_kw={"height_ratios": [1, 1.4, 1.2]})
    for method, label, colour in METHODS:
        steps = curves[method]
        times = [step["time"] for step in steps]
        distance.plot(times, [step["distance"] for step in steps], color=colour, label=label,
                      linewidth=1.2 if method == "certified" else 2.2, linestyle="--" if method == "certified" else "-")
        error.plot(times, [max(FLOOR, abs(step["distance"] - step["exact"])) for step in steps], ".-", color=colour,
                   label=label, markersize=3, linewidth=0.6)
        time.plot(times, [step["us"] for step in steps], color=colour, label=label, linewidth=1.0)
    nodes = curves["nodes"]
    error.plot([step["time"] for step in nodes], [max(FLOOR, step["best_nodes"] - step["exact"]) for step in nodes],
               "k:", linewidth=1.0, label="best node pair (enumeration)")
    distance.set_ylabel("distance, m")
    error.set_yscale("log")
    error.set_ylabel("error against the proven distance, m")
    time.set_yscale("log")
    time.set_ylabel("microseconds a step")
    time.set_xlabel("time, s")
    for axes in (distance, error, time):
        axes.grid(alpha=0.3)
    error.legend(fontsize=8, loc="upper left", bbox_to_anchor=(0.0, 0.6))
    distance.set_title("The battery's manoeuvre: approach until 10 s, then insertion")
    figure.tight_layout()
    figure.savefig(path, dpi=90)
    plt.close(figure)
