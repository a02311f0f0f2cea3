#!/usr/bin/env bash
# Builds the package in the ways that its users do, and imports it from Python in each place.
#   scripts/check_workspaces.sh [catkin_make] [isolated] [prefix] [without_ros]     (default: all of them, one after another)
# catkin_make: a catkin workspace, its devel space and its install space. isolated: catkin_make_isolated --install.
# prefix: plain CMake with ROS, `cmake --install` to a prefix that was named before and to another one. without_ros:
# plain CMake without ROS, with every test, and installed. Each is a whole build (15 minutes on two cores; ccache shares
# what is the same) in CONCAVE_DISTANCE_WORKSPACES, by default in the user's cache.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
source_ros
exec </dev/null

# Outside of the package: it links to the package, and catkin and roslaunch search a package's folders.
work="${CONCAVE_DISTANCE_WORKSPACES:-${XDG_CACHE_HOME:-$HOME/.cache}/concave_distance_workspaces}"
jobs="${CONCAVE_DISTANCE_JOBS:-$(job_count)}"
options=(-DCONCAVE_DISTANCE_FAST_BUILD=ON -DCMAKE_BUILD_TYPE=Release)
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  # The same depth of every folder that compilers run in makes the same relative paths.
  export CCACHE_BASEDIR="$work" CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
fi

import_program='
import sys
import concave_distance as cd
distance = cd.PairTracker(cd.make_box((1, 1, 1)), cd.make_sphere(0.5)).solve([2, 0, 0, 0, 0, 0, 1]).rows["distance"][0]
assert abs(distance - 1) < 1e-12, distance
assert cd.__file__.startswith(sys.argv[1] + "/"), cd.__file__
if sys.argv[2] == "messages":
    from concave_distance.msg import Niche
    from concave_distance.srv import GetDistance
    assert Niche().id == 0 and GetDistance._request_class is not None
'

# workspace <name>: its folder, emptied, with the package in src/.
workspace() {
  rm -rf "${work:?}/$1"
  mkdir -p "$work/$1/src"
  ln -s "$package_dir" "$work/$1/src/concave_distance"
  echo "$work/$1"
}

# check_import <what> <space> <messages|alone> <line of the shell before it>: in a shell that knows nothing else.
check_import() {
  local what="$1" space="$2" with="$3" before="$4"
  (cd / && env -i HOME="$HOME" PATH=/usr/bin:/bin ROS_DISTRO="${ROS_DISTRO:-}" \
    bash -c "$before && python3 -c '${import_program//\'/}' '$space' $with && '$space/lib/concave_distance/distance_query' --version >/dev/null") ||
    die "$what: the import after '$before' failed"
  say "$what: imported after '$before'"
}

check_catkin_make() {
  local folder
  folder="$(workspace catkin_make)"
  (cd "$folder" && catkin_make -j"$jobs" "${options[@]}") || die "catkin_make failed"
  check_import "catkin_make" "$folder/devel" messages "source '$folder/devel/setup.bash'"
  (cd "$folder" && catkin_make install -j"$jobs") || die "catkin_make install failed"
  rm -rf "$folder/devel" "$folder/build"
  check_import "catkin_make install" "$folder/install" messages "source '$folder/install/setup.bash'"
}

check_isolated() {
  local folder
  folder="$(workspace isolated)"
  (cd "$folder" && catkin_make_isolated --install -j"$jobs" --cmake-args "${options[@]}") || die "catkin_make_isolated failed"
  check_import "catkin_make_isolated, devel" "$folder/devel_isolated/concave_distance" messages \
    "source '$folder/devel_isolated/setup.bash'"
  rm -rf "$folder/devel_isolated" "$folder/build_isolated"
  check_import "catkin_make_isolated --install" "$folder/install_isolated" messages "source '$folder/install_isolated/setup.bash'"
}

# build_plain <folder> <cmake options ...>
build_plain() {
  local folder="$1"
  shift
  cmake -S "$folder/src/concave_distance" -B "$folder/build/concave_distance" -G "Unix Makefiles" "${options[@]}" \
    -DCONCAVE_DISTANCE_BUILD_BENCHMARKS=OFF "$@"
  cmake --build "$folder/build/concave_distance" -j "$jobs"
}

check_prefix() {
  local folder
  folder="$(workspace prefix)"
  build_plain "$folder" -DCONCAVE_DISTANCE_WITH_ROS=ON -DCONCAVE_DISTANCE_BUILD_TESTS=OFF -DCMAKE_INSTALL_PREFIX="$folder/install"
  cmake --install "$folder/build/concave_distance" >/dev/null
  check_import "a prefix named to cmake" "$folder/install" messages "source '$folder/install/setup.bash'"
  # Configured without a prefix, installed to one that has no setup file.
  cmake -S "$folder/src/concave_distance" -B "$folder/build/concave_distance" -UCMAKE_INSTALL_PREFIX >/dev/null
  cmake --install "$folder/build/concave_distance" --prefix "$folder/other" | awk '/^-- (Installing|Up-to-date): /{print $3}' |
    grep -v "^$folder/other/" && die "cmake --install --prefix wrote outside of its prefix"
  check_import "another prefix" "$folder/other" messages "export PYTHONPATH='$folder/other/lib/python3/dist-packages'"
}

check_without_ros() {
  local folder
  folder="$(workspace without_ros)"
  build_plain "$folder" -DCONCAVE_DISTANCE_WITH_ROS=OFF -DCONCAVE_DISTANCE_BUILD_TESTS=ON
  (cd "$folder/build/concave_distance" && ctest --timeout 600 --output-on-failure --parallel "$jobs") || die "tests without ROS failed"
  check_import "without ROS" "$folder/build/concave_distance/devel" alone \
    "export PYTHONPATH='$folder/build/concave_distance/devel/lib/python3/dist-packages'"
  cmake --install "$folder/build/concave_distance" --prefix "$folder/install" >/dev/null
  [ ! -e "$folder/install/setup.bash" ] || die "a build without ROS has installed files of catkin"
  rm -rf "$folder/build"
  check_import "without ROS, installed" "$folder/install" alone "export PYTHONPATH='$folder/install/lib/python3/dist-packages'"
}

"$package_dir/scripts/install_dependencies.sh" build test
kinds=("$@")
[ ${#kinds[@]} -gt 0 ] || kinds=(catkin_make isolated prefix without_ros)
for kind in "${kinds[@]}"; do
  declare -F "check_$kind" >/dev/null || die "unknown kind '$kind': expected catkin_make, isolated, prefix or without_ros"
  started=$SECONDS
  "check_$kind"
  say "$kind: done in $((SECONDS - started)) s"
done
