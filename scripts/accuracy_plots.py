"""Draws doc/results/accuracy.csv: error against time, with what makes no error in a strip of its own below the axis."""
import math

NO_ERROR = 1e-9  # of the smaller body's diameter: an answer that differs less is the exact one and rounding
LEAST_SHOWN, MOST_SHOWN = 1e-7, 5.0  # of the axis
# Okabe and Ito's colours, which differ for every kind of eye.
BLUE, SKY, GREEN, ORANGE, RED, PURPLE, BLACK, GREY = ("#0072B2", "#56B4E9", "#009E73", "#E69F00", "#D55E00", "#CC79A7",
                                                      "black", "0.45")
# kind: (colour, marker, label of the legend)
APPROXIMATE = {
    "nodes": (BLUE, "o", "nodes"),
    "tolerance": (RED, "v", "certified within a tolerance"),
    "budget": (ORANGE, "D", "certified with a time budget"),
    "refined": (GREEN, "s", "refined, where it missed the nearest niche"),
    "random": (SKY, "P", "descents from random starts"),
    "annealing": (GREY, "X", "annealing, with descents and without"),
    "continuous": (PURPLE, "^", "continuous GA and SA"),
}
# Rows of the strip, from above: (kinds, colour, marker, label).
STRIP = [
    (("proof",), RED, "o", "certified, distance"),
    (("tolerance", "budget"), ORANGE, "D", "the same, bounded"),
    (("all niches",), RED, "s", "certified, all niches"),
    (("refined",), GREEN, "s", "refined, niches found"),
    (("FCL",), BLACK, "o", "FCL, distance"),
    (("partition",), PURPLE, "^", "convex partition"),
]
# Where an exact method makes an error, it stands above like the others.
STYLES = {**{kind: (colour, marker) for kinds, colour, marker, _ in STRIP for kind in kinds},
          **{kind: (colour, marker) for kind, (colour, marker, _) in APPROXIMATE.items()}}


def kind_of(row):
    method, setting = row["method"], row["setting"]
    if method == "certified":
        if setting == "all niches":
            return "all niches"
        return "proof" if setting == "tolerance 0" else setting.split()[0]
    if method.startswith("comb-SA"):
        return "annealing"
    if method.startswith("cont-"):
        return "continuous"
    if method.startswith("partition"):
        return "partition"
    return {"multi-start descent": "random"}.get(method, method)


def has_no_error(row):
    """Of the kinds that the strip has a row for."""
    return float(row["largest_error"]) <= NO_ERROR and any(kind_of(row) in kinds for kinds, *_ in STRIP)


def largest_errors_in_strip(rows):
    """Of what is exact, and of proofs that were cut short but made no error; two digits, rounded up."""
    def largest(is_cut_short):
        errors = [float(row["largest_error"]) for row in rows
                  if has_no_error(row) and (kind_of(row) in ("tolerance", "budget")) == is_cut_short]
        power = 10.0 ** (math.floor(math.log10(max(errors))) - 1)
        return f"{math.ceil(max(errors) / power) * power:.1e}".replace("e-0", "e-")
    return largest(False), largest(True)


def draw_errors(axes, rows, hollow=False):
    """Largest errors, with a line down to the median; what is less than the axis shows stands at its bottom."""
    for row in rows:
        if has_no_error(row):
            continue
        colour, marker = STYLES[kind_of(row)]
        time = float(row["median_us"])
        median, largest = (min(max(float(row[name]), LEAST_SHOWN), MOST_SHOWN) for name in ("median_error", "largest_error"))
        axes.plot([time, time], [median, largest], color=colour, linewidth=0.8, alpha=0.5, zorder=1)
        axes.plot(time, largest, marker, color=colour, markersize=5, alpha=0.85, markeredgewidth=0.9, zorder=2,
                  markerfacecolor="white" if hollow else colour)
    axes.set_yscale("log")
    axes.set_ylim(0.7 * LEAST_SHOWN, MOST_SHOWN)
    axes.set_yticks([1e-6, 1e-4, 1e-2, 1], ["1e-6", "1e-4", "0.01", "1"], fontsize=8)
    axes.grid(alpha=0.3)


def draw_strip(axes, rows, strip=STRIP, hollow=False, shift=0.0):
    """Times of what makes no error, a row for each kind."""
    for place, (kinds, *_) in enumerate(strip):
        for row in rows:
            if kind_of(row) in kinds and has_no_error(row):
                colour, marker = STYLES[kind_of(row)]
                axes.plot(float(row["median_us"]), place + shift, marker, color=colour, markersize=5, alpha=0.85,
                          markeredgewidth=0.9, markerfacecolor="white" if hollow else colour)
    axes.set_ylim(len(strip) - 0.5, -0.5)
    axes.set_yticks(range(len(strip)), [label for *_, label in strip], fontsize=8)
    axes.tick_params(axis="y", length=0)
    axes.set_facecolor("0.95")
    axes.grid(axis="x", alpha=0.3)


def legend_handles(plt, kinds):
    return [plt.Line2D([], [], linestyle="", marker=marker, color=colour, label=label)
            for kind, (colour, marker, label) in APPROXIMATE.items() if kind in kinds]


def draw_pairs(rows, mode, plt, path):
    """Every setting, pair by pair: the pairs that the package was developed with above, those held out below."""
    rows = [row for row in rows if row["mode"] == mode]
    groups = [(name, list(dict.fromkeys(row["pair"] for row in rows if row["set"] == name))) for name in ("tuned", "held out")]
    lines = [(name, pairs[i:i + 3]) for name, pairs in groups for i in range(0, len(pairs), 3)]
    figure = plt.figure(figsize=(11, 0.7 + 3.4 * len(lines)))
    outer = figure.add_gridspec(len(lines), 3, left=0.16, right=0.985, top=0.965, bottom=0.09, wspace=0.06, hspace=0.22)
    times = [float(row["median_us"]) for row in rows]
    limits = (0.6 * min(times), 1.6 * max(times))
    for line, (name, pairs) in enumerate(lines):
        for column, pair in enumerate(pairs):
            of_pair = [row for row in rows if row["pair"] == pair]
            parts = outer[line, column].subgridspec(2, 1, height_ratios=(1.5, 1), hspace=0.04)
            upper, lower = parts.subplots(sharex=True)
            draw_errors(upper, of_pair)
            draw_strip(lower, of_pair)
            upper.set_title(f"{pair} ({name})", fontsize=10)
            upper.set_xscale("log")
            upper.set_xlim(limits)
            upper.tick_params(axis="x", length=0)
            if column:
                upper.set_yticklabels([])
                lower.set_yticklabels([])
            else:
                upper.set_ylabel("error / diameter:\nlargest, line to median", fontsize=8)
            if line == len(lines) - 1:
                lower.set_xlabel("microseconds a query (median)")
    exact, cut_short = largest_errors_in_strip(rows)
    figure.legend(handles=legend_handles(plt, {kind_of(row) for row in rows if not has_no_error(row)}), loc="lower center",
                  ncol=4, fontsize=9, title="Grey strips: no error at any instant (the largest: "
                  f"{exact} of the diameter, {cut_short} where a proof was cut short)", title_fontsize=9)
    figure.savefig(path, dpi=90)
    plt.close(figure)


# The summary has what a user can choose: (kind, setting, label) above the strip, and these rows of it.
SUMMARY = [("nodes", "shipped", "nodes, as shipped"), ("tolerance", "tolerance 0.1", "certified, tolerance 10 %"),
           ("budget", "budget 10 us", "certified, time budget 10 us"),
           ("refined", "all niches", "refined, where it missed the nearest")]
SUMMARY_STRIP = [(("proof",), RED, "o", "certified: distance"), (("tolerance", "budget"), ORANGE, "D", "the same, bounded"),
                 (("all niches",), RED, "s", "certified: all niches"), (("refined",), GREEN, "s", "refined: niches found"),
                 (("FCL",), BLACK, "o", "FCL: distance")]


def of_summary(row):
    kind = kind_of(row)
    if kind in ("proof", "all niches") or (kind == "FCL" and row["setting"] == "plain"):
        return True
    return any(kind == chosen and row["setting"] == setting for chosen, setting, _ in SUMMARY)


def draw_summary(rows, plt, path):
    """What the levels cost on all pairs: filled where the package was developed with them, hollow where not."""
    rows = [row for row in rows if of_summary(row)]
    figure, axes = plt.subplots(2, 2, figsize=(10, 5.8), sharex="all", sharey="row", height_ratios=(1.3, 1))
    titles = {"cold": "cold: nothing is known", "tracked": "tracked at 40 Hz: the last answer is known"}
    for column, (mode, title) in enumerate(titles.items()):
        upper, lower = axes[:, column]
        of_mode = [row for row in rows if row["mode"] == mode]
        for name, hollow, shift in (("tuned", False, -0.19), ("held out", True, 0.19)):
            draw_errors(upper, [row for row in of_mode if row["set"] == name], hollow)
            draw_strip(lower, [row for row in of_mode if row["set"] == name], SUMMARY_STRIP, hollow, shift)
        upper.set_xscale("log")
        upper.set_title(title, fontsize=10)
        lower.set_xlabel("microseconds a query (median of a pair)")
    axes[0, 0].set_ylabel("error / diameter\n(largest, line to median)", fontsize=9)
    axes[1, 0].set_ylabel("no error", fontsize=9)
    handles = [plt.Line2D([], [], linestyle="", marker=APPROXIMATE[kind][1], color=APPROXIMATE[kind][0], label=label)
               for kind, _, label in SUMMARY]
    handles += [plt.Line2D([], [], linestyle="", marker="o", color=BLACK, markerfacecolor=fill, label=label)
                for fill, label in ((BLACK, "pairs used for development"), ("white", "pairs held out"))]
    figure.legend(handles=handles, loc="lower center", ncol=3, fontsize=9)
    figure.tight_layout(rect=(0, 0.1, 1, 1), h_pad=0.3)
    figure.savefig(path, dpi=90)
    plt.close(figure)


def draw_budgets(rows, plt, path):
    """What a cold proof that is cut short leaves open in nine of ten queries, and the budget that leaves nothing."""
    rows = [row for row in rows if row["mode"] == "cold" and row["setting"].startswith("budget")]
    figure, axes = plt.subplots(2, 2, figsize=(10, 5.8), sharex="all", height_ratios=(1.6, 1))
    for column, (name, title) in enumerate((("tuned", "pairs used for development"), ("held out", "pairs held out"))):
        upper, lower = axes[:, column]
        pairs = list(dict.fromkeys(row["pair"] for row in rows if row["set"] == name))
        for place, (pair, colour, marker) in enumerate(zip(pairs, (RED, ORANGE, GREEN, SKY, BLUE, BLACK), "osDv^X")):
            gaps = [(float(row["setting"].split()[1]), float(row["p90_gap"])) for row in rows if row["pair"] == pair]
            left = [(budget, gap) for budget, gap in gaps if gap > NO_ERROR]
            upper.plot(*zip(*left or [(math.nan, math.nan)]), marker=marker, color=colour)
            done = [budget for budget, gap in gaps if gap <= NO_ERROR]
            lower.plot(done, [place] * len(done), marker, color=colour)
        upper.set_xscale("log")
        upper.set_yscale("log")
        upper.set_ylim(1e-4, MOST_SHOWN)
        upper.set_title(title, fontsize=10)
        upper.grid(alpha=0.3)
        lower.set_yticks(range(len(pairs)), pairs, fontsize=8)
        lower.set_ylim(len(pairs) - 0.5, -0.5)
        lower.set_facecolor("0.95")
        lower.grid(axis="x", alpha=0.3)
        lower.set_xlabel("time budget of a cold proof, microseconds")
    axes[0, 0].set_ylabel("(distance - lower bound) / diameter\n90th percentile", fontsize=9)
    axes[1, 0].set_ylabel("nothing left", fontsize=9)
    figure.tight_layout(h_pad=0.3)
    figure.savefig(path, dpi=90)
    plt.close(figure)
