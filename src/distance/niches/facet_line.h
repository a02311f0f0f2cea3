#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "distance/kernels/facet_points.h"

namespace concave_distance::detail {

/// A part of a straight line that is next to a facet, as shares of the line's length from its start.
struct LinePart {
  double first = 0.0;
  double last = 0.0;
  bool is_through = false;  ///< the line runs through the facet, and that is clear
};

/// A facet with what it takes to see where lines meet it. The points must live as long.
class FacetPlane {
 public:
  explicit FacetPlane(const FacetPoints& points);

  /// Returns whether a plane of a facet parts both by more than rounding, if that is clear at once.
  static bool areClearlyApart(const FacetPlane& a, const FacetPlane& b, double tolerance);

  /// Returns whether the straight line between two points comes within `tolerance` (m) of the facet, and
  /// which part of it does. Lines that run clearly through the facet or beside it cost about 20 ns, others
  /// are measured by triangleDistance(). The tolerance has to be above the rounding of that.
  bool isMet(const Eigen::Vector3d& start, const Eigen::Vector3d& end, double tolerance,
             LinePart& part) const;

  const FacetPoints& points() const { return points_; }

 private:
  bool isApartFrom(const FacetPoints& other, double tolerance) const;
  bool isMetByMeasure(const Eigen::Vector3d& start, const Eigen::Vector3d& end, double tolerance,
                      LinePart& part) const;
  Eigen::Vector3d edge(std::size_t k) const;

  const FacetPoints& points_;
  Eigen::Vector3d normal_;  ///< unit vector; zero for a facet too thin to have one that counts
};

}  // namespace concave_distance::detail
