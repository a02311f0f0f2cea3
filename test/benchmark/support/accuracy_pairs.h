#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmark/support/benchmark_pairs.h"

namespace concave_distance::benchmark {

/// What the package was developed with: the thesis's three scenes, two pairs of links and `rings_100k`: two
/// rings of 100,000 triangles, one passing close by the other, as in scale_benchmark.
std::vector<std::string> accuracyPairs();

/// Pairs of links of Debian's dart-doc (Atlas, Fetch) that no parameter was chosen with, of held_out.csv.
std::vector<std::string> heldOutPairs();
bool isHeldOut(const std::string& name);

/// Whether the files of a held-out pair are installed.
bool isInstalled(const std::string& name);

/// One of these or of the benchmark pairs. @param max_edge_length of both grids, metres; empty: automatic; of
/// the rings always so
/// @throws Error for an unknown name or a file that is missing
BenchmarkPair loadAccuracyPair(const std::string& name, std::optional<double> max_edge_length = std::nullopt);

}  // namespace concave_distance::benchmark
