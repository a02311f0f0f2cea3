#!/usr/bin/env bash
# Measures one thing with a finished build (scripts/build.sh all) and writes its files of doc/results.
#   scripts/measure.sh node [OPTIONS] [SCENES]   the node on moving scenes, from outside (node_timing.txt; below)
#   scripts/measure.sh clouds [OPTIONS]          clouds of a camera in a running node (scripts/measure_clouds.py)
#   scripts/measure.sh numerics                  worst errors beside 100 digits, ten minutes (numerics.txt)
#   scripts/measure.sh rows                      what all rows are worth beside the nearest one (rows*.csv, pictures)
#   scripts/measure.sh simulation                the contact scenes of config/ (simulation.txt, two_feet.csv, pictures)
#   scripts/measure.sh instructions [PAIRS]      instructions of a cycle with the code of effects and without (instructions.csv)
# node: [--seconds N] [--output FILE] [--prefix COMMAND] [--wait-idle] [--cycle-budget S], 60 s for each scene by default.
# --prefix "chrt -f 20" runs the node with real-time priority (needs the right to); --wait-idle begins each measurement when
# the machine has been idle for three seconds; --cycle-budget is the node's ~cycle_budget. Scenes: pair: the battery in its
# fixture at 500 Hz, its distance alone and with all niches; oversampled: four cycles a pose; robot: the arm in the shelf, 35
# pairs at 50 Hz; robot_all: the same without the cutoff; cell: the arm among boxes; pairs_168, pairs_768: Atlas and DRC-Hubo of
# Debian's dart-doc, with a subscriber of distances alone, then one of markers beside it. All but the last three by default.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$package_dir"
programs="$build_dir/devel/lib/concave_distance"
record() { test/scripts/check_results.py --record "$@"; }
need() { [ -x "$programs/$1" ] || die "$1 is not built: run scripts/build.sh all"; }

measure_numerics() {
  cmake --build "$build_dir" --target distance_tests numerics_tests
  local found
  found=$(CONCAVE_DISTANCE_ACCURACY_PAIRS=100000 "$build_dir/test/bin/distance_tests" \
    --gtest_filter='*StaysWithinTheStatedBounds*' | grep worst:)
  found+=$'\n'$("$build_dir/test/bin/numerics_tests" --gtest_filter='*HardCase*:*HardProof*' | grep worst:)
  echo "$found" >doc/results/numerics.txt
  record numerics.txt
}

measure_clouds() {
  need distance_node
  use_own_master 11412 "$build_dir/ros_logs"
  start_scene "$ROS_LOG_DIR/measure_clouds.log" clouds.launch rviz:=false camera_rate:=0
  /usr/bin/python3 scripts/measure_clouds.py "$@"
  case " $* " in *" --output "*) ;; *) record clouds.csv ;; esac
}

measure_simulation() {
  need simulate
  export ROS_PACKAGE_PATH="$package_dir${ROS_PACKAGE_PATH:+:$ROS_PACKAGE_PATH}"
  local output scene
  output="$(mktemp -d)"
  {
    for scene in bouncing_ball two_feet box_sticks box_slides peg_in_hole insertion_simulation; do
      echo "== config/$scene.yaml"
      "$programs/simulate" "config/$scene.yaml" --output "$output/$scene.csv" --contacts "$output/${scene}_contacts.csv" \
        --niches "$output/${scene}_niches.csv"
    done
    echo "== config/insertion_simulation.yaml --tracking single_minimum (no niches)"
    "$programs/simulate" config/insertion_simulation.yaml --output "$output/insertion_single.csv" --tracking single_minimum
  } | tee doc/results/simulation.txt
  /usr/bin/python3 scripts/plot_simulation.py "$output"
  record simulation.txt two_feet.csv
}

# Headless, in simulated time; the first of a scene is drawn. Needs what scripts/demo.sh builds and python3-matplotlib.
# ROS_MASTER_URI says on which port; no master may run there.
measure_rows() {
  use_build
  export ROS_MASTER_URI="${ROS_MASTER_URI:-http://localhost:11321}" ROS_HOSTNAME="${ROS_HOSTNAME:-localhost}"
  local output="$build_dir/rows" number=0 setting name scene step gain margin pace folder
  rm -rf "$output"
  export ROS_LOG_DIR="$output/logs"
  local settings=(  # name, scene, step (s), gain (1/s), margin (m), pace
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
  /usr/bin/python3 scripts/plot_rows.py "$output"
  record doc/results/rows*.csv
}

# LD_BIND_NOW: looking up a function at its first call takes more or less by the program's own symbols.
counted() { # <program> <arguments ...>
  local program="$1"
  shift
  LD_BIND_NOW=1 valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect='*runCycles*' \
    "$programs/$program" "$@" 2>&1 | sed -n 's/.*Collected : //p'
}

# Fails where any two counts differ. Needs valgrind (scripts/install_dependencies.sh plot); with pairs named, writes no file.
measure_instructions() {
  need distance_cycle_without_effects
  local output=/dev/null pair state option
  if [ $# -eq 0 ]; then
    output=doc/results/instructions.csv
    set -- battery_insertion kr5_bicep_palm peg_in_hole
  fi
  {
    echo pair,state,with_effects,compiled_out
    for pair in "$@"; do
      for state in apart contact; do
        option=()
        [ $state = apart ] || option=(--contact)
        echo "$pair,$state,$(counted distance_cycle --pair "$pair" "${option[@]}"),$(
          counted distance_cycle_without_effects --pair "$pair" "${option[@]}")"
      done
    done
  } | tee "$output" | awk -F, '{ print } NR > 1 && $3 != $4 { different = 1 } END { exit different }'
  [ "$output" = /dev/null ] || record instructions.csv
}

# The share of all cores' time that was idle in the next three seconds, in percent.
idle_share() {
  local before after
  before="$(head -n 1 /proc/stat)"
  sleep 3
  after="$(head -n 1 /proc/stat)"
  echo "$before $after" | awk '{ for (i = 2; i <= 9; ++i) all += $(i + 11) - $i; print int(100 * ($16 - $5) / all) }'
}

measure_scene() { # <title> <topic, or distances+markers: without and with markers> <cutoff or -1> <roslaunch arguments ...>
  local title="$1" topic="$2" cutoff="$3" load markers=(false) with
  shift 3
  if [ "$topic" = distances+markers ]; then topic=distances markers=(false true); fi
  if [ -n "$wait_idle" ]; then
    until [ "$(idle_share)" -ge 90 ]; do :; done
  fi
  load="$(cut -d ' ' -f 1-3 /proc/loadavg)"
  start_scene "$ROS_LOG_DIR/measure_node.log" "$@" rviz:=false launch_prefix:="$prefix"
  for with in "${markers[@]}"; do
    echo "$title; subscribed: $topic$([ "$with" = false ] || echo " and markers"); roslaunch concave_distance ${*//$package_dir\//}"
    "$programs/node_timing" _node:=/concave_distance _seconds:="$seconds" \
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
  test/benchmark/write_srdf.py "$1" "$2" >"$srdf"
  measure_scene "$(basename "$1" .urdf), $2 pairs at 50 Hz" distances+markers -1 own_robot.launch urdf:="$1" srdf:="$srdf" \
    joints:=sway rate:=50
}

measure_node() {
  local scene
  seconds=60
  output=doc/results/node_timing.txt
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
      *) die "unknown argument '$1': see scripts/measure.sh --help" ;;
    esac
    shift
  done
  [ ${#scenes[@]} -gt 0 ] || scenes=(pair oversampled robot robot_all)
  need node_timing
  use_own_master 11411 "$build_dir/ros_logs"
  {
    echo "# scripts/measure.sh node --seconds $seconds --cycle-budget $cycle_budget ${wait_idle:+--wait-idle }${prefix:+--prefix \"$prefix\" }${scenes[*]}"
    echo "# $(nproc) cores of $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(uname -s) $(uname -r), release build"
    echo
    for scene in "${scenes[@]}"; do
      case "$scene" in
        pair)
          measure_scene "one pair at 500 Hz" distances -1 insertion.launch rate:=500 pose_rate:=500
          measure_scene "one pair at 500 Hz" niches -1 insertion.launch rate:=500 pose_rate:=500
          ;;
        oversampled)
          measure_scene "one pair, poses at 500 Hz, cycles at 2000 Hz" distances -1 insertion.launch rate:=2000 pose_rate:=500
          ;;
        robot) measure_scene "robot scene at 50 Hz" niches -1 robot.launch rate:=50 pose_rate:=50 cycle_budget:="$cycle_budget" ;;
        cell) measure_scene "cell at 50 Hz" niches -1 cell.launch pick:=false rate:=50 pose_rate:=50 cycle_budget:="$cycle_budget" ;;
        robot_all)
          measure_scene "robot scene at 50 Hz, no cutoff: all 35 pairs solved" niches 1000 robot.launch rate:=50 pose_rate:=50 cycle_budget:="$cycle_budget"
          ;;
        pairs_168) measure_robot "$robots/sdf/atlas/atlas_v3_no_head.urdf" 168 ;;
        pairs_768) measure_robot "$robots/urdf/drchubo/drchubo.urdf" 768 ;;
      esac
    done
  } | tee "$output"
  [ "$(dirname "$output")" != doc/results ] || record "$output"
}

case "${1:-}" in
  node | clouds | numerics | rows | simulation | instructions) "measure_$1" "${@:2}" ;;
  -h | --help) sed -n '2,/^set/{s/^# \{0,1\}//;/^set/d;p}' "${BASH_SOURCE[0]}" ;;
  *) die "name what to measure: node, clouds, numerics, rows, simulation or instructions" ;;
esac
