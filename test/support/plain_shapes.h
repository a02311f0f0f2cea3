#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "base/random_engine.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

/// Hand-sized surfaces that need nothing but the container. Metres.
namespace concave_distance::test {

inline SurfaceMesh makeSurface(std::vector<Eigen::Vector3d> vertices,
                               std::initializer_list<std::array<std::uint32_t, 3>> corners) {
  std::vector<TriangleNodes> triangles;
  for (const auto& c : corners) {
    triangles.push_back({NodeIndex{c[0]}, NodeIndex{c[1]}, NodeIndex{c[2]}});
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "hand-made surface");
}

/// Closed, outward oriented, 8 vertices (bit k of the index: upper end of axis k) and 12 triangles.
inline SurfaceMesh makeCuboid(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  std::vector<Eigen::Vector3d> vertices;
  for (std::uint32_t i = 0; i < 8; ++i) {
    vertices.emplace_back((i & 1U) != 0 ? high.x() : low.x(), (i & 2U) != 0 ? high.y() : low.y(),
                          (i & 4U) != 0 ? high.z() : low.z());
  }
  return makeSurface(std::move(vertices), {{0, 2, 3},
                                           {0, 3, 1},
                                           {4, 5, 7},
                                           {4, 7, 6},
                                           {0, 1, 5},
                                           {0, 5, 4},
                                           {2, 6, 7},
                                           {2, 7, 3},
                                           {0, 4, 6},
                                           {0, 6, 2},
                                           {1, 3, 7},
                                           {1, 7, 5}});
}

/// The same surface with every triangle turned.
inline SurfaceMesh makeTurned(const SurfaceMesh& mesh) {
  std::vector<TriangleNodes> triangles = mesh.triangles();
  for (TriangleNodes& t : triangles) {
    std::swap(t[1], t[2]);
  }
  return SurfaceMesh(mesh.vertices(), std::move(triangles), "turned surface");
}

/// The same surface without the triangle `dropped`.
inline SurfaceMesh makeOpened(const SurfaceMesh& mesh, std::size_t dropped) {
  std::vector<TriangleNodes> triangles = mesh.triangles();
  triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(dropped));
  return SurfaceMesh(mesh.vertices(), std::move(triangles), "opened surface");
}

/// Two surfaces as one mesh; vertices are not welded.
inline SurfaceMesh makeJoined(const SurfaceMesh& a, const SurfaceMesh& b,
                              const Eigen::Vector3d& offset = Eigen::Vector3d::Zero()) {
  std::vector<Eigen::Vector3d> vertices = a.vertices();
  std::vector<TriangleNodes> triangles = a.triangles();
  const auto shift = static_cast<std::uint32_t>(vertices.size());
  for (const Eigen::Vector3d& v : b.vertices()) vertices.push_back(v + offset);
  for (const TriangleNodes& t : b.triangles()) {
    triangles.push_back(
        {NodeIndex{t[0].value + shift}, NodeIndex{t[1].value + shift}, NodeIndex{t[2].value + shift}});
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "joined surfaces");
}

/// Uniform in [low, high).
inline double uniformIn(RandomEngine& engine, double low, double high) {
  return low + (high - low) * uniformUnit(engine);
}

inline Eigen::Vector3d uniformInCube(RandomEngine& engine, double half_side) {
  const double x = uniformIn(engine, -half_side, half_side);
  const double y = uniformIn(engine, -half_side, half_side);
  const double z = uniformIn(engine, -half_side, half_side);
  return {x, y, z};
}

/// A cone's surface without its base: triangles around one vertex.
inline SurfaceMesh makeFan(std::uint32_t count) {
  std::vector<Eigen::Vector3d> vertices{Eigen::Vector3d::UnitZ()};
  std::vector<TriangleNodes> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * i / count;
    vertices.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    triangles.push_back({NodeIndex{0}, NodeIndex{1 + i}, NodeIndex{1 + (i + 1) % count}});
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "fan");
}

}  // namespace concave_distance::test
