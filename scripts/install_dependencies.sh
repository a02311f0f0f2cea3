#!/usr/bin/env bash
# Installs what the package needs from the distribution's packages, only what is missing.
#   scripts/install_dependencies.sh [node] [build] [test] [demo] [plot] [format] [lint] [fuzz] [sanitize] [engines]  (default: build test demo)
#   scripts/install_dependencies.sh --print debian|noetic GROUP ...    the packages' names, a line each; nothing is installed
# node: for building the node; build: for building the other programs too.
# Debian 12 has everything in its main archive. Ubuntu 20.04 needs the ROS Noetic archive set up beforehand.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# shellcheck disable=SC2034  # the arrays are used by name
{
  debian_node=(
    g++ cmake make ninja-build
    libassimp-dev libeigen3-dev libtbb-dev liburdfdom-dev libyaml-cpp-dev libcli11-dev
    libconsole-bridge-dev libpugixml-dev libtinyxml2-dev libxxhash-dev zlib1g-dev
    catkin python3-dynamic-reconfigure ros-message-generation ros-message-runtime
    libdiagnostic-updater-dev libdynamic-reconfigure-config-init-mutex-dev libgeometry-msgs-dev
    libnodelet-dev libnodeletlib-dev libros-rosgraph-msgs-dev libroscpp-dev libroslib-dev libsensor-msgs-dev libshape-msgs-dev libstd-msgs-dev
    liboctomap-dev libstd-srvs-dev libtf2-dev libtf2-eigen-dev libtf2-ros-dev libtopic-tools-dev libtrajectory-msgs-dev libvisualization-msgs-dev pluginlib-dev
    ros-geometry-msgs ros-sensor-msgs ros-shape-msgs ros-std-msgs ros-std-srvs ros-trajectory-msgs ros-visualization-msgs
  )
  debian_build=(
    "${debian_node[@]}"
    libcgal-dev libalglib-dev libfcl-dev  # convex partition, constraint trees (CONCAVE_DISTANCE_WITH_CGAL)
    pybind11-dev python3-dev python3-numpy  # the Python package (CONCAVE_DISTANCE_WITH_PYTHON)
  )
  debian_test=(
    libgtest-dev librapidcheck-dev libfcl-dev libboost-dev libbenchmark-dev
    librostest-dev python3-rostest libnodeletlib-tools
    git locales  # the record of results; a locale with decimal commas
    python3-yaml  # experiments of the evaluation, view_robot.py
    python3-rosmaster python3-rospy python3-tf2-msgs python3-rosgraph-msgs python3-dynamic-reconfigure  # scripts/faults.sh
    python3-interactive-markers python3-sensor-msgs  # marker_mover.py, pick_parts.py
    python3-matplotlib  # examples/plot_niches.py, plot_distances.py
    python3-rosbag python3-numpy  # distance_bag, write_robot_bag.py
    python3-diagnostic-msgs python3-geometry-msgs python3-shape-msgs python3-std-msgs python3-tf2-ros  # the bridges
  )
  debian_demo=(
    python3-roslaunch python3-rospy python3-rosservice python3-rostopic rosbash rviz ros-robot-state-publisher
    python3-rospkg python3-tf2-ros python3-yaml  # scripts/view_robot.py
    python3-sensor-msgs python3-tf2-msgs  # joint_player.py, pick_parts.py, move_crowd.py, simulate_camera.py
    python3-interactive-markers  # marker_mover.py
    python3-cvxopt python3-numpy python3-rosgraph-msgs  # follow_rows.py, simulate_camera.py, demo_motion.py
    python3-rosbag python3-matplotlib  # distance_bag
    python3-geometry-msgs python3-shape-msgs python3-std-msgs python3-std-srvs python3-trajectory-msgs python3-visualization-msgs python3-diagnostic-msgs  # what ours are made of
  )
  debian_plot=(python3-matplotlib python3-yaml valgrind dart-doc)  # the last: robots of benchmarks
  debian_format=(clang-format)
  debian_lint=(clang-format clang-tidy catkin-lint shellcheck)
  debian_fuzz=(clang libclang-rt-14-dev)  # libFuzzer is in the second
  debian_sanitize=(dpkg-dev)  # unpacks the source package of TBB
  debian_engines=(libsimbody-dev libode-dev libbullet-dev)  # engine_table, examples/arm_and_shelf

  noetic_node=(
    g++ cmake make ninja-build
    libassimp-dev libeigen3-dev libtbb-dev liburdfdom-dev libyaml-cpp-dev
    libconsole-bridge-dev libpugixml-dev libtinyxml2-dev libxxhash-dev zlib1g-dev
    ros-noetic-catkin ros-noetic-diagnostic-updater ros-noetic-dynamic-reconfigure ros-noetic-geometry-msgs
    ros-noetic-message-generation ros-noetic-nodelet ros-noetic-pluginlib
    ros-noetic-roscpp ros-noetic-rosgraph-msgs ros-noetic-roslib ros-noetic-sensor-msgs ros-noetic-shape-msgs ros-noetic-std-msgs ros-noetic-std-srvs ros-noetic-tf2
    ros-noetic-octomap ros-noetic-tf2-eigen ros-noetic-tf2-ros ros-noetic-topic-tools ros-noetic-trajectory-msgs ros-noetic-visualization-msgs
  )
  noetic_build=("${noetic_node[@]}" libcgal-dev libalglib-dev libfcl-dev pybind11-dev python3-dev python3-numpy)
  noetic_test=(
    git locales python3-yaml libgtest-dev libfcl-dev libboost-dev libbenchmark-dev ros-noetic-rostest ros-noetic-rosmaster ros-noetic-rospy ros-noetic-tf2-msgs
    ros-noetic-diagnostic-msgs ros-noetic-interactive-markers ros-noetic-rosbag ros-noetic-tf2-ros python3-matplotlib
  )
  noetic_demo=(
    ros-noetic-roslaunch ros-noetic-rospy ros-noetic-rosservice ros-noetic-rostopic ros-noetic-rosbash ros-noetic-rviz
    ros-noetic-robot-state-publisher ros-noetic-interactive-markers ros-noetic-tf2-msgs
    python3-rospkg python3-yaml  # scripts/view_robot.py
    python3-cvxopt python3-numpy  # follow_rows.py
    ros-noetic-rosbag python3-matplotlib  # distance_bag
  )
  noetic_plot=(python3-matplotlib python3-yaml valgrind)
  noetic_format=(clang-format)
  noetic_lint=(clang-format clang-tidy shellcheck)
  noetic_fuzz=(clang)
  noetic_sanitize=(dpkg-dev)
  noetic_engines=(libsimbody-dev libode-dev)
}

if [ "${1:-}" = --print ]; then
  family="$2"
  shift 2
  for group in "$@"; do
    declare -n packages="${family}_${group}"
    printf '%s\n' "${packages[@]}"
  done
  exit 0
fi

# shellcheck disable=SC1091
distribution="$(. /etc/os-release 2>/dev/null && echo "${ID:-unknown} ${VERSION_ID:-unknown}")"
case "$distribution" in
  "debian 12") family=debian ;;
  "ubuntu 20.04") family=noetic ;;
  *)
    die "this script knows Debian 12 and Ubuntu 20.04 (ROS Noetic), not '$distribution'.
Install by hand what package.xml lists, then build with: cmake -S . -B build && cmake --build build"
    ;;
esac

groups=("$@")
[ ${#groups[@]} -gt 0 ] || groups=(build test demo)
wanted=()
for group in "${groups[@]}"; do
  case "$group" in
    node | build | test | demo | plot | format | lint | fuzz | sanitize | engines)
      declare -n packages="${family}_${group}"
      wanted+=("${packages[@]}")
      ;;
    *) die "unknown group '$group': expected node, build, test, demo, plot, format, lint, fuzz, sanitize or engines" ;;
  esac
done

is_installed() {
  [[ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" == installed* ]]
}
missing=()
for package in "${wanted[@]}"; do
  is_installed "$package" || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  say "dependencies (${groups[*]}): all ${#wanted[@]} packages are installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || die "packages are missing and neither root nor sudo is at hand; run as root:
  apt-get update && apt-get install --no-install-recommends ${missing[*]}"
  as_root=(sudo)
  [ -t 0 ] || as_root=(sudo -n)  # nobody can type a password
fi

apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Acquire::Retries=3 \
    -o DPkg::Lock::Timeout=300 -o Dpkg::Options::=--force-confold "$@"
}
say "installing ${#missing[@]} missing package(s): ${missing[*]}"
apt update || say "apt-get update failed; trying with the package lists that are here"
for package in "${missing[@]}"; do
  apt-cache show "$package" >/dev/null 2>&1 && continue
  case "$package" in
    ros-noetic-*) die "apt does not know $package: set up the ROS Noetic archive first (wiki.ros.org/noetic/Installation/Ubuntu)" ;;
    *) die "apt does not know $package: are main (Debian) or universe (Ubuntu) enabled below /etc/apt?" ;;
  esac
done
apt install --no-install-recommends "${missing[@]}"
say "dependencies (${groups[*]}): installed"
