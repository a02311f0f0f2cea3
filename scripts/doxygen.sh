#!/usr/bin/env bash
# Makes the pages of the public headers in build/doxygen/html; a warning is an error.
#   scripts/doxygen.sh
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
"$package_dir/scripts/install_dependencies.sh" doxygen
output="$build_dir/doxygen"
mkdir -p "$output"
doxygen - <<DOXYFILE
PROJECT_NAME = concave_distance
INPUT = "$package_dir/include" "$package_dir/examples"
EXAMPLE_PATH = "$package_dir/examples"
STRIP_FROM_PATH = "$package_dir/include" "$package_dir"
STRIP_FROM_INC_PATH = "$package_dir/include"
OUTPUT_DIRECTORY = "$output"
RECURSIVE = YES
EXTRACT_ALL = YES
JAVADOC_AUTOBRIEF = YES
GENERATE_LATEX = NO
GENERATE_XML = NO
MACRO_EXPANSION = YES
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
WARN_IF_INCOMPLETE_DOC = NO
WARN_AS_ERROR = FAIL_ON_WARNINGS
HAVE_DOT = NO
DOXYFILE
echo "$output/html/index.html"
