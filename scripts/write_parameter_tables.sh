#!/usr/bin/env bash
# Writes the tables of the documents and config/ConcaveDistance.cfg that are made from the declarations of the parameters.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
export CONCAVE_DISTANCE_WRITE_TABLES=1
"$build_dir/test/bin/ros_tests" --gtest_filter='ParameterDocumentation.*'
"$build_dir/test/bin/thesis_tests" --gtest_filter='CombGaParameters.*Document'
