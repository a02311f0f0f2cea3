#!/usr/bin/env bash
# Builds the core, the tools and their tests with a sanitizer, in a folder of its own, and runs the tests.
#   scripts/sanitize.sh [address] [undefined] [thread] [-- ctest arguments ...]       (default: address+undefined, thread)
# address and undefined may be joined in one build: address+undefined. address: with leaks; undefined: every finding
# ends the test; thread: with what TBB is known for suppressed. One test after another where --parallel 1 is given.
# Folders: build-address and so on, or below CONCAVE_DISTANCE_SANITIZE_DIR. About 25 minutes each on two idle cores.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

kinds=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do
  case "$1" in
    address | undefined | address+undefined | thread) kinds+=("$1") ;;
    *) die "name one or more of: address, undefined, address+undefined, thread (ctest's arguments come after --)" ;;
  esac
  shift
done
[ $# -eq 0 ] || shift
[ ${#kinds[@]} -gt 0 ] || kinds=(address+undefined thread)
root="${CONCAVE_DISTANCE_SANITIZE_DIR:-$package_dir}"

"$package_dir/scripts/install_dependencies.sh" build test

export ASAN_OPTIONS=detect_leaks=1:detect_stack_use_after_return=1
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS="suppressions=$package_dir/scripts/thread_sanitizer_suppressions.txt"

# Whether a program built with these flags starts at all; some kernels lay memory out in a way that an older thread
# sanitizer cannot cope with, then the tests are started without that (`wrapper`).
probe() {
  local folder wrapper_found=1
  folder="$(mktemp -d)"
  echo 'int main() {}' >"$folder/probe.cpp"
  "${CXX:-c++}" "-fsanitize=$1" "$folder/probe.cpp" -o "$folder/probe" ||
    die "the compiler has no sanitizer '$1' (Debian: gcc has them all; clang needs libclang-rt-14-dev)"
  wrapper=()
  if ! "$folder/probe" 2>/dev/null; then
    wrapper=(setarch "$(uname -m)" --addr-no-randomize)
    "${wrapper[@]}" "$folder/probe" || wrapper_found=
  fi
  rm -r "$folder"
  [ -n "$wrapper_found" ] || die "programs with the sanitizer '$1' do not start here"
}

launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
failed=()
for kind in "${kinds[@]}"; do
  flags="-fsanitize=${kind/+/,}"
  [[ "$kind" != *undefined* ]] || flags+=" -fno-sanitize-recover=undefined"
  probe "${kind/+/,}"
  build_dir="$root/build-$kind"
  generator=()
  if [ ! -f "$build_dir/CMakeCache.txt" ] && command -v ninja >/dev/null; then generator=(-G Ninja); fi
  say "$kind: building in $build_dir"
  # Sanitizers slow programs down; -O1 keeps what they say readable.
  cmake -S "$package_dir" -B "$build_dir" "${generator[@]}" "${launcher[@]}" -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_FLAGS="-O1 -g1 -fno-omit-frame-pointer $flags" -DCONCAVE_DISTANCE_WITH_ROS=OFF \
    -DCONCAVE_DISTANCE_BUILD_BENCHMARKS=OFF -DCONCAVE_DISTANCE_PRECOMPILED_HEADERS=ON
  cmake --build "$build_dir" --parallel "$(job_count)"
  say "$kind: running the tests"
  # Other packages that link the core are built by the consumer tests, without a sanitizer.
  (cd "$build_dir" && "${wrapper[@]}" ctest --timeout 900 --output-on-failure --parallel "$(job_count)" \
    --exclude-regex '^consumer_|^launch_files' "$@") || failed+=("$kind")
done
[ ${#failed[@]} -eq 0 ] || die "findings: ${failed[*]}"
say "no findings: ${kinds[*]}"
