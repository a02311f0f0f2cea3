#!/usr/bin/env bash
# Writes the tables of doc/*.md and config/ConcaveDistance.cfg that are made from the declarations of the parameters.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
CONCAVE_DISTANCE_WRITE_TABLES=1 "$build_dir/test/bin/ros_tests" --gtest_filter='ParameterDocumentation.*'
