#!/usr/bin/env bash
# Runs the experiments (thesis/experiments/*.yaml) and writes evaluation.md with its plots.
#
#   scripts/report.sh [quick|full] [folder of the rows]    quick: two to three minutes, the page beside its rows in
#       build/evaluation_quick (default); full: a quarter of an hour on two cores, the counts of runs of the thesis, the
#       page in doc/results, its rows in doc/results/evaluation
#
# It installs and builds what is missing, and goes on where an interrupted run has ended. On several machines, each shard
# into a folder of its own; here eight with GNU parallel over two hosts, then the join:
#   parallel -S host1,host2 'cd concave_distance && build/devel/lib/concave_distance/evaluate thesis/experiments/*.yaml --size full --shard {}/8 --output shard_{}' ::: {0..7}
#   scripts/evaluation/keep_rows.py shard_* --output doc/results/evaluation && scripts/write_evaluation.py doc/results/evaluation
# As a Slurm array: sbatch --array=0-7 --wrap 'build/devel/lib/concave_distance/evaluate thesis/experiments/*.yaml --size full
# --shard $SLURM_ARRAY_TASK_ID/8 --output shard_$SLURM_ARRAY_TASK_ID'.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
size=${1:-quick}
case $size in
  quick | full) ;;
  *) die "name the size of the report: quick or full" ;;
esac
cd "$package_dir"
results=${2:-build/evaluation_$size}
# Tests install copies of their own below build/test.
program() { find build -path build/test -prune -o -type f -perm -u+x -name "$1" -print | head -n 1; }
scripts/install_dependencies.sh build plot
scripts/build.sh programs -DCONCAVE_DISTANCE_WITH_THESIS=ON
# Rows that are there are not run again: they have to be of this commit.
mkdir -p "$results"
[ -f "$results/commit" ] || git rev-parse HEAD >"$results/commit"
[ "$(git rev-parse HEAD)" = "$(cat "$results/commit")" ] || die "$results has rows of another commit: remove it"
"$(program evaluate)" thesis/experiments/*.yaml --size "$size" --output "$results"
if [ -n "$(program partition_benchmark)" ]; then  # built with CGAL only
  "$(program partition_benchmark)" --curves-output "$results/manoeuvre.csv"
fi
if [ "$size" = full ] && [ -n "$(program run_flops)" ]; then  # built with benchmarks and valgrind's headers only
  scripts/evaluation/count_run_flops.py --program "$(program run_flops)" --output "$results/run_flops.csv"
fi
if [ "$size" = quick ]; then
  mkdir -p "$results/images"
  scripts/plot_thesis_figures.py "$results" --output "$results/images"
  /usr/bin/python3 scripts/write_evaluation.py "$results" --output "$results/evaluation.md"
  exit
fi
kept=doc/results/evaluation
if [ -f "$results/manoeuvre.csv" ]; then
  cp "$results/manoeuvre.csv" doc/results/
fi
scripts/evaluation/keep_rows.py "$results" --output "$kept"
scripts/plot_thesis_figures.py "$kept" --output doc/results/images
/usr/bin/python3 scripts/write_evaluation.py "$kept"
test/scripts/check_results.py --record manoeuvre.csv "$kept"/*.csv.xz
