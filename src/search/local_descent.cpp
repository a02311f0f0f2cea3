#include "local_descent.h"

#include "base/pair_key.h"
#include "node_walk.h"

namespace concave_distance {

Descent::Descent(const PairObjective& objective, BasinMemory* memory, std::vector<std::uint64_t>& trail,
                 SearchCost& cost)
    : objective_(objective),
      graph_a_(objective.gridA().graph()),
      graph_b_(objective.gridB().graph()),
      cost_(cost),
      memory_(memory),
      trail_(trail) {}

void Descent::begin(const TrialPoint& start) {
  ++cost_.descents;
  point_ = start;
  joined_ = false;
  trail_.clear();
  if (joinsKnownBasin()) return;
  b_in_a_ = objective_.aFromB() * graph_b_.positions[point_.node_b.value];
  point_.squared_distance = squaredDistanceBetween(graph_a_.positions[point_.node_a.value], b_in_a_);
  ++cost_.evaluations;
}

bool Descent::run() {
  if (joined_) return false;
  moveA();
  // When B has had its say and A does not move either, both are at their best.
  do {
    if (joinsKnownBasin()) return false;
  } while (moveB() && !joinsKnownBasin() && moveA());
  return !joined_;
}

const TrialPoint& Descent::end() {
  cost_.descents_joined += joined_ ? 1 : 0;
  if (memory_ != nullptr && !trail_.empty()) {
    const std::uint32_t index = memory_->addMinimum(point_);
    for (const std::uint64_t pair : trail_) {
      memory_->insert(NodeIndex{static_cast<std::uint32_t>(pair >> 32U)},
                      NodeIndex{static_cast<std::uint32_t>(pair & 0xffffffffU)}, index);
    }
  }
  return point_;
}

void Descent::moveTo(const TrialPoint& closer) {
  point_ = closer;
  b_in_a_ = objective_.aFromB() * graph_b_.positions[closer.node_b.value];
}

/// Takes over the minimum of a descent that stood on this pair, else leaves a mark.
bool Descent::joinsKnownBasin() {
  if (memory_ == nullptr) {
    return false;
  }
  const std::uint64_t pair = pairKey(point_.node_a, point_.node_b);
  if (!trail_.empty() && trail_.back() == pair) {
    return false;
  }
  const std::int64_t known = memory_->find(point_.node_a, point_.node_b);
  if (known >= 0) {
    point_ = memory_->minima()[static_cast<std::size_t>(known)];
    joined_ = true;
    return true;
  }
  trail_.push_back(pair);
  return false;
}

/// Returns true when A's node has moved; then none of its neighbours is closer.
bool Descent::moveA() {
  const NodeIndex start = point_.node_a;
  const auto [reached, proven] = approach(graph_a_, start, b_in_a_, cost_);
  if (reached != start) {
    const double reached_distance = squaredDistanceBetween(graph_a_.positions[reached.value], b_in_a_);
    if (reached_distance < point_.squared_distance) {
      point_.squared_distance = reached_distance;
      point_.node_a = reached;
    }
  }
  while (!(proven && point_.node_a == reached) && stepA()) {
  }
  return point_.node_a != start;
}

/// Moves to the closest neighbour when it is closer. Strictly, and neighbours ascend: of equals the smallest
/// index stays.
bool Descent::stepA() {
  const NodeIndex start = point_.node_a;
  for (const NodeGraph::Edge& edge : graph_a_.edges.row(start.value)) {
    const double candidate = squaredDistanceBetween(graph_a_.positions[edge.to.value], b_in_a_);
    if (candidate < point_.squared_distance) {
      point_.squared_distance = candidate;
      point_.node_a = edge.to;
    }
  }
  cost_.evaluations += graph_a_.edges.row(start.value).size();
  cost_.descent_steps += point_.node_a != start ? 1 : 0;
  return point_.node_a != start;
}

/// As moveA(). The walk is in B's frame, where only A's point has to be transformed.
bool Descent::moveB() {
  const Eigen::Vector3d& a = graph_a_.positions[point_.node_a.value];
  const NodeIndex start = point_.node_b;
  const auto [reached, proven] = approach(graph_b_, start, objective_.bFromA() * a, cost_);
  if (reached != start) {
    const Eigen::Vector3d reached_in_a = objective_.aFromB() * graph_b_.positions[reached.value];
    const double reached_distance = squaredDistanceBetween(a, reached_in_a);
    if (reached_distance < point_.squared_distance) {
      point_.squared_distance = reached_distance;
      point_.node_b = reached;
      b_in_a_ = reached_in_a;
    }
  }
  while (!(proven && point_.node_b == reached) && stepB()) {
  }
  return point_.node_b != start;
}

bool Descent::stepB() {
  const Eigen::Vector3d& a = graph_a_.positions[point_.node_a.value];
  const NodeIndex start = point_.node_b;
  for (const NodeGraph::Edge& edge : graph_b_.edges.row(start.value)) {
    const Eigen::Vector3d neighbour_in_a = objective_.aFromB() * graph_b_.positions[edge.to.value];
    const double candidate = squaredDistanceBetween(a, neighbour_in_a);
    if (candidate < point_.squared_distance) {
      point_.squared_distance = candidate;
      point_.node_b = edge.to;
      b_in_a_ = neighbour_in_a;
    }
  }
  cost_.evaluations += graph_b_.edges.row(start.value).size();
  cost_.descent_steps += point_.node_b != start ? 1 : 0;
  return point_.node_b != start;
}

TrialPoint descend(const PairObjective& objective, const TrialPoint& start, BasinMemory* memory,
                   std::vector<std::uint64_t>& trail, SearchCost& cost) {
  Descent descent(objective, memory, trail, cost);
  descent.begin(start);
  descent.run();
  return descent.end();
}

}  // namespace concave_distance
