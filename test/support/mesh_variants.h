#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "base/random_engine.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

/// The same surface in other words: moved, scaled, with other numbers for its vertices and triangles.
namespace concave_distance::test {

inline TriangleSoup soupOf(const SurfaceMesh& mesh) {
  TriangleSoup soup;
  soup.vertices = mesh.vertices();
  for (const TriangleNodes& t : mesh.triangles())
    soup.triangles.push_back({t[0].value, t[1].value, t[2].value});
  return soup;
}

template <typename Change>
SurfaceMesh withVertices(const SurfaceMesh& mesh, const char* name, const Change& change) {
  std::vector<Eigen::Vector3d> vertices = mesh.vertices();
  for (Eigen::Vector3d& vertex : vertices) vertex = change(vertex);
  return SurfaceMesh(std::move(vertices), mesh.triangles(), name);
}

inline SurfaceMesh movedSurface(const SurfaceMesh& mesh, const Eigen::Isometry3d& pose) {
  return withVertices(mesh, "moved", [&](const Eigen::Vector3d& v) -> Eigen::Vector3d { return pose * v; });
}

inline SurfaceMesh scaledSurface(const SurfaceMesh& mesh, double factor) {
  return withVertices(mesh, "scaled",
                      [&](const Eigen::Vector3d& v) -> Eigen::Vector3d { return factor * v; });
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

template <typename T>
void shuffle(std::vector<T>& items, RandomEngine& engine) {
  for (std::size_t i = items.size(); i > 1; --i) {
    std::swap(items[i - 1], items[uniformIndex(engine, static_cast<std::uint32_t>(i))]);
  }
}

/// New numbers for the vertices, another order of the triangles, another first corner of each.
inline SurfaceMesh relabelledSurface(const SurfaceMesh& mesh, RandomEngine& engine) {
  std::vector<std::uint32_t> order(mesh.vertexCount());
  std::iota(order.begin(), order.end(), 0U);
  shuffle(order, engine);
  std::vector<Eigen::Vector3d> vertices(mesh.vertexCount());
  for (std::size_t i = 0; i < order.size(); ++i) vertices[order[i]] = mesh.vertices()[i];
  std::vector<TriangleNodes> triangles = mesh.triangles();
  for (TriangleNodes& t : triangles) {
    for (NodeIndex& node : t) node = NodeIndex{order[node.value]};
    std::rotate(t.begin(), t.begin() + uniformIndex(engine, 3), t.end());
  }
  shuffle(triangles, engine);
  return SurfaceMesh(std::move(vertices), std::move(triangles), "relabelled");
}

/// A sphere's mesh stretched to half axes, with every so many vertices pushed in by a share of their distance
/// from the centre.
inline SurfaceMesh makeDentedEllipsoid(const Eigen::Vector3d& half_axes, double sag, double depth,
                                       std::size_t every) {
  const SurfaceMesh ball = makeSphere(1.0, sag);
  std::vector<Eigen::Vector3d> vertices;
  for (const Eigen::Vector3d& vertex : ball.vertices()) {
    const double share = vertices.size() % every == 0 ? 1.0 - depth : 1.0;
    vertices.push_back(share * half_axes.cwiseProduct(vertex));
  }
  return SurfaceMesh(std::move(vertices), ball.triangles(), "dented ellipsoid");
}

}  // namespace concave_distance::test
