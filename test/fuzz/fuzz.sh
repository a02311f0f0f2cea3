#!/usr/bin/env bash
# Builds the libFuzzer targets with clang (address and undefined behaviour sanitizers) and runs each for a while.
#   test/fuzz/fuzz.sh [seconds for each] [mesh] [urdf] [scene] [poses]      (default: 60 s, all of them)
# The corpora grow in build-fuzz/corpus; what breaks is kept in build-fuzz/findings and replayed by
#   build-fuzz/devel/lib/concave_distance/fuzz_<input> <file>
# What it needs beyond the tests (clang with its runtime) is installed where it is missing.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/../../scripts/common.sh"
build_dir="${CONCAVE_DISTANCE_FUZZ_DIR:-$package_dir/build-fuzz}"

seconds=60
if [[ "${1:-}" =~ ^[0-9]+$ ]]; then seconds="$1" && shift; fi
inputs=("$@")
[ ${#inputs[@]} -gt 0 ] || inputs=(mesh urdf scene poses)
targets=()
for input in "${inputs[@]}"; do
  [ -d "$package_dir/test/fuzz/corpus/$input" ] || die "unknown input '$input': expected mesh, urdf, scene or poses"
  targets+=("fuzz_$input")
done

"$package_dir/scripts/install_dependencies.sh" build test fuzz
command -v clang++ >/dev/null || die "clang++ is not installed (Debian: clang libclang-rt-14-dev)"
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
generator=()
if [ ! -f "$build_dir/CMakeCache.txt" ] && command -v ninja >/dev/null; then generator=(-G Ninja); fi
cmake -S "$package_dir" -B "$build_dir" "${generator[@]}" "${launcher[@]}" -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_BUILD_TYPE=None -DCONCAVE_DISTANCE_FUZZERS=ON -DCONCAVE_DISTANCE_WITH_ROS=OFF -DCONCAVE_DISTANCE_FAST_BUILD=ON \
  -DCONCAVE_DISTANCE_BUILD_BENCHMARKS=OFF \
  -DCMAKE_CXX_FLAGS="-O1 -g1 -fno-omit-frame-pointer -fsanitize=address,undefined,fuzzer-no-link -fno-sanitize-recover=undefined"
cmake --build "$build_dir" --parallel "$(job_count)" --target "${targets[@]}"

mkdir -p "$build_dir/findings"
# Other libraries are not built with the sanitizer and keep what they allocate once.
export ASAN_OPTIONS=detect_leaks=0
failed=()
for input in "${inputs[@]}"; do
  mkdir -p "$build_dir/corpus/$input"
  say "fuzz_$input for $seconds s"
  "$build_dir/devel/lib/concave_distance/fuzz_$input" -max_total_time="$seconds" -timeout=60 -report_slow_units=60 -rss_limit_mb=3000 -print_final_stats=1 \
    -artifact_prefix="$build_dir/findings/$input-" "$build_dir/corpus/$input" \
    "$package_dir/test/fuzz/corpus/$input" || failed+=("$input")
done
[ ${#failed[@]} -eq 0 ] || die "findings: ${failed[*]} (see $build_dir/findings)"
