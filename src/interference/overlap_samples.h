#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "concave_distance/interference/interference.h"
#include "depth_planes.h"
#include "depth_probe.h"
#include "depth_search.h"

namespace concave_distance {

/// Integrates over the surfaces of an overlap how deep they lie. A part of a facet takes the planes of the
/// other surface that are nearest to its corners and the middles of its edges: where the least of their
/// heights is the depth, which its centre shows, the integral is that of linear functions; else it is halved.
/// Facets far smaller than the region have one sample.
class OverlapSampler {
 public:
  void begin(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
    probe_.begin(a, b, a_from_b);
  }
  /// Adds the samples of the facets of one region.
  /// @param tolerance parts that may be wrong by a smaller share of the integral of the depth are not halved
  /// @return where the region is deepest, to 1 % but for what depth_search.h says
  DeepestPoint sample(const OverlapFacet* first, const OverlapFacet* last, double tolerance,
                      std::vector<OverlapSample>& samples);

 private:
  struct Part {
    std::array<ProbedPoint, 3> corners;
    std::array<ProbedPoint, 3> middles;  ///< of the edges k to k + 1
    std::uint32_t level;
  };
  /// A facet that may hold the deepest point.
  struct Candidate {
    std::uint32_t facet;
    TriangleIndex nearest;
    double reachable;  ///< no point of it is deeper
  };

  Part wholeOf(const OverlapFacet& facet, const Part* before);
  void halve(const OverlapFacet& facet, const Part& part);
  void integrate(const OverlapFacet& facet, const Part& whole, double allowed,
                 std::vector<OverlapSample>& samples);
  void findPlanes(const OverlapFacet& facet, const Part& part);
  double worstHeight(const OverlapFacet& facet, const Part& part);
  void addBelowPlanes(const OverlapFacet& facet, const Part& part, std::vector<OverlapSample>& samples);
  void addQuadratic(const OverlapFacet& facet, const Part& part, std::vector<OverlapSample>& samples) const;
  bool mayBeDeeper(const OverlapFacet& facet, const Part& part) const;
  static Candidate candidateOf(const OverlapFacet& facet, std::uint32_t index, const ProbedPoint& at);
  void lookAtCorners(const OverlapFacet* first);
  DeepestPoint findDeepest(const OverlapFacet* first);

  DepthProbe probe_;
  DepthSearch search_;
  std::vector<Part> parts_;
  std::vector<Part> wholes_;
  std::vector<std::uint32_t> large_;  ///< facets of wholes_
  std::vector<Candidate> candidates_;
  DepthPlanes planes_;
};

}  // namespace concave_distance
