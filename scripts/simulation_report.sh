#!/bin/bash
# Runs the contact scenes of config/ with `simulate`, writes what it says into doc/results/simulation.txt, the times of
# fig. 4.1 into doc/results/two_feet.csv and draws doc/images/simulation_*.png.
#
#   scripts/simulation_report.sh [build folder] [folder for the CSV files]
set -eu
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="${1:-$root/build}"
output="${2:-$(mktemp -d)}"
simulate="$build/devel/lib/concave_distance/simulate"
[ -x "$simulate" ] || { echo "$simulate is not there: build the target simulate" >&2; exit 1; }
export ROS_PACKAGE_PATH="$root${ROS_PACKAGE_PATH:+:$ROS_PACKAGE_PATH}"
mkdir -p "$output"
{
  for scene in bouncing_ball two_feet box_sticks box_slides peg_in_hole insertion_simulation; do
    echo "== config/$scene.yaml"
    "$simulate" "$root/config/$scene.yaml" --output "$output/$scene.csv" --contacts "$output/${scene}_contacts.csv" \
      --niches "$output/${scene}_niches.csv"
  done
  echo "== config/insertion_simulation.yaml --tracking single_minimum (no niches)"
  "$simulate" "$root/config/insertion_simulation.yaml" --output "$output/insertion_single.csv" --tracking single_minimum
} | tee "$root/doc/results/simulation.txt"
/usr/bin/python3 "$root/scripts/plot_simulation.py" "$output"
cd "$root"
test/scripts/check_results.py --record simulation.txt two_feet.csv
