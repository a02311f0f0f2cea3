#pragma once

#include <cstdint>

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

/// What a search has cost so far.
struct SearchCost {
  std::uint64_t evaluations = 0;      ///< node pair distances computed
  std::uint64_t descents = 0;         ///< local descents started
  std::uint64_t descents_joined = 0;  ///< of these, ended early in a basin already descended this cycle
  std::uint64_t descent_steps = 0;
};

}  // namespace concave_distance
