#pragma once

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>
#include <thread>

namespace concave_distance {

/// How many threads `~threads` means: 0 is one per core, and TBB gives no more than that.
inline int arenaSize(std::uint32_t threads) {
  const std::uint32_t cores = std::max(1U, std::thread::hardware_concurrency());
  return static_cast<int>(threads == 0 ? cores : std::min(threads, cores));
}

}  // namespace concave_distance
