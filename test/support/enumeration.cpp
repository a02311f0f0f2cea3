#include "support/enumeration.h"

#include <limits>

#include "distance/kernels/surface_walk.h"
#include "search/grid/body_grid.h"
#include "search/grid/node_graph.h"

namespace concave_distance::test {
namespace {

std::vector<Eigen::Vector3d> inFrameOfA(std::vector<Eigen::Vector3d> points,
                                        const Eigen::Isometry3d& a_from_b) {
  for (Eigen::Vector3d& point : points) point = a_from_b * point;
  return points;
}

Eigen::AlignedBox3d boxOf(const TrianglePoints& triangle) {
  Eigen::AlignedBox3d box(triangle[0]);
  box.extend(triangle[1]);
  box.extend(triangle[2]);
  return box;
}

}  // namespace

WitnessPair enumerateTrianglePairs(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  const std::vector<Eigen::Vector3d> vertices_b = inFrameOfA(b.surface().vertices(), a_from_b);
  std::vector<TrianglePoints> triangles_b;
  std::vector<Eigen::AlignedBox3d> boxes_b;
  for (const TriangleNodes& t : b.surface().triangles()) {
    triangles_b.push_back({vertices_b[t[0].value], vertices_b[t[1].value], vertices_b[t[2].value]});
    boxes_b.push_back(boxOf(triangles_b.back()));
  }
  WitnessPair best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.surface().triangleCount(); ++i) {
    const TrianglePoints triangle_a = trianglePoints(a.surface(), TriangleIndex{i});
    const Eigen::AlignedBox3d box_a = boxOf(triangle_a);
    for (std::size_t j = 0; j < triangles_b.size(); ++j) {
      // The boxes' distance carries a few roundings of its own: skip only what is clearly farther.
      if (box_a.squaredExteriorDistance(boxes_b[j]) > best.squared_distance * (1.0 + 1e-12)) continue;
      const TrianglePairDistance d = triangleDistance(triangle_a, triangles_b[j]);
      if (d.squared_distance < best.squared_distance) {
        best = {d.squared_distance, d.point_a,   d.point_b,  TriangleIndex{i},
                TriangleIndex{j},   d.feature_a, d.feature_b};
      }
    }
  }
  return best;
}

TrialPoint enumerateNodePairs(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  const std::vector<Eigen::Vector3d>& nodes_a = gridOf(a).graph().positions;
  const std::vector<Eigen::Vector3d> nodes_b = inFrameOfA(gridOf(b).graph().positions, a_from_b);
  TrialPoint best{NodeIndex{0}, NodeIndex{0}, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < nodes_a.size(); ++i) {
    for (std::size_t j = 0; j < nodes_b.size(); ++j) {
      const double squared_distance = (nodes_a[i] - nodes_b[j]).squaredNorm();
      if (squared_distance < best.squared_distance) best = {NodeIndex{i}, NodeIndex{j}, squared_distance};
    }
  }
  return best;
}

}  // namespace concave_distance::test
