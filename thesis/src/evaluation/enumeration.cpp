#include "enumeration.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>

#include "base/infinity.h"
#include "distance/kernels/surface_walk.h"
#include "search/grid/node_graph.h"

namespace concave_distance {
namespace {

std::vector<Eigen::Vector3d> inFrameOfA(const std::vector<Eigen::Vector3d>& points_in_b,
                                        const Eigen::Isometry3d& a_from_b) {
  std::vector<Eigen::Vector3d> points_in_a;
  points_in_a.reserve(points_in_b.size());
  for (const Eigen::Vector3d& point : points_in_b) {
    points_in_a.push_back(a_from_b * point);
  }
  return points_in_a;
}

// Ties go to the smaller indices, so that the answer does not depend on how the range was split.
bool before(const NodePairMinimum& l, const NodePairMinimum& r) {
  if (l.squared_distance != r.squared_distance) return l.squared_distance < r.squared_distance;
  if (l.node_a != r.node_a) return l.node_a < r.node_a;
  return l.node_b < r.node_b;
}

bool before(const WitnessPair& l, const WitnessPair& r) {
  if (l.squared_distance != r.squared_distance) return l.squared_distance < r.squared_distance;
  if (l.triangle_a != r.triangle_a) return l.triangle_a < r.triangle_a;
  return l.triangle_b < r.triangle_b;
}

template <typename Best, typename BestOfRow>
Best leastOverRows(std::size_t rows, const Best& worst, BestOfRow&& best_of_row) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, rows), worst,
      [&](const tbb::blocked_range<std::size_t>& range, Best best) {
        for (std::size_t row = range.begin(); row != range.end(); ++row) {
          best_of_row(row, best);
        }
        return best;
      },
      [](const Best& l, const Best& r) { return before(r, l) ? r : l; });
}

Eigen::AlignedBox3d boxOf(const TrianglePoints& triangle) {
  Eigen::AlignedBox3d box(triangle[0]);
  box.extend(triangle[1]);
  box.extend(triangle[2]);
  return box;
}

}  // namespace

NodePairMinimum enumerateNodePairs(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  const std::vector<Eigen::Vector3d>& nodes_a = a.graph().positions;
  const std::vector<Eigen::Vector3d> nodes_b = inFrameOfA(b.graph().positions, a_from_b);
  const NodePairMinimum worst{kInfinity, NodeIndex{0}, NodeIndex{0}};
  return leastOverRows(nodes_a.size(), worst, [&](std::size_t i, NodePairMinimum& best) {
    for (std::size_t j = 0; j < nodes_b.size(); ++j) {
      const NodePairMinimum pair{(nodes_a[i] - nodes_b[j]).squaredNorm(), NodeIndex{i}, NodeIndex{j}};
      if (before(pair, best)) {
        best = pair;
      }
    }
  });
}

WitnessPair enumerateTrianglePairs(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  const std::vector<Eigen::Vector3d> vertices_b = inFrameOfA(b.surface().vertices(), a_from_b);
  std::vector<TrianglePoints> triangles_b;
  std::vector<Eigen::AlignedBox3d> boxes_b;
  for (const TriangleNodes& t : b.surface().triangles()) {
    triangles_b.push_back({vertices_b[t[0].value], vertices_b[t[1].value], vertices_b[t[2].value]});
    boxes_b.push_back(boxOf(triangles_b.back()));
  }
  WitnessPair worst;
  worst.squared_distance = kInfinity;
  return leastOverRows(a.surface().triangleCount(), worst, [&](std::size_t i, WitnessPair& best) {
    const TrianglePoints triangle_a = trianglePoints(a.surface(), TriangleIndex{i});
    const Eigen::AlignedBox3d box_a = boxOf(triangle_a);
    for (std::size_t j = 0; j < triangles_b.size(); ++j) {
      // The boxes' distance carries a few roundings of its own: skip only what is clearly farther.
      if (box_a.squaredExteriorDistance(boxes_b[j]) > best.squared_distance * (1.0 + 1e-12)) {
        continue;
      }
      const TrianglePairDistance d = triangleDistance(triangle_a, triangles_b[j]);
      const WitnessPair pair{d.squared_distance, d.point_a,   d.point_b,  TriangleIndex{i},
                             TriangleIndex{j},   d.feature_a, d.feature_b};
      if (before(pair, best)) {
        best = pair;
      }
    }
  });
}

}  // namespace concave_distance
