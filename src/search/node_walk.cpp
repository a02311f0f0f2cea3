#include "node_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

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

/// Where a walk in float has ended.
struct Place {
  std::uint32_t node;
  std::int32_t value;  ///< key of its squared distance
  std::int32_t least;  ///< key of the closest neighbour
};

/// Walks while a neighbour looks closer to `local` (relative to the graph's origin). The values fall
/// strictly, so it ends.
Place walk(const NodeGraph& graph, NodeIndex node, const Eigen::Vector3f& local, SearchCost& cost) {
  const Eigen::Vector3f start =
      (graph.positions[node.value] - graph.neighbourhood_origin).cast<float>() - local;
  Place place{node.value, bitsOf(start.squaredNorm()) & ~kSeatMask, 0};
  while (true) {
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
      place.least = least;
      return place;
    }
    place.value = least;
    place.node = closest;
    ++cost.descent_steps;
  }
}

}  // namespace

Approach approach(const NodeGraph& graph, NodeIndex node, const Eigen::Vector3d& target, SearchCost& cost) {
  const Eigen::Vector3f local = (target - graph.neighbourhood_origin).cast<float>();
  const Place place = walk(graph, node, local, cost);
  const float nearest = valueOf(place.least);
  return {NodeIndex{place.node}, nearest - valueOf(place.value) > provenDifference(nearest, local.norm())};
}

}  // namespace concave_distance
