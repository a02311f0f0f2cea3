#!/usr/bin/env bash
# Runs the benchmark programs of a finished build and writes their figures to doc/results.
#
#   scripts/benchmark.sh [quick|full]     quick: minutes (default); full: an hour or more
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
size=${1:-quick}
case $size in
  quick) runs=200 niche_runs=60 steps=200 recall_steps=50 poses=3 seeds=4 ;;
  full) runs=1000 niche_runs=500 steps=500 recall_steps=200 poses=5 seeds=10 ;;
  *) echo "usage: scripts/benchmark.sh [quick|full]" >&2; exit 2 ;;
esac
program() { find "$root/build" -type f -perm -u+x -name "$1" | head -n 1; }
for name in tracking battery recall ablation; do
  [ -n "$(program "${name}_benchmark")" ] || { echo "${name}_benchmark is not built: run scripts/build.sh" >&2; exit 1; }
done
results=$root/doc/results
mkdir -p "$results"
"$(program tracking_benchmark)" --steps "$steps" --output "$results/tracking.csv" | tee "$results/tracking.txt"
"$(program battery_benchmark)" --runs "$runs" --niche-runs "$niche_runs" --output "$results/battery.csv" |
  tee "$results/battery.txt"
"$(program recall_benchmark)" --steps "$recall_steps" --output "$results/recall.csv" | tee "$results/recall.txt"
"$(program ablation_benchmark)" --poses "$poses" --seeds "$seeds" --output "$results/ablation.csv" |
  tee "$results/ablation.txt"
