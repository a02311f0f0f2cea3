#!/usr/bin/env bash
# Installs what is missing, builds everything and runs every test: unit tests, consumer package, rostests. The example
# with Simbody is one where Simbody is installed (scripts/install_dependencies.sh engines).
#   scripts/test.sh [--format]
# --format: check the source formatting too, and count a warning of the compiler as an error.
# The last line is `N passed, N failed`, counted in test cases; what is skipped has failed. The exit status is 0 only
# when none failed.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
exec </dev/null

format=
# Each optional part by name: what cannot be built is a failure, whatever the build folder was configured with before.
build_options=(-DCONCAVE_DISTANCE_WITH_ROS=ON -DCONCAVE_DISTANCE_BUILD_TESTS=ON -DCONCAVE_DISTANCE_WITH_THESIS=ON
  -DCONCAVE_DISTANCE_WITH_PYTHON=ON -DCONCAVE_DISTANCE_WITH_CGAL=ON)
for argument in "$@"; do
  case "$argument" in
    --format)
      format=1
      build_options+=(-DCMAKE_COMPILE_WARNING_AS_ERROR=ON)
      ;;
    *) die "unknown option '$argument'" ;;
  esac
done

count_arguments=()
finish_without_tests() {
  say "$1"
  echo "0 passed, 1 failed"
  exit 1
}

started=$SECONDS
"$package_dir/scripts/install_dependencies.sh" build test demo ||
  finish_without_tests "the dependencies could not be installed"
if [ -n "$format" ]; then
  if "$package_dir/scripts/lint.sh" format; then
    count_arguments+=(--success "source formatting")
  else
    count_arguments+=(--failure "source formatting")
  fi
fi
say "dependencies are there after $((SECONDS - started)) s"

source_ros
# A first build is a fast one and leaves out the benchmark programs, a quarter of all compile time: scripts/build.sh all
# makes them.
if [ ! -f "$build_dir/CMakeCache.txt" ]; then
  build_options+=(-DCONCAVE_DISTANCE_FAST_BUILD=ON -DCONCAVE_DISTANCE_BUILD_BENCHMARKS=OFF)
fi
"$package_dir/scripts/build.sh" all "${build_options[@]}" ||
  count_arguments+=(--failure "the build (see the first error above)")
[ -f "$build_dir/CTestTestfile.cmake" ] || finish_without_tests "the build could not be configured"
say "built after $((SECONDS - started)) s"

# Names that need no resolver, and logs that do not end in the home directory.
export ROS_HOSTNAME=localhost ROS_LOG_DIR="$build_dir/ros_logs" ROS_HOME="$build_dir/ros_home"
unset ROS_IP ROS_MASTER_URI
rm -rf "$build_dir/test_results"
mkdir -p "$build_dir/test_results" "$ROS_LOG_DIR"

# run_tests <name> <ctest arguments ...>: what failed is kept in failed-<name>.log, all output in output-<name>.log.
run_tests() {
  local name="$1" results="$build_dir/test_results" logs="$build_dir/Testing/Temporary"
  shift
  rm -f "$logs/LastTestsFailed.log" "$logs/LastTest.log"
  (cd "$build_dir" && ctest --timeout 300 --output-on-failure "$@") || true
  cp "$logs/LastTest.log" "$results/output-$name.log"
  if [ -f "$logs/LastTestsFailed.log" ]; then cp "$logs/LastTestsFailed.log" "$results/failed-$name.log"; fi
  count_arguments+=(--failed-log "$results/failed-$name.log" --output-log "$results/output-$name.log")
  say "$name tests are through after $((SECONDS - started)) s"
}
run_tests unit --exclude-regex _rostest_ --parallel "$(job_count)"
# They wait more than they work.
run_tests node --tests-regex _rostest_ --parallel "$(($(job_count) + 1))"

/usr/bin/python3 "$package_dir/scripts/count_test_results.py" "$build_dir" "${count_arguments[@]}"
