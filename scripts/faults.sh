#!/usr/bin/env bash
# Attacks the built node from outside: hostile requests, bodies, transforms, clocks, connections.
#   scripts/faults.sh [attacks ...]                  every attack, or those whose names match ('tf/*')
#   scripts/faults.sh --storm SECONDS [--seed N]     everything at once, at random, against one node
#   scripts/faults.sh --sanitized [...]              the same against programs with ASan and UBSan, several times slower
#   scripts/faults.sh --list                         the names of all attacks (test/faults/README.md explains them)
# Installs what is missing and builds first: into build/, or build-faults/ with --sanitized. The last line is
# `N passed, N failed`. Further options: test/faults/run.py --help.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

sanitized=
arguments=()
for argument in "$@"; do
  case "$argument" in
    --sanitized) sanitized=1 && arguments+=("$argument") ;;
    -h | --help) sed -n '2,/^set/{s/^# \{0,1\}//;/^set/d;p}' "${BASH_SOURCE[0]}" && exit 0 ;;
    *) arguments+=("$argument") ;;
  esac
done

"$package_dir/scripts/install_dependencies.sh" build test demo
source_ros
if [ -n "$sanitized" ]; then
  build_dir="${CONCAVE_DISTANCE_SANITIZE_DIR:-$package_dir}/build-faults"
  flags="-O1 -g1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined"
  generator=()
  if [ ! -f "$build_dir/CMakeCache.txt" ] && command -v ninja >/dev/null; then generator=(-G Ninja); fi
  launcher=()
  if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  say "building with sanitizers in $build_dir"
  cmake -S "$package_dir" -B "$build_dir" "${generator[@]}" "${launcher[@]}" -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_FLAGS="$flags" -DCONCAVE_DISTANCE_WITH_ROS=ON -DCONCAVE_DISTANCE_BUILD_TESTS=OFF \
    -DCONCAVE_DISTANCE_BUILD_BENCHMARKS=OFF -DCONCAVE_DISTANCE_FAST_BUILD=ON
  cmake --build "$build_dir" --parallel "$(job_count)" --target concave_distance_programs
else
  "$package_dir/scripts/build.sh" programs -DCONCAVE_DISTANCE_WITH_ROS=ON
fi
exec /usr/bin/python3 "$package_dir/test/faults/run.py" --build "$build_dir" "${arguments[@]}"
