#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "concave_distance/tracking/pair_effects.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance {

/// Counts the pairs that the rules of a scene watch and that have no tracker in a cycle.
struct OtherPairs {
  std::uint64_t beyond = 0;   ///< proven farther apart than their cutoff and warning distance
  std::uint64_t missing = 0;  ///< a body's pose is not known
  std::uint64_t cut = 0;      ///< near, but more than SceneLimits::pairs
  /// No pair of `beyond` or `cut` is nearer, metres, proven, where each body is at its newest pose.
  double lower_bound = std::numeric_limits<double>::infinity();
};

/// Counts what one cycle did; with add(), what several did.
struct CycleCounts {
  std::uint32_t watched = 0;        ///< pairs
  std::uint32_t beyond_cutoff = 0;  ///< pairs
  std::uint32_t not_located = 0;    ///< pairs
  std::uint32_t unprepared = 0;     ///< pairs whose niches wait for what is made in the background
  std::uint64_t solved = 0;
  std::uint64_t cold = 0;      ///< solves from nothing
  std::uint64_t repeated = 0;  ///< pairs with the input of the cycle before
  std::uint64_t search_misses = 0;
  std::uint64_t put_off = 0;   ///< lists or effects that the end of the cycle left unfinished
  std::uint64_t unproven = 0;  ///< solves at `certified` that a limit ended before the proof
  std::array<std::uint64_t, kNicheOriginCount> niches{};  ///< listed, by NicheOrigin
  SearchCost cost;                                        ///< of all solves
  CertificateCost proof_cost;                             ///< of all solves
  EffectCounts effects;
  double helper_cpu_seconds = 0.0;  ///< processor time of the threads that helped the caller's

  void addSolve(const PairSolution& solution);
  /// Adds another cycle's counts, but for those of pairs as they stand.
  void add(const CycleCounts& cycle);
};

/// Says how much a solve adds to a counter.
using CountOfSolve = std::uint64_t (*)(const PairSolution&);

/// A counter of solves, as the diagnostics report it; costs have rows of their own (SearchCost::counters()).
/// A new one is a field of CycleCounts and a row here: sums and diagnostics follow.
struct CycleCounter {
  const char* key;  ///< in the diagnostics
  std::uint64_t CycleCounts::*count;
  /// Returns what a solved pair adds; nullptr where the tracker itself counts.
  CountOfSolve of;
};

inline const auto& cycleCounters() {
  using Solution = const PairSolution&;
  using Number = std::uint64_t;
  static constexpr std::array<CycleCounter, 6> kCounters{{
      {"solves", &CycleCounts::solved, [](Solution) { return Number{1}; }},
      {"cold solves", &CycleCounts::cold, [](Solution pair) { return Number{pair.warm ? 0U : 1U}; }},
      {"answers repeated without new transforms", &CycleCounts::repeated, nullptr},
      {"search misses", &CycleCounts::search_misses,
       [](Solution pair) { return Number{pair.search_miss ? 1U : 0U}; }},
      {"lists put off to the next cycle", &CycleCounts::put_off, nullptr},
      {"solves that ended unproven", &CycleCounts::unproven,
       [](Solution pair) {
         return Number{
             pair.status == SolveStatus::BudgetExhausted || pair.status == SolveStatus::MemoryExhausted ? 1U
                                                                                                        : 0U};
       }},
  }};
  return kCounters;
}

inline void CycleCounts::addSolve(const PairSolution& solution) {
  for (const CycleCounter& counter : cycleCounters()) {
    if (counter.of != nullptr) this->*counter.count += counter.of(solution);
  }
  cost += solution.cost;
  proof_cost += solution.proof_cost;
  for (const TrackedNiche& niche : solution.niches) ++niches[static_cast<std::size_t>(niche.origin)];
}

inline void CycleCounts::add(const CycleCounts& cycle) {
  for (const CycleCounter& counter : cycleCounters()) this->*counter.count += cycle.*counter.count;
  for (std::size_t i = 0; i < kNicheOriginCount; ++i) niches[i] += cycle.niches[i];
  cost += cycle.cost;
  proof_cost += cycle.proof_cost;
  effects += cycle.effects;
  helper_cpu_seconds += cycle.helper_cpu_seconds;
}

}  // namespace concave_distance
