#include "benchmark/engines/engine_table.h"

namespace concave_distance::benchmark {

std::vector<TableEngine> bulletEngines() {
  return {};
}

}  // namespace concave_distance::benchmark
