#!/usr/bin/env bash
# Builds the core, the tools and their tests with a sanitizer, in a folder of its own, and runs the tests.
#   scripts/sanitize.sh address|undefined|thread [ctest arguments ...]
# address: with leaks; undefined: every finding ends the test; thread: with what TBB is known for suppressed.
# Folders: build-address/ and so on, or CONCAVE_DISTANCE_SANITIZE_DIR. About 15 minutes each on two cores.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

kind="${1:-}"
case "$kind" in
  address) flags=(-fsanitize=address) ;;
  undefined) flags=(-fsanitize=undefined -fno-sanitize-recover=undefined) ;;
  thread) flags=(-fsanitize=thread) ;;
  *) die "name one of: address, undefined, thread" ;;
esac
shift
build_dir="${CONCAVE_DISTANCE_SANITIZE_DIR:-$package_dir/build-$kind}"

launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
generator=()
if [ ! -f "$build_dir/CMakeCache.txt" ] && command -v ninja >/dev/null; then generator=(-G Ninja); fi
# Sanitizers slow programs down; -O1 keeps what they say readable.
cmake -S "$package_dir" -B "$build_dir" "${generator[@]}" "${launcher[@]}" -DCMAKE_BUILD_TYPE=None \
  -DCMAKE_CXX_FLAGS="-O1 -g1 -fno-omit-frame-pointer ${flags[*]}" -DCONCAVE_DISTANCE_WITH_ROS=OFF \
  -DCONCAVE_DISTANCE_BUILD_BENCHMARKS=OFF
cmake --build "$build_dir" --parallel "$(job_count)"

export ASAN_OPTIONS=detect_leaks=1:detect_stack_use_after_return=1
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS="suppressions=$package_dir/scripts/thread_sanitizer_suppressions.txt"
# Other packages that link the core are built by the consumer tests, without a sanitizer.
cd "$build_dir"
ctest --timeout 900 --output-on-failure --parallel "$(job_count)" --exclude-regex '^consumer_|^launch_files' "$@"
