#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::benchmark {

/// A plain tree of spheres over a surface's triangles, halved along the longest side: an oracle that shares
/// nothing with the library's hierarchies. Body frame.
class SphereTree {
 public:
  explicit SphereTree(const SurfaceMesh& surface);

  /// Calls `visit` with every pair of triangles whose spheres come within `limit` metres of each other; what
  /// it returns is the limit from then on.
  static void forEachPairWithin(const SphereTree& a, const SphereTree& b, const Eigen::Isometry3d& a_from_b,
                                double limit,
                                const std::function<double(std::uint32_t, std::uint32_t)>& visit);

 private:
  struct Node {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0.0;
    std::uint32_t second = 0;    ///< child; the first is next to the node. 0: a leaf
    std::uint32_t triangle = 0;  ///< of a leaf
  };

  void build(const SurfaceMesh& surface, std::uint32_t* begin, std::uint32_t* end);

  std::vector<Node> nodes_;
  std::vector<Eigen::Vector3d> centroids_;
};

}  // namespace concave_distance::benchmark
