#pragma once

#include <optional>
#include <string>

#include "benchmark/support/benchmark_pairs.h"

namespace concave_distance::benchmark {

/// Two mesh files: B circles A as near as it can without touching it (at 32 instants), turning.
/// @param max_edge_length of both grids, metres; empty: automatic
/// @throws Error for a file that cannot be loaded
BenchmarkPair makeCirclingPair(const std::string& name, const std::string& file_a, const std::string& file_b,
                               std::optional<double> max_edge_length = std::nullopt);

/// Makes it of two files with a colon between them, named after both.
BenchmarkPair makeCirclingPair(const std::string& files);

}  // namespace concave_distance::benchmark
