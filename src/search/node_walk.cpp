#include "node_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "search/grid/node_graph.h"
#include "search/grid/node_levels.h"

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

}  // namespace

Approach approach(const BodyGrid& grid, NodeIndex node, const Eigen::Vector3d& target, bool in_long_steps,
                  SearchCost& cost) {
  const NodeGraph& graph = grid.graph();
  const std::vector<NodeLevel>& levels = grid.nodes().levels.levels;
  const Eigen::Vector3f local = localTarget(graph, target);
  const bool has_levels = in_long_steps && !levels.empty();
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

}  // namespace concave_distance
