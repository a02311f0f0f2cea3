#!/usr/bin/env bash
# Builds the package into build/ without a workspace; programs end in build/devel/lib/concave_distance.
#   scripts/build.sh [programs|all] [cmake options ...]
# programs (default): the core, the tools, the messages, the node; all: tests and benchmarks too.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
source_ros

what=programs
case "${1:-}" in
  programs | all) what="$1" && shift ;;
esac

generator=()
if [ ! -f "$build_dir/CMakeCache.txt" ] && command -v ninja >/dev/null; then generator=(-G Ninja); fi
cmake -S "$package_dir" -B "$build_dir" "${generator[@]}" "$@"

target=()
if [ "$what" = programs ]; then target=(--target concave_distance_programs); fi
# Keep going after an error, so that one broken program does not hide the others.
keep_going=(-k)
if [ -f "$build_dir/build.ninja" ]; then keep_going=(-k 0); fi
cmake --build "$build_dir" --parallel "$(job_count)" "${target[@]}" -- "${keep_going[@]}"
