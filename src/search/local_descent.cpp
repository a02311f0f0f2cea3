#include "local_descent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/pair_key.h"

namespace concave_distance {
namespace {

using Neighbourhood = NodeGraph::Neighbourhood;

// Distances are compared by their bits, which order as the numbers do because none is negative, with the
// seat's number in the lowest three. Signed, for which every processor has a vector comparison.
constexpr std::int32_t kSeatMask = Neighbourhood::kSize - 1;

std::int32_t bitsOf(float value) {
  std::int32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

float valueOf(std::int32_t bits) {
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

// Vectors of the compiler (GCC and clang, any processor): left to itself it unrolls the loop over the seats
// and then finds nothing to vectorise.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));
constexpr std::size_t kLanes = 4;
static_assert(Neighbourhood::kSize == 2 * kLanes, "closestSeat() takes the seats in two halves");

Float4 lanesFrom(const std::array<float, Neighbourhood::kSize>& values, std::size_t first) {
  Float4 lanes;
  std::memcpy(&lanes, &values[first], sizeof(lanes));
  return lanes;
}

/// Keys of the squared distances from (x, y, z) to four seats.
Int4 keysOf(const Neighbourhood& seats, std::size_t first, float x, float y, float z, Int4 numbers) {
  const Float4 dx = lanesFrom(seats.x, first) - x;
  const Float4 dy = lanesFrom(seats.y, first) - y;
  const Float4 dz = lanesFrom(seats.z, first) - z;
  const Float4 squared = dx * dx + dy * dy + dz * dz;
  Int4 bits;
  std::memcpy(&bits, &squared, sizeof(bits));
  return (bits & ~kSeatMask) | numbers;
}

/// The key of the seat closest to (x, y, z). Without a branch: which neighbour is best cannot be predicted.
std::int32_t closestSeat(const Neighbourhood& seats, float x, float y, float z) {
  const Int4 low = keysOf(seats, 0, x, y, z, Int4{0, 1, 2, 3});
  const Int4 high = keysOf(seats, kLanes, x, y, z, Int4{4, 5, 6, 7});
  const Int4 least = low < high ? low : high;
  return std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
}

/// Least difference of squared distances, computed as above, that proves which is smaller.
/// With u = 2^-24, t the target and s a seat at distance d from it, |s| <= |t| + d: rounding s, t and s - t
/// leaves an error of at most e = 2 sqrt(3) u (|t| + d) in s - t, so 2 d e + e^2 in its square, to which
/// summing adds 3 u d^2 and the seat's bits 8 * 2^-23 d^2; twice that for a difference. The factors below are
/// rounded up.
float provenDifference(float squared_distance, float target_norm) {
  const float distance = std::sqrt(squared_distance);
  const float reach = target_norm + distance;
  return 0x1.0p-19F * distance * reach + 0x1.0p-43F * reach * reach + 0x1.0p-18F * squared_distance;
}

/// Where a walk in float has come to.
struct Place {
  std::uint32_t node;
  std::int32_t value;  ///< key of its squared distance
  bool is_minimum;     ///< no neighbour looks closer
  std::int32_t least;  ///< key of the closest neighbour, of a minimum
};

/// Walks while a neighbour looks closer to `local` (relative to the graph's origin), `most_steps` at the
/// most. The values fall strictly, so it ends.
Place walk(const NodeGraph& graph, NodeIndex node, const Eigen::Vector3f& local, std::uint32_t most_steps,
           SearchCost& cost) {
  const Eigen::Vector3f start =
      (graph.positions[node.value] - graph.neighbourhood_origin).cast<float>() - local;
  Place place{node.value, bitsOf(start.squaredNorm()) & ~kSeatMask, false, 0};
  for (std::uint32_t steps = 0; steps < most_steps; ++steps) {
    const Neighbourhood* seats = &graph.neighbourhoods[place.node];
    std::int32_t least = closestSeat(*seats, local.x(), local.y(), local.z());
    std::uint32_t closest = seats->to[static_cast<std::size_t>(least & kSeatMask)];
    cost.evaluations += seats->count;
    while (seats->more != Neighbourhood::kNoMore) {
      seats = &graph.neighbourhoods[seats->more];
      const std::int32_t candidate = closestSeat(*seats, local.x(), local.y(), local.z());
      if (candidate < least) {
        least = candidate;
        closest = seats->to[static_cast<std::size_t>(candidate & kSeatMask)];
      }
      cost.evaluations += seats->count;
    }
    least &= ~kSeatMask;
    if (!(least < place.value)) {
      place.is_minimum = true;
      place.least = least;
      return place;
    }
    place.value = least;
    place.node = closest;
    ++cost.descent_steps;
  }
  return place;
}

/// Steps on one level after which a walk goes on with longer ones.
constexpr std::uint32_t kStepsOnALevel = 8;
constexpr std::uint32_t kNoLimit = 0xffffffffU;

Eigen::Vector3f localTarget(const NodeGraph& graph, const Eigen::Vector3d& target) {
  return (target - graph.neighbourhood_origin).cast<float>();
}

/// From `node` over the levels from the finest on, as far up as the walk is long, and down again. A valley
/// that the walk starts in is not stepped over: only who has gone kStepsOnALevel steps without meeting a
/// bottom takes longer ones. Returns a node of the graph.
NodeIndex walkInLongSteps(const std::vector<NodeLevel>& levels, NodeIndex node, const Eigen::Vector3d& target,
                          SearchCost& cost) {
  std::size_t level = 0;
  for (bool is_minimum = false; !is_minimum && level < levels.size(); ++level) {
    const NodeGraph& graph = levels[level].graph;
    const std::uint32_t most_steps = level + 1 < levels.size() ? kStepsOnALevel : kNoLimit;
    const Place place =
        walk(graph, levels[level].node_of_finer[node.value], localTarget(graph, target), most_steps, cost);
    node = NodeIndex{place.node};
    is_minimum = place.is_minimum;
  }
  while (level > 0) {
    // A coarse node is one of the next finer graph.
    --level;
    node = levels[level].finer_node[node.value];
    if (level == 0) break;
    const NodeGraph& graph = levels[level - 1].graph;
    node = NodeIndex{walk(graph, node, localTarget(graph, target), kNoLimit, cost).node};
  }
  return node;
}

struct Approach {
  NodeIndex node;
  bool proven;  ///< none of its neighbours is closer, whatever the rounding
};

/// Walks in float to where no neighbour looks closer to `target` (in the graph's frame).
Approach approach(const BodyGrid& grid, NodeIndex node, const Eigen::Vector3d& target, DescentMoves moves,
                  SearchCost& cost) {
  const NodeGraph& graph = grid.graph();
  const std::vector<NodeLevel>& levels = grid.nodes().levels.levels;
  const Eigen::Vector3f local = localTarget(graph, target);
  const bool has_levels = moves != DescentMoves::OneNodeAlongEdges && !levels.empty();
  Place place = walk(graph, node, local, has_levels ? kStepsOnALevel : kNoLimit, cost);
  if (!place.is_minimum) {
    const NodeIndex far = walkInLongSteps(levels, NodeIndex{place.node}, target, cost);
    const Place arrived = walk(graph, far, local, kNoLimit, cost);
    // Coarse steps may lead to a worse valley; then on from where the fine ones stopped.
    place = arrived.value < place.value ? arrived : walk(graph, NodeIndex{place.node}, local, kNoLimit, cost);
  }
  const float nearest = valueOf(place.least);
  return {NodeIndex{place.node}, nearest - valueOf(place.value) > provenDifference(nearest, local.norm())};
}

/// One descent. The stored squared distance, in double and in A's frame, only ever falls; whatever was found
/// in float or in B's frame is accepted only when it does. Node pairs being finitely many, it ends.
class Descent {
 public:
  Descent(const PairObjective& objective, const TrialPoint& start, DescentMoves moves, BasinMemory* memory,
          std::vector<std::uint64_t>& trail, SearchCost& cost)
      : objective_(objective),
        graph_a_(objective.gridA().graph()),
        graph_b_(objective.gridB().graph()),
        point_(start),
        moves_(moves),
        memory_(memory),
        trail_(trail),
        cost_(cost) {
    trail_.clear();
  }

  /// True when it ended in a basin that was known.
  bool run() {
    if (joinsKnownBasin()) {
      return true;
    }
    b_in_a_ = objective_.aFromB() * graph_b_.positions[point_.node_b.value];
    point_.squared_distance = squaredDistanceBetween(graph_a_.positions[point_.node_a.value], b_in_a_);
    ++cost_.evaluations;
    do {
      moveA();
      // When B has had its say and A does not move either, both are at their best.
      do {
        if (joinsKnownBasin()) {
          return true;
        }
      } while (moveB() && !joinsKnownBasin() && moveA());
    } while (!joined_ && moves_ == DescentMoves::BothNodes && stepBoth());
    return joined_;
  }

  const TrialPoint& point() const { return point_; }

 private:
  /// Takes over the minimum of a descent that stood on this pair, else leaves a mark.
  bool joinsKnownBasin() {
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

  /// True when A's node has moved; then none of its neighbours is closer.
  bool moveA() {
    const NodeIndex start = point_.node_a;
    const auto [reached, proven] = approach(objective_.gridA(), start, b_in_a_, moves_, cost_);
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

  /// To the closest neighbour when it is closer. Strictly, and neighbours ascend: of equals the smallest
  /// index stays.
  bool stepA() {
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
  bool moveB() {
    const Eigen::Vector3d& a = graph_a_.positions[point_.node_a.value];
    const NodeIndex start = point_.node_b;
    const auto [reached, proven] =
        approach(objective_.gridB(), start, objective_.bFromA() * a, moves_, cost_);
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

  bool stepB() {
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

  /// To the closest pair of neighbours when it is closer. Ties as in stepA().
  bool stepBoth() {
    const TrialPoint start = point_;
    for (const NodeGraph::Edge& edge_b : graph_b_.edges.row(start.node_b.value)) {
      const Eigen::Vector3d neighbour_in_a = objective_.aFromB() * graph_b_.positions[edge_b.to.value];
      for (const NodeGraph::Edge& edge_a : graph_a_.edges.row(start.node_a.value)) {
        const double candidate = squaredDistanceBetween(graph_a_.positions[edge_a.to.value], neighbour_in_a);
        if (candidate < point_.squared_distance) {
          point_ = {edge_a.to, edge_b.to, candidate};
          b_in_a_ = neighbour_in_a;
        }
      }
    }
    cost_.evaluations +=
        graph_a_.edges.row(start.node_a.value).size() * graph_b_.edges.row(start.node_b.value).size();
    cost_.descent_steps += samePlace(point_, start) ? 0 : 1;
    return !samePlace(point_, start);
  }

  const PairObjective& objective_;
  const NodeGraph& graph_a_;
  const NodeGraph& graph_b_;
  TrialPoint point_;
  DescentMoves moves_;
  Eigen::Vector3d b_in_a_ = Eigen::Vector3d::Zero();
  BasinMemory* memory_;
  std::vector<std::uint64_t>& trail_;
  SearchCost& cost_;
  bool joined_ = false;
};

}  // namespace

TrialPoint descend(const PairObjective& objective, TrialPoint start, BasinMemory* memory,
                   std::vector<std::uint64_t>& trail, SearchCost& cost, DescentMoves moves) {
  ++cost.descents;
  Descent descent(objective, start, moves, memory, trail, cost);
  const bool joined = descent.run();
  cost.descents_joined += joined ? 1 : 0;
  if (memory != nullptr && !trail.empty()) {
    const std::uint32_t index = memory->addMinimum(descent.point());
    for (const std::uint64_t pair : trail) {
      memory->insert(NodeIndex{static_cast<std::uint32_t>(pair >> 32U)},
                     NodeIndex{static_cast<std::uint32_t>(pair & 0xffffffffU)}, index);
    }
  }
  return descent.point();
}

}  // namespace concave_distance
