#!/usr/bin/env bash
# Runs the experiments (experiments/*.yaml) and writes doc/results/evaluation.md with its plots.
#
#   scripts/report.sh [quick|full] [folder of the results]    quick: one to two minutes (default); full: the counts of runs of
#                                                             the thesis, some minutes on two cores
#
# It installs and builds what is missing, and goes on where an interrupted run has ended. On several machines, each shard
# into a folder of its own; here eight with GNU parallel over two hosts, then the join:
#   parallel -S host1,host2 'cd concave_distance && build/devel/lib/concave_distance/evaluate experiments/*.yaml --size full --shard {}/8 --output shard_{}' ::: {0..7}
#   scripts/write_evaluation.py shard_*
# As a Slurm array: sbatch --array=0-7 --wrap 'build/devel/lib/concave_distance/evaluate experiments/*.yaml --size full
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
if [ ! -d build ] || [ -z "$(program evaluate)" ]; then scripts/build.sh; fi
"$(program evaluate)" experiments/*.yaml --size "$size" --output "$results"
if [ -n "$(program partition_benchmark)" ]; then  # built with CGAL only
  "$(program partition_benchmark)" --curves-output "$results/manoeuvre.csv"
fi
if [ "$size" = full ] && [ -n "$(program run_flops)" ]; then  # built with benchmarks and valgrind's headers only
  scripts/count_run_flops.py --program "$(program run_flops)" --output "$results/run_flops.csv"
fi
/usr/bin/python3 scripts/write_evaluation.py "$results"
