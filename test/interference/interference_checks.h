#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "concave_distance/interference/interference.h"
#include "concave_distance/mesh/body_mesh.h"
#include "support/body_pairs.h"

namespace concave_distance::test {

inline Interference interferenceOf(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  InterferenceWorkspace workspace;
  Interference result;
  findInterference(a, b, a_from_b, workspace, result);
  return result;
}

inline Interference interferenceOf(const SurfaceMesh& a, const SurfaceMesh& b,
                                   const Eigen::Isometry3d& a_from_b) {
  return interferenceOf(*makeBody(a), *makeBody(b), a_from_b);
}

/// The same surface with every edge halved: four triangles of each.
inline SurfaceMesh halvedEdges(const SurfaceMesh& mesh) {
  std::vector<Eigen::Vector3d> vertices = mesh.vertices();
  std::map<std::pair<NodeIndex, NodeIndex>, NodeIndex> middle_of;
  const auto middle = [&](NodeIndex p, NodeIndex q) {
    const auto [entry, is_new] = middle_of.emplace(std::minmax(p, q), NodeIndex{vertices.size()});
    if (is_new) vertices.push_back(0.5 * (mesh.vertex(p) + mesh.vertex(q)));
    return entry->second;
  };
  std::vector<TriangleNodes> triangles;
  for (const TriangleNodes& t : mesh.triangles()) {
    const TriangleNodes m = {middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    triangles.push_back(m);
    for (std::size_t k = 0; k < 3; ++k) triangles.push_back({t[k], m[k], m[(k + 2) % 3]});
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "halved");
}

/// A rotation of no special angle.
inline Eigen::Isometry3d slanted(double angle = 0.7) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()));
}

}  // namespace concave_distance::test
