#include "depth_walls.h"

#include <cmath>
#include <cstdint>

#include "distance/kernels/surface_walk.h"
#include "distance/kernels/triangle_distance.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance::detail {
namespace {

// A triangle that as many others lie near is divided instead of being compared with all of them.
constexpr int kMostCompared = 64;

}  // namespace

void DepthWalls::begin(const BodyMesh& body, double slack) {
  body_ = &body;
  slack_ = slack;
}

Eigen::Vector3d DepthWalls::ceiling(const std::array<Eigen::Vector3d, 3>& corners, TriangleIndex wall) const {
  const TrianglePoints triangle = trianglePoints(body_->surface(), wall);
  const Eigen::Vector3d& normal = body_->topology().triangle_normals[wall.value];
  Eigen::Vector3d distances;
  Eigen::Vector3d heights;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    distances[i] = std::sqrt(pointTriangleDistance(corners[k], triangle).squared_distance);
    heights[i] = normal.dot(triangle[0] - corners[k]);
  }
  if (normal.isZero() || heights.minCoeff() < -slack_ || (distances - heights).maxCoeff() <= slack_)
    return distances;
  std::array<Eigen::Vector3d, 3> feet;
  for (std::size_t k = 0; k < 3; ++k)
    feet[k] = corners[k] + (heights[static_cast<Eigen::Index>(k)] + slack_) * normal;
  return isOutside(feet) ? Eigen::Vector3d(heights.array() + slack_) : distances;
}

bool DepthWalls::isOutside(const std::array<Eigen::Vector3d, 3>& triangle) const {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& corner : triangle) box.extend(corner);
  const TriangleTree& tree = body_->tree();
  std::array<std::uint32_t, 96> stack;  // the builder keeps the depth below 80; one waiting child a level
  std::size_t waiting = 0;
  int compared = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const std::uint32_t index = stack[--waiting];
    const TriangleTree::Node& node = tree.nodes()[index];
    if (!node.box.intersects(box)) continue;
    if (node.count == 0) {
      stack[waiting++] = node.first;
      stack[waiting++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (++compared > kMostCompared) return false;
      const TrianglePoints other = trianglePoints(body_->surface(), tree.order()[i]);
      if (!(triangleDistance(triangle, other).squared_distance > 0.0)) return false;
    }
  }
  return !containsPoint(tree, body_->surface(), body_->topology().shell_is_closed,
                        body_->topology().shell_of_triangle, triangle[0]);
}

}  // namespace concave_distance::detail
