"""What stands above the tables of evaluation.md."""

# Sec. 3.3.2.c leaves open how far a mutant goes, and whose probability p_m is; the figures decide.
_MUTATION = """\
- **Mutation**: each gene becomes a random node with probability p_m. In sec. 3.3.2.c one gene of x or both are modified at random, to x_rand, and the
  mutant is any offspring of x and x_rand within an r_max that is not stated; whether p_m is a gene's or an individual's is not said. The tables
  decide: x_rand itself, each gene for itself. With p_m 0.05 Table 5.18 finds the best pair in generation
  {thesis('comb-GA-wl; p_m 0.05', 'best_iteration', table='table_5_18'):.1f} in the thesis, {mean('comb-GA-wl; p_m 0.05', 'best_iteration', table='table_5_18'):.1f} here,
  {mean('comb-GA-wl; N_pop 20; G_max 100; random moves', 'best_iteration', table='losses_battery'):.1f} when an individual goes a part of the way (`random moves`); with p_m 0.02
  {thesis('comb-GA-wl; p_m 0.02', 'exact', table='table_5_18'):.0%} of the runs end at it there, {mean('comb-GA-wl; p_m 0.02', 'exact', table='table_5_18'):.0%} here. Phi* of p_x 0.6 in
  Table 5.14: {thesis('p_x 0.6', 'exact', table='table_5_14'):.1%}, {mean('p_x 0.6', 'exact', table='table_5_14'):.1%} and
  {mean('comb-GA-wl; N_pop 40; G_max 30; random moves', 'exact', table='losses_battery'):.1%} with random moves. A random pair a generation in place of mutation does as well on the
  battery ({mean('comb-GA-wl; N_pop 40; G_max 30; one new pair a generation', 'exact', table='losses_battery'):.1%}), but not without descents: Phi of comb-GA-nl in
  position 1 of Table 5.3 is {thesis('comb-GA-nl; N_pop 80', 'region', table='table_5_3', scene='boxes_position_1'):.0%} there,
  {mean('comb-GA-nl; N_pop 80', 'region', table='table_5_3', scene='boxes_position_1'):.0%} here,
  {mean('comb-GA-nl; N_pop 80; G_max 100; random moves', 'region', table='losses_no_descent', scene='boxes_position_1'):.0%} with random moves,
  {mean('comb-GA-nl; N_pop 80; G_max 100; one new pair a generation', 'region', table='losses_no_descent', scene='boxes_position_1'):.0%} with a random pair.
  Not run again since, and with random moves still: the thesis's row of the ablation.
"""

# Sec. 4.6.3 leaves open what happens to a parent without a partner; where their rows are there, the figures decide.
_STRICT = """\
- **Strict mating restriction**: who finds no partner within sigma_m does not mate. Sec. 4.6.3 seeks another couple and names no limit; that
  others try twice and then take anybody stands in sec. 4.5. The tables decide. N_pop 100 of Table 5.9 keeps
  {thesis('N_pop 100', 'niches', table='table_5_9'):.1f} niches in the thesis, {mean('N_pop 100', 'niches', table='table_5_9'):.1f} here when strict,
  {mean('comb-GA-wl-sh; N_pop 100; sigma_m 0.65; two tries; then anybody', 'niches', table='losses_battery'):.1f} with two tries; p_x 0.6 of Table 5.17
  {thesis('p_x 0.6', 'niches', table='table_5_17'):.1f}, {mean('p_x 0.6', 'niches', table='table_5_17'):.1f} and
  {mean('comb-GA-wl-sh; N_pop 100; G_max 15; two tries; then anybody', 'niches', table='losses_battery'):.1f}.
"""

_TEXT = """\
# The thesis's algorithms, evaluated

Every table of the thesis (Carretero) that its algorithms fill, with its figures beside ours. Written by
`scripts/report.sh` (`quick`, or `full` for the counts of runs kept here); the experiments are `thesis/experiments/*.yaml`.
Below each table stands what every row has run.

- **Rows of the thesis** come first and have nothing of ours: no elite, both children near the fitter parent (sec. 3.3.2.b),
  descents along edges and after mutation only (fig. 2.13), mating restriction with sharing only (4.7) and strict (below), annealing
  without new points (5.3.1.b), inheritance by (6.7) alone. A row that changes something names it.
@MUTATION@@STRICT@- **`our operators`** are this package's: exchange of genes, random immigrants, an elite, conserved niches, an epsilon in the fitness,
  children on all of the path, random moves, mating restriction, also of the first population. One at a time: see
  [the switches](#from-the-thesiss-algorithm-to-ours-one-switch-at-a-time). **`shipped`** is what a pair's tracker runs by default,
  of a search its cold one.
- Phi*: runs that end at the best node pair there is (by enumeration); Phi: in its region (1.1 times its distance, nearer than the
  second local minimum). `(below)`: the thesis's rate is above the upper end of our 95 % interval (Wilson).
- Region (Tables 2.3 to 3.5): the thesis's sign of an answer in the neighbourhood of the optimum, which it gives at distances far above Phi's
  limit. Ours: Phi, or a descent over the nodes from the answer ends in the region of the optimum on the surfaces.
- G_i: the generation (iteration) in which the run's best appeared; N_Gamma: niches of the final population: mean [least-most] deviation.
- x*', x': averages of the best and of the mean objective over a run, over the optimum's (5.1, 5.2).
- kflop: by the thesis's rule, 26 for each point pair looked at (a step of a descent looks at about five) and 6 for each constraint: median [least-most].
  These are the evaluations alone; the thesis does not say whether its counts hold more. kflop executed, thousand instructions: of all that a run does,
  selection, sharing, sorting and random numbers included, counted by `scripts/evaluation/count_run_flops.py` (each addition, multiplication, division and root;
  median of a few runs). An evaluation in a descent takes fewer than 26, as the moving body is not transformed for each neighbour.
  Times are of one core of a shared machine.
- recall, precision: of the outward niches of prominence 1e-2 that are proven to be all, in the final population (of a
  tracker: those it lists), by regions of the surfaces ([experiments](../../thesis/doc/experiments.md)). Nearest niche met: runs that have met it at all.
- Along a motion (`instants`) every figure is a mean over them.

![Figure 5.2: the sharing function](images/evaluation_sharing.png)
"""


def introduction(quoter):
    """Its lines; without the rows that decide on what the thesis leaves open also without their figures."""
    runs = quoter.results.runs
    text = _TEXT
    for mark, words, tables in (("@MUTATION@", _MUTATION, ("table_5_3", "table_5_14", "table_5_18", "losses_no_descent")),
                                ("@STRICT@", _STRICT, ("table_5_9", "table_5_17"))):
        decided = all(runs.get(name) for name in (*tables, "losses_battery"))
        text = text.replace(mark, quoter.fill(words, "losses_battery") if decided else "")
    return text.splitlines()
