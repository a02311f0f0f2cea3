#!/usr/bin/env bash
# Builds the package into build/ without a workspace; programs end in build/devel/lib/concave_distance.
#   scripts/build.sh [demo|programs|all] [cmake options ...]
#   scripts/build.sh tables    after `all`: writes the tables of parameters in documents and config/ConcaveDistance.cfg
# demo: the node, the messages and the demos' programs; programs (default): the tools too; all: tests, benchmarks and
# the thesis (CONCAVE_DISTANCE_WITH_THESIS) too.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
source_ros

if [ "${1:-}" = tables ]; then
  export CONCAVE_DISTANCE_WRITE_TABLES=1
  "$build_dir/test/bin/ros_tests" --gtest_filter='ParameterDocumentation.*'
  exec "$build_dir/test/bin/thesis_tests" --gtest_filter='CombGaParameters.*Document'
fi

what=programs
case "${1:-}" in
  demo | programs | all) what="$1" && shift ;;
esac

first_options=()
if [ ! -f "$build_dir/CMakeCache.txt" ]; then
  if command -v ninja >/dev/null; then first_options+=(-G Ninja); fi
  # Makes the first build for the demos faster.
  if [ "$what" = demo ]; then first_options+=(-DCONCAVE_DISTANCE_FAST_BUILD=ON); fi
fi
if [ "$what" = all ]; then first_options+=(-DCONCAVE_DISTANCE_WITH_THESIS=ON); fi
cmake -S "$package_dir" -B "$build_dir" "${first_options[@]}" "$@"

target=()
case "$what" in
  demo) target=(--target concave_distance_demos) ;;
  programs) target=(--target concave_distance_programs) ;;
esac
# Keep going after an error, so that one broken program does not hide the others.
keep_going=(-k)
if [ -f "$build_dir/build.ninja" ]; then keep_going=(-k 0); fi
cmake --build "$build_dir" --parallel "$(job_count)" "${target[@]}" -- "${keep_going[@]}"
