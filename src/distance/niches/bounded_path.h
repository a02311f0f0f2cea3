#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/pair_table.h"
#include "concave_distance/base/work_limit.h"
#include "distance/bound/certificate.h"
#include "distance/kernels/pair_frame.h"
#include "facet_pair_levels.h"
#include "facet_pair_neighbours.h"
#include "mesh/surface/triangle_adjacency.h"

namespace concave_distance::detail {

/// Buffers of one thread; cleared, never freed.
struct BoundedPathBuffers {
  /// A facet of the body that moves.
  struct Reached {
    TriangleIndex facet;
    double squared_level;  ///< the highest on the way here
  };
  struct Open {
    double remaining;  ///< square metres, to the target
    std::uint32_t reached;
  };
  std::vector<bool> known[2];  ///< facets of A and B; false between calls
  std::vector<Reached> reached;
  std::vector<Open> open;
};

/// Looks for a path over facet pairs with the distance below a limit, moving one body at a time. The
/// highest distance on it, metres, bounds the pass between its ends.
/// Unlike a search in order of distance, which covers the whole basin of both bodies first, it visits at most
/// the facets of one body, those towards the target first.
class BoundedPath {
 public:
  BoundedPath(const PairFrame& frame, BoundedPathBuffers& buffers, WorkLimit& work)
      : frame_(frame), buffers_(buffers), work_(work) {}

  /// @param from, to facet pairs
  /// @param has_arrived (facet of A, facet of B) whether the path may end here
  /// @param first_moves the body that moves first, 0: A, 1: B
  /// @return empty when no such path was found, which proves nothing
  template <typename Arrived>
  std::optional<double> find(TrianglePair from, TrianglePair to, double limit, int first_moves,
                             const Arrived& has_arrived) {
    TrianglePair here = from;
    double squared_level = 0.0;
    for (const int side : {first_moves, 1 - first_moves}) {
      const auto level = move(side, here, to, limit, has_arrived);
      if (!level) return std::nullopt;
      squared_level = std::max(squared_level, *level);
      if (has_arrived(here.a, here.b)) break;
    }
    return std::sqrt(squared_level);
  }

 private:
  FacetPoints pointsOf(int side, TriangleIndex facet) const {
    return side == 0 ? frame_.facetOfA(facet) : frame_.facetOfB(facet);
  }
  static Eigen::Vector3d middleOf(const FacetPoints& points) {
    return (points.corners[0] + points.corners[1] + points.corners[2]) / 3.0;
  }
  static bool isFarther(const BoundedPathBuffers::Open& l, const BoundedPathBuffers::Open& r) {
    if (l.remaining != r.remaining) return l.remaining > r.remaining;
    return l.reached > r.reached;
  }

  /// Moves one body's facet to the target's, or until the path may end.
  template <typename Arrived>
  std::optional<double> move(int side, TrianglePair& here, TrianglePair to, double limit,
                             const Arrived& has_arrived) {
    const BodyMesh& body = side == 0 ? frame_.a : frame_.b;
    const auto& adjacency = side == 0 ? *frame_.adjacency_a : *frame_.adjacency_b;
    const FacetPoints still = pointsOf(1 - side, side == 0 ? here.b : here.a);
    const TriangleIndex target = side == 0 ? to.a : to.b;
    const Eigen::Vector3d middle = middleOf(pointsOf(side, target));
    std::vector<bool>& known = buffers_.known[side];
    if (known.size() < body.surface().triangleCount()) known.resize(body.surface().triangleCount(), false);
    buffers_.reached.clear();
    buffers_.open.clear();
    const auto enter = [&](TriangleIndex t, double squared_level) {
      known[t.value] = true;
      buffers_.open.push_back({(middleOf(pointsOf(side, t)) - middle).squaredNorm(),
                               static_cast<std::uint32_t>(buffers_.reached.size())});
      buffers_.reached.push_back({t, squared_level});
      std::push_heap(buffers_.open.begin(), buffers_.open.end(), isFarther);
    };
    std::optional<double> result;
    enter(side == 0 ? here.a : here.b, 0.0);
    while (!buffers_.open.empty() && !work_.isOverNow()) {
      std::pop_heap(buffers_.open.begin(), buffers_.open.end(), isFarther);
      const BoundedPathBuffers::Reached next = buffers_.reached[buffers_.open.back().reached];
      buffers_.open.pop_back();
      (side == 0 ? here.a : here.b) = next.facet;
      if (next.facet == target || has_arrived(here.a, here.b)) {
        result = next.squared_level;
        break;
      }
      const FacetPoints points = pointsOf(side, next.facet);
      const FacetPairLevels levels =
          side == 0 ? facetPairLevels(points, still) : facetPairLevels(still, points);
      const std::array<NodeIndex, 4>& nodes =
          (side == 0 ? frame_.facets_a : frame_.facets_b)->nodes[next.facet.value];
      for (const AdjacentTriangle& beyond : adjacency.row(next.facet.value)) {
        if (known[beyond.triangle.value]) continue;
        const Side of = side == 0 ? Side::A : Side::B;
        const double squared = squaredLevelOver(frame_, of, nodes, points, beyond,
                                                side == 0 ? levels.edges_of_a : levels.edges_of_b,
                                                side == 0 ? here.b : here.a, still);
        if (squared > limit * limit) continue;
        enter(beyond.triangle, std::max(squared, next.squared_level));
      }
    }
    for (const BoundedPathBuffers::Reached& reached : buffers_.reached) known[reached.facet.value] = false;
    return result;
  }

  const PairFrame& frame_;
  BoundedPathBuffers& buffers_;
  WorkLimit& work_;
};

}  // namespace concave_distance::detail
