#!/usr/bin/env bash
# Builds the core, the tools and their tests with a sanitizer, in a folder of its own, and runs the tests.
#   scripts/sanitize.sh [address] [undefined] [thread] [-- ctest arguments ...]       (default: address+undefined, thread)
# address and undefined may be joined in one build: address+undefined. address: with leaks; undefined: every finding
# ends the test; thread: with a TBB that is built with the sanitizer too, from the distribution's source package or
# CONCAVE_DISTANCE_TBB_SOURCE, since the installed one synchronises where the sanitizer does not see it and every loop
# would look like a race. One test after another where --parallel 1 is given.
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
root="$(realpath -m "${CONCAVE_DISTANCE_SANITIZE_DIR:-$package_dir}")"

"$package_dir/scripts/install_dependencies.sh" build test sanitize

export ASAN_OPTIONS=detect_leaks=1:detect_stack_use_after_return=1
export UBSAN_OPTIONS=print_stacktrace=1

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

# oneTBB's source package, of the version that is installed if the archive still has it, without touching the system's
# package lists.
fetch_tbb_source() {
  local folder="$1" version options
  mkdir -p "$folder/sources" "$folder/lists/partial" "$folder/cache/archives/partial"
  for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [ ! -f "$list" ] || sed -n 's/^deb /deb-src /p' "$list" >>"$folder/sources/source.list"
  done
  for list in /etc/apt/sources.list.d/*.sources; do
    [ ! -f "$list" ] || sed 's/^Types:.*/Types: deb-src/' "$list" >"$folder/sources/$(basename "$list")"
  done
  options=(-q -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$folder/sources"
    -o "Dir::State::lists=$folder/lists" -o "Dir::Cache=$folder/cache" -o Debug::NoLocking=1 -o Acquire::Retries=3)
  apt-get "${options[@]}" update || say "some package lists could not be read"
  version="$(dpkg-query -W -f='${source:Version}' libtbb-dev)"
  (cd "$folder" && { apt-get "${options[@]}" source "onetbb=$version" || apt-get "${options[@]}" source onetbb; }) ||
    die "apt has no source package onetbb: set CONCAVE_DISTANCE_TBB_SOURCE to a folder with oneTBB's source"
}

# Builds TBB with the thread sanitizer and has the tests load that one (`wrapper`).
use_sanitized_tbb() {
  local folder="$1" source="${CONCAVE_DISTANCE_TBB_SOURCE:-}" library
  if ! find "$folder/build" -name libtbb.so.12 2>/dev/null | grep -q .; then
    say "thread: building TBB with the sanitizer in $folder"
    if [ -z "$source" ]; then
      fetch_tbb_source "$folder"
      source="$(find "$folder" -mindepth 1 -maxdepth 1 -type d -name 'onetbb-*' | sort | tail -n 1)"
    fi
    cmake -S "$source" -B "$folder/build" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_SANITIZE=thread -DTBB_TEST=OFF \
      -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF
    cmake --build "$folder/build" --parallel "$(job_count)"
  fi
  library="$(find "$folder/build" -name libtbb.so.12 | head -n 1)"
  wrapper=(env "LD_LIBRARY_PATH=$(dirname "$library")${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" "${wrapper[@]}")
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
    -DCONCAVE_DISTANCE_BUILD_BENCHMARKS=OFF -DCONCAVE_DISTANCE_FAST_BUILD=ON \
    -DCONCAVE_DISTANCE_TEST_TIMEOUT=1500
  cmake --build "$build_dir" --parallel "$(job_count)"
  if [ "$kind" = thread ]; then use_sanitized_tbb "$build_dir/tbb"; fi
  say "$kind: running the tests"
  # Other packages that link the core are built by the consumer tests, without a sanitizer.
  (cd "$build_dir" && "${wrapper[@]}" ctest --output-on-failure --parallel "$(job_count)" \
    --exclude-regex '^consumer_|^launch_files' "$@") || failed+=("$kind")
done
[ ${#failed[@]} -eq 0 ] || die "findings: ${failed[*]}"
say "no findings: ${kinds[*]}"
