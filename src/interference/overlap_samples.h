#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "concave_distance/interference/interference.h"

namespace concave_distance {

/// The greatest depth of a region, and its line.
struct DeepestPoint {
  double depth = 0.0;
  Eigen::Vector3d inside_in_a = Eigen::Vector3d::Zero();   ///< on one body's surface, inside the other
  Eigen::Vector3d surface_in_a = Eigen::Vector3d::Zero();  ///< the closest point of the other's surface
  bool inside_is_of_b = true;
};

/// Integrates over the surfaces of an overlap how deep they lie: each facet is halved until the depth is
/// linear on its parts, to a share of the region's whole integral, and each part has the middles of its edges
/// as samples. Facets far smaller than the region have one sample.
class OverlapSampler {
 public:
  void begin(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);
  /// Adds the samples of the facets of one region.
  /// @param tolerance parts whose share of the integral of the depth is smaller are not halved, > 0
  void sample(const OverlapFacet* first, const OverlapFacet* last, double tolerance,
              std::vector<OverlapSample>& samples, DeepestPoint& deepest);

 private:
  struct Corner {
    Eigen::Vector3d point;
    Eigen::Vector3d exit;
    double depth;
    TriangleIndex nearest;  ///< of the other body
  };
  struct Part {
    std::array<Corner, 3> corners;
    std::array<Corner, 3> middles;  ///< of the edges k to k + 1
    std::uint32_t level;
  };

  Corner look(const OverlapFacet& facet, const Eigen::Vector3d& point, DeepestPoint& deepest);
  Part wholeOf(const OverlapFacet& facet, DeepestPoint& deepest);
  void integrate(const OverlapFacet& facet, const Part& whole, double allowed,
                 std::vector<OverlapSample>& samples, DeepestPoint& deepest);
  void findDeepest(const OverlapFacet* first, const OverlapFacet* last, DeepestPoint& deepest);
  double depthBound(const OverlapFacet& facet, const Part& part) const;
  void halve(const OverlapFacet& facet, const Part& part, DeepestPoint& deepest);

  const BodyMesh* body_[2] = {nullptr, nullptr};
  Eigen::Isometry3d a_from_b_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d b_from_a_ = Eigen::Isometry3d::Identity();
  TriangleIndex last_nearest_[2];
  std::vector<Part> parts_;
  std::vector<std::uint32_t> large_;
  std::vector<Part> wholes_;  ///< of large_
};

}  // namespace concave_distance
