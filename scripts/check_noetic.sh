#!/usr/bin/env bash
# Compiles the package with the compiler and the libraries of Ubuntu 20.04, where ROS Noetic lives, and runs its tests.
#   scripts/check_noetic.sh [programs|tests] [ninja arguments ...]     (default: tests, after the programs)
# Needs root, debootstrap, Ubuntu's and Debian's archives, and hours. All is in CONCAVE_DISTANCE_NOETIC, by default in the
# user's cache: `root` is a minimal Ubuntu 20.04 with GCC 9.3, CMake 3.16, Eigen 3.3.7, assimp 5.0, TBB 2020.1, Python 3.8
# and Ubuntu's own ROS packages, which are older than those of ROS Noetic. What Ubuntu lacks comes from Debian's packages:
# headers of CLI11 and diagnostic_updater and, for the tests, RapidCheck and FCL 0.6.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
exec </dev/null

what=tests
case "${1:-}" in
  programs | tests) what="$1" && shift ;;
esac
[ "$(id -u)" -eq 0 ] || die "run it as root: it makes a root folder of its own and mounts the sources there"
command -v debootstrap >/dev/null || die "debootstrap is not installed"
# In a mount namespace of its own, whose mounts end with it.
if [ -z "${CONCAVE_DISTANCE_NOETIC_INSIDE:-}" ]; then
  CONCAVE_DISTANCE_NOETIC_INSIDE=1 exec unshare --mount --propagation private "$0" "$what" "$@"
fi

folder="${CONCAVE_DISTANCE_NOETIC:-${XDG_CACHE_HOME:-$HOME/.cache}/concave_distance_noetic}"
root="$folder/root"
inside() {
  chroot "$root" env -i HOME=/tmp PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 \
    CCACHE_DIR=/ccache CCACHE_SLOPPINESS=pch_defines,time_macros ROS_HOSTNAME=localhost "$@"
}

make_root() {
  local keyring=/usr/share/keyrings/ubuntu-archive-keyring.gpg check=(--no-check-gpg)
  if [ -f "$keyring" ]; then check=(--keyring "$keyring"); else say "no $keyring: Ubuntu's packages are not verified"; fi
  rm -rf "$root"
  mkdir -p "$folder"
  debootstrap "${check[@]}" --variant=minbase --components=main,universe focal "$root"
}

# from_debian <suite> <packages ...>: unpacks them in the root folder.
from_debian() {
  local suite="$1" lists="$folder/debian/$1" archive
  shift
  mkdir -p "$lists/lists/partial"
  # shellcheck disable=SC2016 # apt-get fills it in
  archive="$(apt-get indextargets --format '$(REPO_URI)' 'Origin: Debian' 'Component: main' | grep -v security | head -n 1)"
  echo "deb $archive $suite main" >"$lists/sources.list"
  : >"$lists/status"
  local options=(-q -o "Dir::Etc::sourcelist=$lists/sources.list" -o Dir::Etc::sourceparts=- -o "Dir::State::lists=$lists/lists"
    -o "Dir::State::status=$lists/status" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= -o APT::Sandbox::User=root)
  apt-get "${options[@]}" update
  (cd "$lists" && apt-get "${options[@]}" download "$@")
  local package
  for package in "$lists"/*.deb; do dpkg -x "$package" "$root"; done
}

# What Debian's static RapidCheck calls of newer standard libraries than that of GCC 9.
write_newer_functions() {
  cat >"$root/newer_functions.cpp" <<'SOURCE'
#include <exception>
#include <new>

namespace std {
void __throw_bad_array_new_length() { throw bad_array_new_length(); }
namespace __exception_ptr {
void exception_ptr::_M_addref() noexcept {
  alignas(exception_ptr) unsigned char never_destroyed[sizeof(exception_ptr)];
  new (never_destroyed) exception_ptr(*this);
}
void exception_ptr::_M_release() noexcept { exception_ptr().swap(*this); }
}  // namespace __exception_ptr
}  // namespace std
SOURCE
  inside g++ -c -fPIC /newer_functions.cpp -o /newer_functions.o
}

install_packages() {
  local wanted=() package
  while read -r package; do
    case "$package" in
      libfcl-dev) ;;  # of Debian
      *) if inside apt-cache show "$package" >/dev/null 2>&1; then wanted+=("$package"); else say "Ubuntu has no $package"; fi ;;
    esac
  done <<<"$wanted_now"
  inside apt-get -q -y install --no-install-recommends "${wanted[@]}" ccache libccd-dev libdiagnostic-msgs-dev liboctomap-dev
}

wanted_now="$("$package_dir/scripts/install_dependencies.sh" --print debian build test)"
if [ ! -d "$root" ] || [ ! -f "$folder/complete" ]; then make_root; fi
mount -t proc proc "$root/proc"
# A root folder of before gets what the package has come to need since.
if [ "$wanted_now" != "$(cat "$folder/complete" 2>/dev/null)" ]; then
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  inside apt-get -q update
  install_packages
  from_debian bookworm libcli11-dev librapidcheck-dev
  from_debian bullseye libdiagnostic-updater-dev libfcl-dev libfcl0.6
  printf '%s\n' "$wanted_now" >"$folder/complete"
fi

mkdir -p "$root/source" "$root/build"
mount --bind "$package_dir" "$root/source"
mount -o remount,bind,ro "$root/source"
options=(-DCONCAVE_DISTANCE_WITH_ROS=ON -DCONCAVE_DISTANCE_WITH_THESIS=ON -DCONCAVE_DISTANCE_WITH_PYTHON=ON
  -DCONCAVE_DISTANCE_BUILD_BENCHMARKS=OFF -DCONCAVE_DISTANCE_FAST_BUILD=ON
  -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DCMAKE_EXE_LINKER_FLAGS=/newer_functions.o)
write_newer_functions
inside cmake -S /source -B /build -G Ninja "${options[@]}"
inside ninja -C /build -k 0 "$@" concave_distance_programs
say "the programs compile"
[ "$what" = tests ] || exit 0
inside ninja -C /build -k 0 "$@"
say "everything compiles"
# Rostests need the master of ROS, consumers a workspace: these run where ROS is complete.
inside sh -c 'cd /build && ctest --timeout 1200 --output-on-failure --exclude-regex "_rostest_"'
