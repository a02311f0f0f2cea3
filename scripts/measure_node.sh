#!/usr/bin/env bash
# Measures the node on moving scenes and writes the figures to doc/results/node_timing.txt.
#   scripts/measure_node.sh [--seconds N] [--output FILE] [--prefix COMMAND] [--wait-idle] [--cycle-budget S] [scenes]
# Scenes: pair: the battery in its fixture, one pair, poses and cycles at 500 Hz, its distance alone and with all niches;
# oversampled: four cycles a pose, for the latency; robot: the arm in the shelf, 35 pairs, poses and cycles at 50 Hz;
# robot_all: the same without the cutoff, so that all 35 pairs are solved in every cycle; cell: the arm among boxes, 50 Hz;
# pairs_168 and pairs_768: Atlas and DRC-Hubo of Debian's dart-doc with that many pairs, every joint moving, first with a
# subscriber of distances alone, then
# with one of markers beside it, as rviz is. All but the last three by default, 60 s each. --prefix "chrt -f 20" runs the node
# with real-time priority (needs the right to), which keeps other programs' load out of the figures. --wait-idle begins each
# measurement when the machine has been idle for three seconds (how idle it was during one is printed). Needs a finished
# build (scripts/build.sh all). --cycle-budget is the node's ~cycle_budget. How to read the figures: test/ros/timing/node_timing.cpp.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

seconds=60
output="$package_dir/doc/results/node_timing.txt"
prefix=
wait_idle=
cycle_budget=auto
scenes=()
while [ $# -gt 0 ]; do
  case "$1" in
    --seconds) seconds="${2:?--seconds needs a number}" && shift ;;
    --output) output="${2:?--output needs a file}" && shift ;;
    --prefix) prefix="${2:?--prefix needs a command}" && shift ;;
    --wait-idle) wait_idle=1 ;;
    --cycle-budget) cycle_budget="${2:?--cycle-budget needs seconds, auto, or 0 for cycles without an end}" && shift ;;
    pair | oversampled | robot | robot_all | cell | pairs_168 | pairs_768) scenes+=("$1") ;;
    *) die "unknown argument '$1': expected pair, oversampled, robot, robot_all, cell, pairs_168, pairs_768, --seconds N, --output FILE, --prefix COMMAND, --wait-idle or --cycle-budget S" ;;
  esac
  shift
done
[ ${#scenes[@]} -gt 0 ] || scenes=(pair oversampled robot robot_all)
[ -x "$build_dir/devel/lib/concave_distance/node_timing" ] || die "node_timing is not built: run scripts/build.sh all"
use_own_master 11411 "$build_dir/ros_logs"
mkdir -p "$(dirname "$output")"

# The share of all cores' time that was idle in the next three seconds, in percent.
idle_share() {
  local before after
  before="$(head -n 1 /proc/stat)"
  sleep 3
  after="$(head -n 1 /proc/stat)"
  echo "$before $after" | awk '{ for (i = 2; i <= 9; ++i) all += $(i + 11) - $i; print int(100 * ($16 - $5) / all) }'
}

measure() { # <title> <topic, or distances+markers: without and with markers> <cutoff or -1> <roslaunch arguments ...>
  local title="$1" topic="$2" cutoff="$3" load markers=(false)
  shift 3
  if [ "$topic" = distances+markers ]; then topic=distances markers=(false true); fi
  if [ -n "$wait_idle" ]; then
    until [ "$(idle_share)" -ge 90 ]; do :; done
  fi
  load="$(cut -d ' ' -f 1-3 /proc/loadavg)"
  start_scene "$ROS_LOG_DIR/measure_node.log" "$@" rviz:=false launch_prefix:="$prefix"
  local with
  for with in "${markers[@]}"; do
    echo "$title; subscribed: $topic$([ "$with" = false ] || echo " and markers"); roslaunch concave_distance ${*//$package_dir\//}"
    "$build_dir/devel/lib/concave_distance/node_timing" _node:=/concave_distance _seconds:="$seconds" \
      _topic:="$topic" _cutoff:="$cutoff" _markers:="$with"
  done
  echo "  load average   before: $load; after: $(cut -d ' ' -f 1-3 /proc/loadavg) (this measurement included)"
  echo
  end_scene
}

robots=/usr/share/doc/dart/data
measure_robot() { # <URDF> <pairs>
  [ -f "$1" ] || die "$1 is missing: apt-get install dart-doc"
  local srdf
  srdf="$build_dir/$(basename "$1" .urdf).srdf"
  "$package_dir/scripts/write_srdf.py" "$1" "$2" >"$srdf"
  measure "$(basename "$1" .urdf), $2 pairs at 50 Hz" distances+markers -1 own_robot.launch urdf:="$1" srdf:="$srdf" \
    joints:=sway rate:=50
}

exec > >(tee "$output")
echo "# scripts/measure_node.sh --seconds $seconds --cycle-budget $cycle_budget ${wait_idle:+--wait-idle }${prefix:+--prefix \"$prefix\" }${scenes[*]}"
echo "# $(nproc) cores of $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(uname -s) $(uname -r), release build"
echo
for scene in "${scenes[@]}"; do
  case "$scene" in
    pair)
      measure "one pair at 500 Hz" distances -1 insertion.launch rate:=500 pose_rate:=500
      measure "one pair at 500 Hz" niches -1 insertion.launch rate:=500 pose_rate:=500
      ;;
    oversampled)
      measure "one pair, poses at 500 Hz, cycles at 2000 Hz" distances -1 insertion.launch rate:=2000 pose_rate:=500
      ;;
    robot) measure "robot scene at 50 Hz" niches -1 robot.launch rate:=50 pose_rate:=50 cycle_budget:="$cycle_budget" ;;
    cell) measure "cell at 50 Hz" niches -1 cell.launch pick:=false rate:=50 pose_rate:=50 cycle_budget:="$cycle_budget" ;;
    robot_all)
      measure "robot scene at 50 Hz, no cutoff: all 35 pairs solved" niches 1000 robot.launch rate:=50 pose_rate:=50 cycle_budget:="$cycle_budget"
      ;;
    pairs_168) measure_robot "$robots/sdf/atlas/atlas_v3_no_head.urdf" 168 ;;
    pairs_768) measure_robot "$robots/urdf/drchubo/drchubo.urdf" 768 ;;
  esac
done
