#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace concave_distance {

/// The stages of a solve, in their order.
enum class SolveStage : std::uint8_t {
  Prove,     ///< the distance
  Follow,    ///< known niches to where their minima have moved
  Propose,   ///< genetic search and refinement of what it found
  Sweep,     ///< normal cones, for every minimum there is
  Admit,     ///< which minima are niches, their kind, extent and visibility, their ids
  Describe,  ///< the answer
};
inline constexpr std::size_t kSolveStageCount = 6;
inline constexpr const char* kSolveStageNames[kSolveStageCount] = {"prove", "follow", "propose",
                                                                   "sweep", "admit",  "describe"};

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
