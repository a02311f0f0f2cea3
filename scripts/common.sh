# shellcheck shell=bash
# Sourced by the other scripts: where the package is, the system's own Python first, ROS, and how many jobs.

package_dir="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
# shellcheck disable=SC2034  # used by the scripts that source this one
build_dir="${CONCAVE_DISTANCE_BUILD_DIR:-$package_dir/build}"

# ROS's tools are written for the system's Python; one from pyenv or conda that is first on PATH breaks them.
export PATH="/usr/sbin:/usr/bin:/sbin:/bin:$PATH"
unset PYTHONHOME

say() { printf '== %s\n' "$*"; }
die() { printf 'error: %s\n' "$*" >&2; exit 1; }

# ROS from a third party's packages (Ubuntu) lives in /opt/ros; Debian's own lies in /usr and needs no setup.
source_ros() {
  if [ -z "${ROS_DISTRO:-}" ] && [ -f /opt/ros/noetic/setup.bash ]; then
    set +u
    # shellcheck disable=SC1091
    . /opt/ros/noetic/setup.bash
    set -u
  fi
}

# Parallel jobs: one per core, but 1.5 GB of memory for each compiler.
job_count() {
  local cores by_memory
  cores="$(nproc)"
  by_memory="$(awk '/^MemAvailable:/ {print int($2 / 1024 / 1500)}' /proc/meminfo)"
  [ "${by_memory:-0}" -ge 1 ] || by_memory=1
  echo $((cores < by_memory ? cores : by_memory))
}
