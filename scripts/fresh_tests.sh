#!/usr/bin/env bash
# Runs every property test on new cases: a new seed, 20,000 cases each. scripts/test.sh draws the same hundred each
# time. Programs that are missing in build/ are built.
#   scripts/fresh_tests.sh [--cases N] [--seed N] [--property NAME] [program ...]
# Default: 20000 cases, a seed drawn, every property of every program.
# Failures are printed with the seed and the case; the last line is `N passed, N failed`, counted in properties.
# To repeat one: this script with the seed, the program and `--property <name>`.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

cases=20000
seed="$(od -An -N4 -tu4 /dev/urandom | tr -d ' ')"
only=
programs=()
while [ $# -gt 0 ]; do
  case "$1" in
    --cases) cases="$2" && shift ;;
    --seed) seed="$2" && shift ;;
    --property) only="$2" && shift ;;
    -*) die "unknown option '$1'" ;;
    *) programs+=("$1") ;;
  esac
  shift
done

test_dir="$package_dir/test"
# Properties that draw with the package's own engine (test/support/case_seed.h).
declare -A own=(
  [distance_tests]='EveryFamily*:ExactTriangleDistance.*:FacetPairLevels.OfQuadrangles*'
  [mesh_tests]='*ContainsExactlyTheMaterial*:*ARepairedUnionStays*'
  [tracking_tests]='QueriesOfUnions.*'
  [cgal_tests]='UnionAgainstCgal.*'
)
if [ ${#programs[@]} -eq 0 ]; then
  mapfile -t programs < <(printf '%s\n' "${!own[@]}" base_tests interference_tests scene_tests search_tests | sort)
fi
properties="$(find "$test_dir" -name '*_test.cpp' -exec sed -n 's/^RC_GTEST_PROP(\(\w*\), *\(\w*\),.*/\1.\2/p' {} + | paste -sd:)"

missing=()
for program in "${programs[@]}"; do
  [ -x "$build_dir/test/bin/$program" ] || missing+=("$program")
done
if [ ${#missing[@]} -gt 0 ]; then
  [ -f "$build_dir/CMakeCache.txt" ] || die "there is no build in $build_dir: run scripts/test.sh first"
  cmake --build "$build_dir" --parallel "$(job_count)" --target "${missing[@]}"
fi

results="$build_dir/fresh_test_results"
rm -rf "$results"
mkdir -p "$results"
say "seed $seed, $cases cases each"
export RC_PARAMS="seed=$seed max_success=$cases"
export CONCAVE_DISTANCE_FRESH_SEED="$seed" CONCAVE_DISTANCE_FRESH_CASES="$cases"
passed=0
failed=0
for program in "${programs[@]}"; do
  log="$results/$program.log"
  status=0
  filter="${only:-$properties:${own[$program]:-}}"
  "$build_dir/test/bin/$program" --gtest_filter="$filter" >"$log" 2>&1 || status=$?
  good="$(grep -c '^\[       OK \]' "$log" || true)"
  bad="$(grep -c '^\[  FAILED  \] .*ms)$' "$log" || true)"
  [ "$status" -eq 0 ] || [ "$bad" -gt 0 ] || bad=1 # it crashed
  say "$program: $good passed, $bad failed"
  [ "$bad" -eq 0 ] || cat "$log"
  passed=$((passed + good))
  failed=$((failed + bad))
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
