#!/usr/bin/env bash
# Measures clouds of 1,000, 10,000 and 50,000 occupied voxels at 5 Hz in a running node, seen from outside, and writes
# doc/results/clouds.csv.
#   scripts/measure_clouds.sh [--messages N] [--output FILE]
# Needs a finished build of the node (scripts/demo.sh clouds makes one). What the columns are: scripts/measure_clouds.py.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

messages=50
output="$package_dir/doc/results/clouds.csv"
while [ $# -gt 0 ]; do
  case "$1" in
    --messages) messages="${2:?--messages needs a number}" && shift ;;
    --output) output="${2:?--output needs a file}" && shift ;;
    *) die "unknown argument '$1': expected --messages N or --output FILE" ;;
  esac
  shift
done
[ -x "$build_dir/devel/lib/concave_distance/distance_node" ] || die "the node is not built: run scripts/build.sh all"
use_own_master 11412 "$build_dir/ros_logs"
mkdir -p "$(dirname "$output")"
start_scene "$ROS_LOG_DIR/measure_clouds.log" clouds.launch rviz:=false camera_rate:=0
/usr/bin/python3 "$package_dir/scripts/measure_clouds.py" --messages "$messages" --output "$output"
