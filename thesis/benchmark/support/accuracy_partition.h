#pragma once

#include "benchmark/support/benchmark_pairs.h"
#include "thesis/benchmark/support/accuracy_rows.h"

namespace concave_distance::benchmark {

/// Rows of the convex partition (automatic, cut beforehand), with quadratic programs and with GJK, all
/// sub-pairs and culled. Prints which pairs are left out and why: bodies that cannot be partitioned, and all
/// sub-pairs where these are more than 10,000. A build without CGAL says so and adds nothing.
void addPartition(Rows& rows, const BenchmarkPair& pair);

}  // namespace concave_distance::benchmark
