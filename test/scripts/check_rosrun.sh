#!/usr/bin/env bash
# rosrun finds every program after the devel space's setup file, as doc/building.md says.
#   check_rosrun.sh <devel space> <program> ...
set -euo pipefail
devel="$1"
shift
export ROS_HOSTNAME=localhost
set +u
# shellcheck disable=SC1091
. "$devel/setup.bash"
set -u
for program in "$@"; do
  if ! output="$(rosrun concave_distance "$program" --help </dev/null 2>&1)"; then
    printf 'rosrun concave_distance %s --help:\n%s\n' "$program" "$output" >&2
    exit 1
  fi
  case "$output" in
    *Usage* | *usage* | *OPTIONS* | *Options*) ;;
    *) printf 'rosrun concave_distance %s --help has no usage:\n%s\n' "$program" "$output" >&2 && exit 1 ;;
  esac
done
