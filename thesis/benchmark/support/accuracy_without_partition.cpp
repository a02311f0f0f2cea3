#include <cstdio>

#include "thesis/benchmark/support/accuracy_partition.h"

namespace concave_distance::benchmark {

void addPartition(Rows&, const BenchmarkPair& pair) {
  std::printf("%-18s %-22s left out: built without CGAL\n", pair.name.c_str(), "partition");
}

}  // namespace concave_distance::benchmark
