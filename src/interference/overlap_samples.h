#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "concave_distance/interference/interference.h"
#include "depth_planes.h"

namespace concave_distance {

/// The greatest depth of a region, and its line.
struct DeepestPoint {
  double depth = 0.0;
  Eigen::Vector3d inside_in_a = Eigen::Vector3d::Zero();   ///< on one body's surface, inside the other
  Eigen::Vector3d surface_in_a = Eigen::Vector3d::Zero();  ///< the closest point of the other's surface
  bool inside_is_of_b = true;
};

/// Integrates over the surfaces of an overlap how deep they lie. A part of a facet takes the planes of the
/// other surface that are nearest to its corners and the middles of its edges: where the least of their
/// heights is the depth, which its centre shows, the integral is that of linear functions; else it is halved.
/// Facets far smaller than the region have one sample.
class OverlapSampler {
 public:
  void begin(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);
  /// Adds the samples of the facets of one region.
  /// @param tolerance parts that may be wrong by a smaller share of the integral of the depth are not halved
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
  /// A facet with one sample.
  struct Candidate {
    std::uint32_t facet;
    TriangleIndex nearest;
    double reachable;  ///< no point of it is deeper
  };

  Corner look(const OverlapFacet& facet, const Eigen::Vector3d& point, DeepestPoint& deepest);
  Part wholeOf(const OverlapFacet& facet, const Part* before, DeepestPoint& deepest);
  void halve(const OverlapFacet& facet, const Part& part, DeepestPoint& deepest);
  void integrate(const OverlapFacet& facet, const Part& whole, double allowed,
                 std::vector<OverlapSample>& samples, DeepestPoint& deepest);
  void findPlanes(const OverlapFacet& facet, const Part& part);
  double worstHeight(const OverlapFacet& facet, const Part& part, DeepestPoint& deepest);
  void addBelowPlanes(const OverlapFacet& facet, const Part& part, std::vector<OverlapSample>& samples,
                      DeepestPoint& deepest);
  void addQuadratic(const OverlapFacet& facet, const Part& part, std::vector<OverlapSample>& samples) const;
  void lookAtCorners(const OverlapFacet* first, DeepestPoint& deepest);
  double depthBound(const OverlapFacet& facet, const std::array<Eigen::Vector3d, 3>& corners,
                    TriangleIndex nearest) const;
  bool mayBeDeeper(const OverlapFacet& facet, const Part& part, const DeepestPoint& deepest) const;

  const BodyMesh* body_[2] = {nullptr, nullptr};
  Eigen::Isometry3d a_from_b_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d b_from_a_ = Eigen::Isometry3d::Identity();
  TriangleIndex last_nearest_[2];
  std::vector<Part> parts_;
  std::vector<Part> wholes_;
  std::vector<std::uint32_t> large_;  ///< facets of wholes_
  std::vector<Candidate> small_;
  DepthPlanes planes_;
};

}  // namespace concave_distance
