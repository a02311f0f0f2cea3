#!/usr/bin/env bash
# Measures clouds of 1,000, 10,000 and 50,000 occupied voxels at 5 Hz in a running node, seen from outside, and writes
# doc/results/clouds.csv.
#   scripts/measure_clouds.sh [--messages N] [--output FILE]
# Needs a finished build of the node (scripts/demo.sh clouds makes one). What the columns are: scripts/measure_clouds.py.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
source_ros

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
set +u
# shellcheck disable=SC1091
. "$build_dir/devel/setup.bash"
set -u
# A master of its own, beside one that may run.
export ROS_MASTER_URI=http://localhost:11412 ROS_HOSTNAME=localhost ROS_LOG_DIR="$build_dir/ros_logs"
unset ROS_IP
mkdir -p "$ROS_LOG_DIR" "$(dirname "$output")"
if rosparam get /run_id >/dev/null 2>&1; then die "a master already runs at $ROS_MASTER_URI: end it first"; fi

setsid roslaunch --port=11412 concave_distance clouds.launch rviz:=false camera_rate:=0 </dev/null \
  >"$ROS_LOG_DIR/measure_clouds.log" 2>&1 &
launch_pid=$!
trap 'kill -INT "$launch_pid" 2>/dev/null || true; wait "$launch_pid" 2>/dev/null || true' EXIT
until rosparam get /run_id >/dev/null 2>&1; do
  kill -0 "$launch_pid" 2>/dev/null || { tail -n 30 "$ROS_LOG_DIR/measure_clouds.log" >&2 && die "the scene did not start"; }
  sleep 0.2
done
/usr/bin/python3 "$package_dir/scripts/measure_clouds.py" --messages "$messages" --output "$output"
