#!/usr/bin/env bash
# Writes the worst errors of doc/numerics.md to doc/results/numerics.txt: ten minutes on one idle core. Needs a finished
# build (scripts/build.sh all).
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$package_dir"
cmake --build "$build_dir" --target distance_tests numerics_tests
found=$(mktemp)
trap 'rm -f "$found"' EXIT
CONCAVE_DISTANCE_ACCURACY_PAIRS=100000 "$build_dir/test/bin/distance_tests" \
  --gtest_filter='*StaysWithinTheStatedBounds*' | grep worst: >"$found"
"$build_dir/test/bin/numerics_tests" --gtest_filter='*HardCase*:*HardProof*' | grep worst: >>"$found"
cp "$found" doc/results/numerics.txt
test/scripts/check_results.py --record numerics.txt
