#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace concave_distance {

/// The stages of a solve, in their order.
enum class SolveStage : std::uint8_t {
  Follow,    ///< known niches to where their minima have moved
  Search,    ///< genetic search, its descents, refinement and judging of what it found
  Project,   ///< closest points of the body opposite, from niches and random nodes
  Sweep,     ///< normal cones for what no search finds; at level `complete` all of it
  Review,    ///< known niches flooded again
  Proof,     ///< of the distance
  Describe,  ///< kind, extent, visibility of the reported niches, and their list
};
inline constexpr std::size_t kSolveStageCount = 7;
inline constexpr const char* kSolveStageNames[kSolveStageCount] = {"follow", "search", "project", "sweep",
                                                                   "review", "proof",  "describe"};

/// Seconds that each stage of one solve took.
struct StageTimes {
  std::array<double, kSolveStageCount> seconds{};

  double& operator[](SolveStage stage) { return seconds[static_cast<std::size_t>(stage)]; }
  double operator[](SolveStage stage) const { return seconds[static_cast<std::size_t>(stage)]; }
};

/// Splits a solve into laps, each counted for a stage.
class StageClock {
 public:
  void start() { last_ = Clock::now(); }
  void lap(SolveStage stage, StageTimes& times) {
    const Clock::time_point now = Clock::now();
    times[stage] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_;
};

}  // namespace concave_distance
