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

# use_build: what follows finds the programs and messages of build_dir.
use_build() {
  source_ros
  set +u
  # shellcheck disable=SC1091
  . "$build_dir/devel/setup.bash"
  set -u
}

# use_own_master PORT LOG_FOLDER: what follows has a ROS master of its own, beside one that may run.
use_own_master() {
  use_build
  export ROS_MASTER_URI="http://localhost:$1" ROS_HOSTNAME=localhost ROS_LOG_DIR="$2"
  unset ROS_IP
  mkdir -p "$ROS_LOG_DIR"
  if rosparam get /run_id >/dev/null 2>&1; then die "a master already runs at $ROS_MASTER_URI: end it first"; fi
}

# start_scene LOG ARGUMENTS ...: starts roslaunch with that master and waits for it; end_scene ends it, at the latest at exit.
launch_pid=
start_scene() {
  local log="$1"
  shift
  setsid roslaunch "--port=${ROS_MASTER_URI##*:}" concave_distance "$@" </dev/null >"$log" 2>&1 &
  launch_pid=$!
  trap end_scene EXIT
  until rosparam get /run_id >/dev/null 2>&1; do
    kill -0 "$launch_pid" 2>/dev/null || { tail -n 30 "$log" >&2 && die "the scene did not start"; }
    sleep 0.2
  done
}
end_scene() {
  [ -n "$launch_pid" ] || return 0
  kill -INT "$launch_pid" 2>/dev/null || true
  wait "$launch_pid" 2>/dev/null || true
  launch_pid=
}

# Parallel jobs: one per core, but 1.5 GB of memory for each compiler.
job_count() {
  local cores by_memory
  cores="$(nproc)"
  by_memory="$(awk '/^MemAvailable:/ {print int($2 / 1024 / 1500)}' /proc/meminfo)"
  [ "${by_memory:-0}" -ge 1 ] || by_memory=1
  echo $((cores < by_memory ? cores : by_memory))
}
