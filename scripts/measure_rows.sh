#!/usr/bin/env bash
# Measures what all rows are worth beside the nearest one (doc/control.md): runs launch/rows.launch with each setting below,
# headless, writes doc/results/rows*.csv and draws doc/images/rows.png and rows_arm.png. Some minutes. The figures are those
# of simulated time; of the arm's path with all rows digits may differ where the search is ready in another cycle.
#   scripts/measure_rows.sh [folder for the CSV files]
# Needs what scripts/demo.sh builds and python3-matplotlib. ROS_MASTER_URI says on which port; no master may run there.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
use_build
export ROS_MASTER_URI="${ROS_MASTER_URI:-http://localhost:11321}" ROS_HOSTNAME="${ROS_HOSTNAME:-localhost}"
output="$(realpath -m "${1:-$build_dir/rows}")"
rm -rf "$output"
export ROS_LOG_DIR="$output/logs"

# Name, scene, step (s), gain (1/s), margin (m), pace; the first of a scene is drawn.
settings=(
  "drawn clamp 0.01 10 0.004 1"
  "step clamp 0.002 10 0.004 1"
  "gain clamp 0.001 100 0.004 1"
  "margin clamp 0.01 10 0.0055 1"
  "half clamp 0.01 10 0.004 0.5"
  "half_margin clamp 0.01 10 0.0055 0.5"
  "quarter clamp 0.01 10 0.004 0.25"
  "drawn arm 0.01 5 0.02 1"
  "step arm 0.002 5 0.02 1"
  "margin arm 0.01 5 0.03 1"
  "half arm 0.01 5 0.02 0.5"
)
number=0
for setting in "${settings[@]}"; do
  read -r name scene step gain margin pace <<<"$setting"
  folder="$output/$(printf %02d "$number")_${scene}_${name}_step=${step}_gain=${gain}_margin=${margin}_pace=${pace}"
  number=$((number + 1))
  mkdir -p "$folder"
  say "$scene, step $step s, gain $gain/s, margin $margin m, pace $pace"
  setsid roslaunch concave_distance rows.launch rviz:=false speed:=0 longest:=20 "output:=$folder" "scene:=$scene" "step:=$step" \
    "gain:=$gain" "margin:=$margin" "pace:=$pace" >"$folder/roslaunch.log" 2>&1 </dev/null || true
  [ -s "$folder/${scene}_nearest.csv" ] || { tail -n 20 "$folder/roslaunch.log" >&2; die "the runs have not ended"; }
done
/usr/bin/python3 "$package_dir/scripts/plot_rows.py" "$output"
cd "$package_dir"
test/scripts/check_results.py --record doc/results/rows*.csv
