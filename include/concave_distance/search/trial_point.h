#pragma once

#include <array>
#include <cstdint>

#include "concave_distance/base/cost_counter.h"
#include "concave_distance/base/indices.h"

namespace concave_distance {

/// A node pair and its objective (Carretero, eq. (3.1), (3.2)).
struct TrialPoint {
  NodeIndex node_a;
  NodeIndex node_b;
  double squared_distance = 0.0;

  /// Total order with ties broken by node: what makes one seed give one answer.
  friend bool operator<(const TrialPoint& l, const TrialPoint& r) {
    if (l.squared_distance != r.squared_distance) return l.squared_distance < r.squared_distance;
    if (l.node_a != r.node_a) return l.node_a < r.node_a;
    return l.node_b < r.node_b;
  }
  friend bool samePlace(const TrialPoint& l, const TrialPoint& r) {
    return l.node_a == r.node_a && l.node_b == r.node_b;
  }
};

/// Counts what a search has cost so far, and what ran. A new counter is a field, a line in the sum and, for
/// the diagnostics, a row of counters().
struct SearchCost {
  std::uint64_t evaluations =
      0;  ///< distances computed: node pairs and, from level `refined` on, pairs of features and facets
  std::uint64_t descents = 0;         ///< local descents started
  std::uint64_t descents_joined = 0;  ///< of these, ended early in a basin already descended this cycle
  std::uint64_t descent_steps = 0;
  std::uint32_t generations = 0;  ///< of the genetic algorithm
  std::uint32_t inherited = 0;    ///< individuals of its first populations that stood on known niches
  std::uint32_t children = 0;     ///< individuals that took one node or place from either of two parents

  SearchCost& operator+=(const SearchCost& more) {
    evaluations += more.evaluations;
    descents += more.descents;
    descents_joined += more.descents_joined;
    descent_steps += more.descent_steps;
    generations += more.generations;
    inherited += more.inherited;
    children += more.children;
    return *this;
  }

  /// Lists what the diagnostics report of a sum, by key.
  static const auto& counters() {
    static constexpr std::array<CostCounter<SearchCost>, 1> kCounters{{
        {"search generations", [](const SearchCost& cost) -> std::uint64_t { return cost.generations; }},
    }};
    return kCounters;
  }
};

}  // namespace concave_distance
