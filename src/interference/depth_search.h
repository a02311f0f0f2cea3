#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "depth_planes.h"
#include "depth_probe.h"

namespace concave_distance {

/// Branch and bound for the deepest point of a region. No point of a part of a facet is deeper than the
/// farthest of its corners is from one triangle of the other body, or from a point outside that body. Parts
/// are cut where the planes of the nearest triangles meet, and halved. Not proven: a part whose corners and
/// middle are as deep as below one plane is taken to be so all over, as flat faces of many triangles are.
class DepthSearch {
 public:
  void begin() { parts_.clear(); }
  /// A facet that has been looked at in one point.
  void add(const OverlapFacet* first, std::uint32_t facet, TriangleIndex nearest, const DepthProbe& probe);
  /// One that has been looked at in its corners.
  void add(const OverlapFacet* first, std::uint32_t facet, const std::array<ProbedPoint, 3>& corners,
           const DepthProbe& probe);
  /// Goes on until no part can hold a depth greater by more than `share` than the deepest one that is known,
  /// or until there were `largest_count` parts. @param first facet of the region
  void run(const OverlapFacet* first, double share, std::size_t largest_count, DepthProbe& probe);

 private:
  struct Corner {
    Eigen::Vector3d point;
    Eigen::Vector3d foot;  ///< closest on the other surface, its frame
    double depth;
    TriangleIndex nearest;
    bool is_outside;
  };
  struct Part {
    double bound = std::numeric_limits<double>::infinity();  ///< metres: no point of it is deeper
    std::uint32_t facet = 0;
    bool corners_are_known = false;  ///< have been looked at
    bool is_piece = false;           ///< has been cut, and not yet halved since
    std::array<Corner, 3> corners;
  };
  static bool isLess(const Part& l, const Part& r);
  void push(const Part& part);
  static Corner cornerOf(const OverlapFacet& facet, const ProbedPoint& at, const DepthProbe& probe);
  static void tighten(const OverlapFacet& facet, const DepthProbe& probe, Part& part);
  void split(const OverlapFacet& facet, Part part, double share, DepthProbe& probe);
  bool areExplained(const Part& part, const ProbedPoint& middle, double deepest) const;
  /// False where one plane is the lowest all over the part.
  bool cut(const OverlapFacet& facet, const Part& part, double enough, const DepthProbe& probe);
  void addPiece(const OverlapFacet& facet, const Part& part, const std::array<Eigen::Vector3d, 3>& corners,
                TriangleIndex nearest, double enough, const DepthProbe& probe);
  void halve(const OverlapFacet& facet, const Part& part, double share, DepthProbe& probe);

  std::vector<Part> parts_;  ///< a heap
  DepthPlanes planes_;
};

}  // namespace concave_distance
