#!/usr/bin/env bash
# Static checks.
#   scripts/lint.sh [format] [comments] [tidy] [catkin] [shell]     (default: all of them)
# format: clang-format on every source file. tidy: clang-tidy over the whole package (many minutes).
# comments: comments of headers that begin in the middle of a sentence. catkin: catkin_lint with all notices.
# shell: shellcheck on the scripts.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$package_dir"

checks=("$@")
[ ${#checks[@]} -gt 0 ] || checks=(format comments tidy catkin shell)
if [ "${checks[*]}" = comments ]; then
  :  # needs grep alone
elif [ "${checks[*]}" = format ]; then
  scripts/install_dependencies.sh format
else
  scripts/install_dependencies.sh build test lint
fi

check_format() {
  find include src test thesis -name '*.h' -print0 -o -name '*.cpp' -print0 | xargs -0 clang-format --dry-run --Werror
}
check_comments() {
  ! grep -rnE '^ *//[/!]? (Of|What) ' include src --include='*.h'
}
check_tidy() {
  # clang-tidy cannot read the precompiled headers of a build for the demos, which are of another compiler.
  if [ ! -f "$build_dir/compile_commands.json" ] ||
    grep -q '^CONCAVE_DISTANCE_FAST_BUILD:BOOL=ON' "$build_dir/CMakeCache.txt"; then
    scripts/build.sh all -DCONCAVE_DISTANCE_FAST_BUILD=OFF
  fi
  find src test thesis \( -path test/consumer -o -path test/benchmark/engines \) -prune -o -name '*.cpp' -print0 |
    xargs -0 -n 1 -P "$(job_count)" clang-tidy --quiet -p "$build_dir" --extra-arg=-std=c++17 \
      2> >(grep -v 'warnings generated' >&2)
}
check_catkin() {
  catkin_lint -W2 --strict --offline --ignore package_path_name .  # a clone may have any name
}
check_shell() {
  shellcheck -x scripts/*.sh test/fuzz/fuzz.sh .ci/run
}

failed=()
for check in "${checks[@]}"; do
  declare -F "check_$check" >/dev/null || die "unknown check '$check': expected format, comments, tidy, catkin or shell"
  if "check_$check"; then say "$check: clean"; else failed+=("$check"); fi
done
[ ${#failed[@]} -eq 0 ] || die "not clean: ${failed[*]}"
