#include "drop_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace concave_distance::detail {
namespace {

bool hasNoArea(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  return ab.cross(ac).norm() <= kRounding * longest;
}

}  // namespace

std::size_t dropWithoutArea(const std::vector<Eigen::Vector3d>& vertices,
                            std::vector<TriangleNodes>& triangles) {
  const auto end = std::remove_if(triangles.begin(), triangles.end(), [&](const TriangleNodes& t) {
    return hasNoArea(vertices[t[0].value], vertices[t[1].value], vertices[t[2].value]);
  });
  const auto dropped = static_cast<std::size_t>(triangles.end() - end);
  triangles.erase(end, triangles.end());
  return dropped;
}

std::size_t dropUnused(std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles) {
  std::vector<bool> used(vertices.size(), false);
  for (const TriangleNodes& nodes : triangles) {
    for (const NodeIndex node : nodes) {
      used[node.value] = true;
    }
  }
  std::vector<NodeIndex> renumbered(vertices.size());
  std::size_t kept = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (used[v]) {
      renumbered[v] = NodeIndex{kept};
      vertices[kept++] = vertices[v];
    }
  }
  for (TriangleNodes& nodes : triangles) {
    for (NodeIndex& node : nodes) {
      node = renumbered[node.value];
    }
  }
  const std::size_t dropped = vertices.size() - kept;
  vertices.resize(kept);
  return dropped;
}

}  // namespace concave_distance::detail
