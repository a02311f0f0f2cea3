#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "concave_distance/mesh/surface/surface_mesh.h"

/// Plain measures of a surface, computed the obvious way. Metres.
namespace concave_distance::test {

inline Eigen::Vector3d areaVector(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& c) {
  return 0.5 * (b - a).cross(c - a);
}

inline Eigen::Vector3d areaVector(const SurfaceMesh& mesh, std::size_t triangle) {
  const TriangleIndex t{triangle};
  return areaVector(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
}

inline double totalArea(const SurfaceMesh& mesh) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) area += areaVector(mesh, t).norm();
  return area;
}

/// Positive for a closed surface whose triangles face outwards.
inline double signedVolume(const SurfaceMesh& mesh) {
  double volume = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    volume += areaVector(mesh, t).dot(mesh.corner(TriangleIndex{t}, 0)) / 3.0;
  }
  return volume;
}

using EdgeNodes = std::pair<std::uint32_t, std::uint32_t>;

/// How many triangles use each edge, in each direction: first from the lower node to the higher one.
inline std::map<EdgeNodes, std::pair<int, int>> edgeUses(const SurfaceMesh& mesh) {
  std::map<EdgeNodes, std::pair<int, int>> uses;
  for (const TriangleNodes& t : mesh.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k].value;
      const std::uint32_t b = t[(k + 1) % 3].value;
      auto& use = uses[{std::min(a, b), std::max(a, b)}];
      (a < b ? use.first : use.second) += 1;
    }
  }
  return uses;
}

/// Every edge has one triangle each way.
inline bool isClosedManifold(const SurfaceMesh& mesh) {
  const auto uses = edgeUses(mesh);
  return std::all_of(uses.begin(), uses.end(), [](const auto& edge) {
    return edge.second == std::pair<int, int>{1, 1};
  });
}

/// Length of the edges other than those with one triangle each way, by how many triangles they have: it can
/// only lie on such edges of the original surface, whatever is refined.
inline std::map<std::pair<int, int>, double> unpairedLength(const SurfaceMesh& mesh) {
  std::map<std::pair<int, int>, double> length;
  for (const auto& [nodes, use] : edgeUses(mesh)) {
    const std::pair<int, int> either_direction = std::minmax(use.first, use.second);
    if (either_direction != std::pair<int, int>{1, 1}) {
      length[either_direction] +=
          (mesh.vertex(NodeIndex{nodes.first}) - mesh.vertex(NodeIndex{nodes.second})).norm();
    }
  }
  return length;
}

/// Nodes in use - edges + triangles.
inline long eulerCharacteristic(const SurfaceMesh& mesh) {
  std::set<std::uint32_t> used;
  for (const TriangleNodes& t : mesh.triangles()) {
    for (const NodeIndex node : t) used.insert(node.value);
  }
  return static_cast<long>(used.size()) - static_cast<long>(edgeUses(mesh).size()) +
         static_cast<long>(mesh.triangleCount());
}

inline double longestEdge(const SurfaceMesh& mesh) {
  double longest = 0.0;
  for (const auto& [nodes, use] : edgeUses(mesh)) {
    longest = std::max(longest,
                       (mesh.vertex(NodeIndex{nodes.first}) - mesh.vertex(NodeIndex{nodes.second})).norm());
  }
  return longest;
}

/// Smallest angle of any triangle, radians.
inline double smallestAngle(const SurfaceMesh& mesh) {
  double smallest = 4.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d u = mesh.corner(TriangleIndex{t}, (k + 1) % 3) - mesh.corner(TriangleIndex{t}, k);
      const Eigen::Vector3d v = mesh.corner(TriangleIndex{t}, (k + 2) % 3) - mesh.corner(TriangleIndex{t}, k);
      smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)));
    }
  }
  return smallest;
}

/// By projection and clamping (Ericson, Real-Time Collision Detection, 5.1.5).
template <typename Scalar>
Scalar distanceToTriangle(const Eigen::Matrix<Scalar, 3, 1>& p, const Eigen::Matrix<Scalar, 3, 1>& a,
                          const Eigen::Matrix<Scalar, 3, 1>& b, const Eigen::Matrix<Scalar, 3, 1>& c) {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  const auto to_segment = [&p](const Vector& u, const Vector& v) {
    const Scalar s = std::clamp<Scalar>((p - u).dot(v - u) / (v - u).squaredNorm(), Scalar(0), Scalar(1));
    return Scalar((p - (u + s * (v - u))).norm());
  };
  const Vector n = (b - a).cross(c - a);
  const bool above =
      n.cross(b - a).dot(p - a) >= 0 && n.cross(c - b).dot(p - b) >= 0 && n.cross(a - c).dot(p - c) >= 0;
  if (above) return std::abs(Scalar(n.normalized().dot(p - a)));
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

inline double distanceToSurface(const Eigen::Vector3d& p, const SurfaceMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex i{t};
    least = std::min(least, distanceToTriangle(p, mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)));
  }
  return least;
}

}  // namespace concave_distance::test
