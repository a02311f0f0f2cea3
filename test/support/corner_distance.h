#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "distance/kernels/triangle_distance.h"

namespace concave_distance::test {

/// The distance at a corner of what two bodies have level, by brute force: from a vertex of one to the whole
/// surface of the other, or between two edges. Found from the corner's points alone.
class CornerDistance {
 public:
  struct Measure {
    double distance;
    Feature feature_a;
    Feature feature_b;
  };

  /// @param on_a @param on_b points of the corner in their bodies' frames @param value their distance
  /// @return nothing where they are on no vertex and no two edges at that distance
  static std::optional<CornerDistance> find(const BodyMesh& a, const BodyMesh& b, const Eigen::Vector3d& on_a,
                                            const Eigen::Vector3d& on_b, const Eigen::Isometry3d& a_from_b,
                                            double value) {
    const double same = 1e-9 * (a.diameter() + b.diameter());
    const auto is_it = [&](const CornerDistance& found) {
      return std::abs(found.at(a_from_b).distance - value) <= same;
    };
    for (const bool of_a : {true, false}) {
      const SurfaceMesh& mesh = of_a ? a.surface() : b.surface();
      for (std::uint32_t i = 0; i < mesh.vertexCount(); ++i) {
        if ((mesh.vertex(NodeIndex{i}) - (of_a ? on_a : on_b)).norm() > same) continue;
        CornerDistance found(a, b);
        found.vertex_of_a_ = of_a;
        found.vertex_ = mesh.vertex(NodeIndex{i});
        if (is_it(found)) return found;
      }
    }
    for (const TrianglePoints& edge_a : edgesThrough(a.surface(), on_a, same)) {
      for (const TrianglePoints& edge_b : edgesThrough(b.surface(), on_b, same)) {
        CornerDistance found(a, b);
        found.edges_ = {edge_a, edge_b};
        if (is_it(found)) return found;
      }
    }
    return std::nullopt;
  }

  Measure at(const Eigen::Isometry3d& a_from_b) const {
    if (edges_) {
      TrianglePoints moved = (*edges_)[1];
      for (Eigen::Vector3d& point : moved) point = a_from_b * point;
      const TrianglePairDistance found = triangleDistance((*edges_)[0], moved);
      return {std::sqrt(found.squared_distance), found.feature_a, found.feature_b};
    }
    const SurfaceMesh& other = (vertex_of_a_ ? b_ : a_)->surface();
    const Eigen::Vector3d point = vertex_of_a_ ? a_from_b.inverse() * vertex_ : a_from_b * vertex_;
    Measure least{std::numeric_limits<double>::infinity(), {}, {}};
    for (std::uint32_t t = 0; t < other.triangleCount(); ++t) {
      const TriangleIndex triangle{t};
      const PointTriangleDistance found = pointTriangleDistance(
          point, {other.corner(triangle, 0), other.corner(triangle, 1), other.corner(triangle, 2)});
      const double distance = std::sqrt(found.squared_distance);
      if (distance < least.distance) least = {distance, {}, found.feature};
    }
    return least;
  }

 private:
  CornerDistance(const BodyMesh& a, const BodyMesh& b) : a_(&a), b_(&b) {}

  static std::vector<TrianglePoints> edgesThrough(const SurfaceMesh& mesh, const Eigen::Vector3d& point,
                                                  double same) {
    std::vector<TrianglePoints> edges;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d begin = mesh.corner(TriangleIndex{t}, k);
        const Eigen::Vector3d end = mesh.corner(TriangleIndex{t}, (k + 1) % 3);
        const Eigen::Vector3d along = end - begin;
        const double share = std::clamp((point - begin).dot(along) / along.squaredNorm(), 0.0, 1.0);
        if ((begin + share * along - point).norm() <= same) edges.push_back({begin, end, end});
      }
    }
    return edges;
  }

  const BodyMesh* a_;
  const BodyMesh* b_;
  bool vertex_of_a_ = true;
  Eigen::Vector3d vertex_ = Eigen::Vector3d::Zero();
  std::optional<std::array<TrianglePoints, 2>> edges_;  ///< of A and B; none: the vertex counts
};

}  // namespace concave_distance::test
