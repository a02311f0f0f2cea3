#!/usr/bin/env bash
# Shows the package at work: installs what is missing, builds, starts a scene, prints what it measures.
#   scripts/demo.sh [insertion|contact|simulation|robot|interactive|cell|crowd|clouds|rows] [--seconds N] [--headless]
#   insertion (default): a battery goes into its fixture; robot: an arm moves beside a shelf and a hook;
#   contact: a battery presses on its pins; simulation: a body on two feet falls and bounces; interactive: move a body
#   with the mouse; cell: an arm among 30 boxes picks a part, carries it past a shelf and puts it down; crowd: 200 moving
#   bodies; clouds: an arm and what a depth camera sees; rows: a C-shaped tool goes around a table's edge, kept clear at every place, then at the nearest one only. In
#   rviz when there is a display, as printed lines in any case.
#   Ends with Ctrl-C, or by itself after N seconds (status 1 when no distance came).
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

scene=insertion
seconds=0
headless=
while [ $# -gt 0 ]; do
  case "$1" in
    insertion | contact | simulation | robot | interactive | cell | crowd | clouds | rows) scene="$1" ;;
    --seconds)
      [[ "${2:-}" =~ ^[1-9][0-9]*$ ]] || die "--seconds needs a whole number of seconds, not '${2:-}'"
      seconds="$2" && shift
      ;;
    --headless) headless=1 ;;
    -h | --help) sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" && exit 0 ;;
    *) die "unknown argument '$1': expected insertion, contact, simulation, robot, interactive, cell, crowd, clouds, rows, --seconds N or --headless" ;;
  esac
  shift
done

"$package_dir/scripts/install_dependencies.sh" node demo </dev/null
source_ros
say "building (some minutes the first time)"
"$package_dir/scripts/build.sh" demo -DCONCAVE_DISTANCE_WITH_ROS=ON </dev/null || die "the build failed: see the first error above"
use_build

display_works() {
  [ -n "${DISPLAY:-}" ] && /usr/bin/python3 -c '
import ctypes, sys
x11 = ctypes.CDLL("libX11.so.6")
x11.XOpenDisplay.restype = ctypes.c_void_p
sys.exit(0 if x11.XOpenDisplay(None) else 1)' 2>/dev/null
}
rviz=false
if [ -n "$headless" ]; then
  say "headless, as asked for"
elif display_works; then
  rviz=true
else
  say "no display: rviz is not started, the distances are printed"
fi

export ROS_LOG_DIR="$build_dir/ros_logs"
export ROS_MASTER_URI="${ROS_MASTER_URI:-http://localhost:11311}"
# A host name that no resolver knows would keep the nodes apart.
if [[ "$ROS_MASTER_URI" == http://localhost:* && -z "${ROS_IP:-}${ROS_HOSTNAME:-}" ]]; then
  export ROS_HOSTNAME=localhost
fi
mkdir -p "$ROS_LOG_DIR"
launch_log="$ROS_LOG_DIR/demo_$scene.log"

say "starting the scene '$scene' (its log: ${launch_log#"$package_dir"/}); Ctrl-C ends it"
setsid roslaunch concave_distance "$scene.launch" rviz:="$rviz" </dev/null >"$launch_log" 2>&1 &
launch_pid=$!
trap end_scene EXIT
trap 'end_scene; exit 130' INT TERM

printer=(rosrun concave_distance show_distances.py _topic:=/concave_distance/niches)
if [ "$seconds" -gt 0 ]; then printer+=(_seconds:="$seconds" _least_messages:=1); fi
until rosparam get /run_id >/dev/null 2>&1; do
  kill -0 "$launch_pid" 2>/dev/null || { tail -n 30 "$launch_log" >&2 && die "the scene did not start"; }
  sleep 0.2
done
"${printer[@]}" &
printer_pid=$!
status=0
while kill -0 "$printer_pid" 2>/dev/null; do
  if ! kill -0 "$launch_pid" 2>/dev/null; then
    kill "$printer_pid" 2>/dev/null || true
    if [ "$rviz" = true ] && wait "$launch_pid"; then say "rviz was closed: the scene has ended" && exit 0; fi
    tail -n 30 "$launch_log" >&2
    die "the scene ended by itself"
  fi
  sleep 0.2
done
wait "$printer_pid" || status=$?
exit "$status"
