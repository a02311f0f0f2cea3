"""What stands above the tables of evaluation.md."""

INTRODUCTION = """\
# The thesis's algorithms, evaluated

Every table of the thesis (Carretero) that its algorithms fill, with its figures beside ours. Written by
`scripts/report.sh` (`quick`, or `full` for the counts of runs kept here); the experiments are `experiments/*.yaml`.
Below each table stands what every row has run.

- **Rows of the thesis** come first and have nothing of ours: no elite, both children near the fitter parent (sec. 3.3.2.b),
  descents along edges and after mutation only (fig. 2.13), mating restriction with sharing only (4.7) and strict (4.6.3), annealing
  without new points (5.3.1.b), inheritance by (6.7) alone. A row that changes something names it.
- **`our operators`** are this package's: exchange of genes, random immigrants, an elite, conserved niches, an epsilon in the fitness,
  children on all of the path, mating restriction, descents in long steps, also of the first population. One at a time: see
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
  selection, sharing, sorting and random numbers included, counted by `scripts/count_run_flops.py` (each addition, multiplication, division and root;
  median of a few runs). An evaluation in a descent takes fewer than 26, as the moving body is not transformed for each neighbour.
  Times are of one core of a shared machine.
- recall, precision: of the outward niches of prominence 1e-2 that are proven to be all, in the final population (of a
  tracker: those it lists), by regions of the surfaces ([experiments](../experiments.md)). Nearest niche met: runs that have met it at all.
- Along a motion (`instants`) every figure is a mean over them.

![Figure 5.2: the sharing function](images/evaluation_sharing.png)
"""
