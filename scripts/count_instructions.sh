#!/bin/sh
# Instructions of the cycles of a pair that asks for distance alone, apart and in contact, with the code of the
# effects and with it compiled out, counted by valgrind's callgrind (scripts/install_dependencies.sh plot).
# Without a pair: of the usual ones, and writes doc/results/instructions.csv.
# Fails where any two counts differ.
#
#   scripts/count_instructions.sh [build folder] [pair ...]
set -eu
cd "$(dirname "$0")/.."
build=${1:-build}
[ $# -gt 0 ] && shift
file=
if [ $# -eq 0 ]; then
  file=doc/results/instructions.csv
  set -- battery_insertion kr5_bicep_palm peg_in_hole
fi
programs=$build/devel/lib/concave_distance
rows=$(mktemp)
trap 'rm -f "$rows"' EXIT
# LD_BIND_NOW: looking up a function at its first call takes more or less by the program's own symbols.
counted() {
  program=$1
  shift
  LD_BIND_NOW=1 valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect='*runCycles*' \
    "$programs/$program" "$@" 2>&1 | sed -n 's/.*Collected : //p'
}
echo pair,state,with_effects,compiled_out >"$rows"
for pair in "$@"; do
  for state in apart contact; do
    option=
    [ $state = contact ] && option=--contact
    # shellcheck disable=SC2086
    echo "$pair,$state,$(counted distance_cycle --pair "$pair" $option),$(
      counted distance_cycle_without_effects --pair "$pair" $option)" | tee -a "$rows"
  done
done
if [ -n "$file" ]; then
  cp "$rows" "$file"
  test/scripts/check_results.py --record "$file"
fi
awk -F, 'NR > 1 && $3 != $4 { different = 1 } END { exit different }' "$rows"
