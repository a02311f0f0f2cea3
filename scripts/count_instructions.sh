#!/bin/sh
# Instructions of the cycles of a scene that asks for distance alone, with the code of the effects and with it
# compiled out, counted by valgrind's callgrind (scripts/install_dependencies.sh plot).
#
#   scripts/count_instructions.sh [build folder] [pair ...]
set -eu
cd "$(dirname "$0")/.."
build=${1:-build}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- battery_insertion kr5_bicep_palm peg_in_hole
programs=$build/devel/lib/concave_distance
counted() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect='*runCycles*' \
    "$programs/$1" --pair "$2" 2>&1 | sed -n 's/.*Collected : //p'
}
printf '%-20s %15s %15s %10s\n' pair 'with effects' 'compiled out' difference
for pair in "$@"; do
  with=$(counted distance_cycle "$pair")
  without=$(counted distance_cycle_without_effects "$pair")
  awk -v pair="$pair" -v with="$with" -v without="$without" \
    'BEGIN { printf "%-20s %15d %15d %9.4f%%\n", pair, with, without, 100 * (with - without) / without }'
done
