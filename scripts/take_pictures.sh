#!/usr/bin/env bash
# Takes the pictures of the demos in doc/images: starts each scene at rest on a display of its own, waits until rviz
# draws the same picture twice, and keeps it.
#   scripts/take_pictures.sh [--output FOLDER] [insertion|contact|simulation|press_fit|robot|interactive|cell|crowd|clouds|own_robot ...]   (default: all)
# Needs what scripts/demo.sh builds, xvfb, imagemagick and, for own_robot, the robots of dart-doc. ROS_MASTER_URI says on which port; no master may run there.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

size=1240x860
output="$package_dir/doc/images"
scenes=()
while [ $# -gt 0 ]; do
  case "$1" in
    --output) output="${2:?--output needs a folder}" && shift ;;
    insertion | contact | simulation | press_fit | robot | interactive | cell | crowd | clouds | own_robot) scenes+=("$1") ;;
    -h | --help) sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" && exit 0 ;;
    *) die "unknown argument '$1': see --help" ;;
  esac
  shift
done
[ ${#scenes[@]} -gt 0 ] || scenes=(insertion contact simulation press_fit robot interactive cell crowd clouds own_robot)
for tool in Xvfb import compare; do
  command -v "$tool" >/dev/null || die "$tool is missing: apt-get install xvfb imagemagick"
done
use_build
export ROS_MASTER_URI="${ROS_MASTER_URI:-http://localhost:11319}" ROS_HOSTNAME="${ROS_HOSTNAME:-localhost}"
export LIBGL_ALWAYS_SOFTWARE=1 QT_X11_NO_MITSHM=1
work="$(mktemp -d)"
export ROS_LOG_DIR="$work/logs" XDG_RUNTIME_DIR="$work"
mkdir -p "$output"
chmod 700 "$work"

processes=()
stop_all() {
  local pid
  for pid in "${processes[@]}"; do kill -INT "$pid" 2>/dev/null || true; done
  for pid in "${processes[@]}"; do wait "$pid" 2>/dev/null || true; done
  processes=()
}
trap 'stop_all; kill "${xvfb:-}" 2>/dev/null || true; rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

mkfifo "$work/display"
Xvfb -displayfd 3 -screen 0 "${size}x24" -nolisten tcp 3<>"$work/display" >/dev/null 2>&1 &
xvfb=$!
read -r display <"$work/display" || die "Xvfb did not start"
export DISPLAY=":$display"

launch_file() {
  case "$1" in
    press_fit) echo simulation.launch ;;
    *) echo "$1.launch" ;;
  esac
}

# Ends while the right foot is pressed on the ground.
sed 's/^  duration: .*/  duration: 0.1325/' "$package_dir/config/two_feet.yaml" >"$work/two_feet.yaml"

# Arguments of a scene's launch file that hold it still at a telling moment.
launch_arguments() {
  case "$1" in
    insertion) echo "speed:=0 start:=6.6" ;;
    contact) echo "speed:=0 start:=6.0" ;;
    simulation) echo "at_end:=hold scene_file:=$work/two_feet.yaml" ;;
    press_fit) echo "at_end:=hold speed:=0.02 scene:=press_fit view:=press_fit force_marker_scale:=25000" ;;
    robot) echo "speed:=0 start:=17.0" ;;
    interactive) echo "idle_motion:=false" ;;
    cell) echo "speed:=0 start:=11.75" ;;  # the hand has taken the part
    clouds) echo "speed:=0 start:=17.0" ;;
    crowd) echo "speed:=0" ;;
    own_robot) echo "urdf:=/usr/share/doc/dart/data/urdf/drchubo/drchubo.urdf skip_overlapping_pairs:=true" ;;
  esac
}

wait_for() {  # seconds, what, command...
  local end=$((SECONDS + $1)) what="$2"
  shift 2
  until "$@" >/dev/null 2>&1; do
    [ "$SECONDS" -lt "$end" ] || { tail -n 20 "$work"/*.log >&2; die "$what did not come in time"; }
    sleep 0.3
  done
}

# The peg's load sets in some time after the start.
markers_came() {
  local text=' mm'
  [ "$scene" != press_fit ] || text='deep.* kN'
  grep -q "$text" "$work/markers.txt"
}

picture_settled() {
  mv -f "$work/now.png" "$work/before.png" 2>/dev/null || true
  sleep 1.5
  import -window root "$work/now.png"
  [ "$(identify -format %k "$work/now.png")" -gt 50 ] || return 1
  [ -s "$work/before.png" ] || return 1
  local changed
  changed="$(compare -metric AE -fuzz 3% "$work/before.png" "$work/now.png" null: 2>&1 || true)"
  [ "${changed%%[. ]*}" -lt 40 ]
}

for scene in "${scenes[@]}"; do
  say "$scene"
  read -ra arguments <<<"$(launch_arguments "$scene")"
  rm -f "$work"/*.png
  setsid roslaunch concave_distance "$(launch_file "$scene")" rviz:=false "${arguments[@]}" >"$work/$scene.log" 2>&1 </dev/null &
  processes+=($!)
  wait_for 30 "the master" rostopic list
  # Subscribed until the picture is taken: niches are computed while somebody wants them.
  PYTHONUNBUFFERED=1 rostopic echo /concave_distance/markers >"$work/markers.txt" 2>/dev/null </dev/null &
  processes+=($!)
  wait_for 60 "the markers of $scene" markers_came
  viewer=(rviz -d "$package_dir/config/$scene.rviz")
  [ "$scene" != own_robot ] || viewer=(rosrun concave_distance view_robot.py "$package_dir/config/own_robot.rviz" world)
  "${viewer[@]}" --fullscreen -s "" >"$work/$scene.rviz.log" 2>&1 </dev/null &
  processes+=($!)
  wait_for 90 "a picture of $scene" picture_settled
  convert "$work/now.png" -crop 1200x820+40+40 +repage -strip -colors 255 "PNG8:$output/$scene.png"
  say "$output/$scene.png: $(stat -c %s "$output/$scene.png") bytes"
  stop_all
done
kill "$xvfb"
wait "$xvfb" 2>/dev/null || true
