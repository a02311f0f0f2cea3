#include "memory_arenas.h"

#include <malloc.h>

#include <algorithm>
#include <thread>

namespace concave_distance {

void limitMemoryArenas() {
  mallopt(M_ARENA_MAX, static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
}

}  // namespace concave_distance
