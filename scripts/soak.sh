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
source_ros

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
set +u
# shellcheck disable=SC1091
. "$build_dir/devel/setup.bash"
set -u
# A master of its own, beside one that may run.
export ROS_MASTER_URI=http://localhost:11414 ROS_HOSTNAME=localhost
unset ROS_IP
folder="$build_dir/soak"
export ROS_LOG_DIR="$folder/ros_logs"
if rosparam get /run_id >/dev/null 2>&1; then die "a master already runs at $ROS_MASTER_URI: end it first"; fi
rm -rf "$folder"
mkdir -p "$ROS_LOG_DIR" "$folder/bags" "$(dirname "$output")"

/usr/bin/python3 "$package_dir/scripts/soak.py" --write-scene "$folder/scene.yaml"
setsid roslaunch --port=11414 concave_distance soak.launch "scene:=$folder/scene.yaml" "bags:=$folder/bags" "launch_prefix:=$prefix" </dev/null \
  >"$folder/soak.log" 2>&1 &
launch_pid=$!
trap 'kill -INT "$launch_pid" 2>/dev/null || true; wait "$launch_pid" 2>/dev/null || true' EXIT
until rosparam get /run_id >/dev/null 2>&1; do
  kill -0 "$launch_pid" 2>/dev/null || { tail -n 30 "$folder/soak.log" >&2 && die "the cell did not start"; }
  sleep 0.2
done
/usr/bin/python3 "$package_dir/scripts/soak.py" --launch-pid "$launch_pid" --program "$programs/distance_node" \
  --folder "$folder" --minutes "$minutes" --output "$output" --seed "$seed"
