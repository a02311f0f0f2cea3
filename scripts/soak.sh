#!/usr/bin/env bash
# Runs the whole cell for hours and watches it from outside (doc/soak.md): writes a row a minute, then says whether the
# memory was flat, the cycles in time and the answers those of a fresh node (exit status 0).
#   scripts/soak.sh [--minutes N] [--output FILE] [--seed N] [--prefix COMMAND]
# Needs a finished build of node, guard, demos and messages (scripts/build.sh demo). --prefix "chrt -f 20" runs the node with
# real-time priority (needs the right to), which keeps other programs' load out of the figures; "nice -n -5" before the
# script does so for the other programs. What the columns are: scripts/soak.py.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

minutes=180
seed=1
prefix=
output="$package_dir/doc/results/soak.csv"
while [ $# -gt 0 ]; do
  case "$1" in
    --minutes)
      [[ "${2:-}" =~ ^[1-9][0-9]*$ ]] || die "--minutes needs a whole number of minutes, not '${2:-}'"
      minutes="$2" && shift
      ;;
    --output) output="$(realpath -m "${2:?--output needs a file}")" && shift ;;
    --seed) seed="${2:?--seed needs a number}" && shift ;;
    --prefix) prefix="${2:?--prefix needs a command}" && shift ;;
    *) die "unknown argument '$1': expected --minutes N, --output FILE, --seed N or --prefix COMMAND" ;;
  esac
  shift
done
programs="$build_dir/devel/lib/concave_distance"
for program in distance_node velocity_guard joint_player; do
  [ -x "$programs/$program" ] || die "$program is not built: run scripts/build.sh demo"
done
folder="$build_dir/soak"
use_own_master 11414 "$folder/ros_logs"
rm -rf "$folder"
mkdir -p "$ROS_LOG_DIR" "$folder/bags" "$(dirname "$output")"

/usr/bin/python3 "$package_dir/scripts/soak.py" --write-scene "$folder/scene.yaml"
start_scene "$folder/soak.log" soak.launch "scene:=$folder/scene.yaml" "bags:=$folder/bags" "launch_prefix:=$prefix"
/usr/bin/python3 "$package_dir/scripts/soak.py" --launch-pid "$launch_pid" --program "$programs/distance_node" \
  --folder "$folder" --minutes "$minutes" --output "$output" --seed "$seed"
