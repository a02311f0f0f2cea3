#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/interference/interference.h"
#include "depth_slope.h"
#include "depth_walls.h"
#include "least_of_linear.h"

namespace concave_distance::detail {

/// The greatest depth of a region, where it is attained, and how it changes. A's frame.
struct DeepestPlace {
  double depth = 0.0;                                      ///< metres
  Eigen::Vector3d inside_in_a = Eigen::Vector3d::Zero();   ///< on one body's surface, inside the other
  Eigen::Vector3d surface_in_a = Eigen::Vector3d::Zero();  ///< the closest point of the other's surface
  bool inside_is_of_b = false;
  /// Rate of the depth per metre that B moves along it, at the point inside; no longer than 1.
  Eigen::Vector3d slope_in_a = Eigen::Vector3d::Zero();
  bool is_sure = false;  ///< else a limit was reached: there may be a deeper one
};

/// Finds the deepest point of a region's surfaces by branch and bound to a tolerance. On a part of a facet
/// the depth is bounded by the least of linear functions, one for each wall of the other body that has been
/// met (DepthWalls). Where that least is greatest the depth is measured: it is as deep, or a wall is added,
/// or the part is halved.
class DeepestPlaceSearch {
 public:
  /// @param tolerance metres, what the depth may be below the greatest
  void begin(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b, double tolerance);
  /// @param first, last facets of one region
  DeepestPlace find(const OverlapFacet* first, const OverlapFacet* last, WorkLimit& limit);

 private:
  /// A part of a facet, in the frame of the body that it is inside of.
  struct Part {
    double ceiling;
    std::uint32_t facet;
    std::uint32_t wall_count;
    std::array<Eigen::Vector3d, 3> corners;
    std::array<TriangleIndex, LeastOfLinear::kMost> walls;  ///< of the other body
  };
  struct Deepest {
    double depth = 0.0;
    Eigen::Vector3d inside = Eigen::Vector3d::Zero();  ///< frame of the body that it is inside of
    Eigen::Vector3d surface = Eigen::Vector3d::Zero();
    std::uint32_t facet = 0;
  };

  const BodyMesh& holder(const OverlapFacet& facet) const { return *bodies_[facet.of_b ? 0 : 1]; }
  Eigen::Isometry3d aFromHolder(const OverlapFacet& facet) const {
    return facet.of_b ? Eigen::Isometry3d::Identity() : a_from_b_;
  }
  Part partOf(std::uint32_t facet) const;
  void search(Part& part);
  void halve(const Part& part);
  void keepNearestWalls(Part& part);
  bool isInPiece(std::uint32_t facet, const Eigen::Vector3d& point) const;
  bool isWhollyOutside(const Part& part);
  DeepestPlace placeOf(const Deepest& deepest);

  const BodyMesh* bodies_[2] = {nullptr, nullptr};
  Eigen::Isometry3d a_from_b_ = Eigen::Isometry3d::Identity();
  double tolerance_ = 0.0;
  DepthWalls walls_[2];  ///< of A and of B
  DepthSlope slope_;
  LeastOfLinear ceiling_;
  TriangleIndex last_nearest_[2];
  const OverlapFacet* facets_ = nullptr;
  std::uint32_t facet_count_ = 0;
  Deepest deepest_;
  std::vector<Part> parts_;  ///< a heap
};

}  // namespace concave_distance::detail
