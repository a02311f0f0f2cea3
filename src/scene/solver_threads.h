#pragma once

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>
#include <thread>

namespace concave_distance {

/// Returns how many threads solve pairs: 0 is one per core, and TBB gives no more than that.
inline int solverThreads(std::uint32_t threads) {
  const std::uint32_t cores = std::max(1U, std::thread::hardware_concurrency());
  return static_cast<int>(threads == 0 ? cores : std::min(threads, cores));
}

/// The arena of a cycle: TBB assigns its threads to it first (in versions of TBB with priorities).
inline tbb::task_arena makeSolverArena(std::uint32_t threads) {
#if TBB_INTERFACE_VERSION >= 12000
  return tbb::task_arena(solverThreads(threads), 1, tbb::task_arena::priority::high);
#else
  return tbb::task_arena(solverThreads(threads));
#endif
}

}  // namespace concave_distance
