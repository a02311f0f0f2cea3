#pragma once

#include <Eigen/Core>

#include "concave_distance/mesh/surface/round_shape.h"
#include "round_section.h"

namespace concave_distance::detail {

/// RoundVolume where a region is so small that the solid's volume rounds it away and its surface stays far
/// from the core: flux through the mesh's surface inside the solid of fields of divergence 1 (and x, y, z for
/// the centroid) that vanish at the solid's surface. Of a ball F = x / 3 (1 - r^3 / |x|^3), of a cylinder the
/// same across the axis, or along it where only one cap is concerned; of a capsule that of a ball beyond the
/// centres of its ends and of a cylinder between. What they have at the core, where they are singular, is
/// added where the core is inside.
class ShallowRoundVolume {
 public:
  /// @param side of a cylinder: 1 or -1 where all of the surface is beyond the middle on that side; else 0
  ShallowRoundVolume(const RoundShape& shape, int side) : shape_(shape), side_(side) {}

  void add(const RoundSample& sample);
  /// A part of the axis, between two heights, that lies in the region; for a ball any part with its centre.
  void addCore(double from, double to);

  double volume() const { return ends_ + middle_; }
  Eigen::Vector3d moment() const { return moment_; }
  /// Returns the area of the solid's surface inside the mesh, m^2.
  double area() const;

 private:
  void addBall(const RoundSample& sample, const Eigen::Vector3d& centre);
  void addAcross(const RoundSample& sample);
  void addAlong(const RoundSample& sample);

  const RoundShape& shape_;
  int side_;
  double ends_ = 0.0;    ///< of a ball's parts
  double middle_ = 0.0;  ///< of a cylinder
  Eigen::Vector3d moment_ = Eigen::Vector3d::Zero();
  double flux_outward_ = 0.0;  ///< of the vector from the core, or across the axis, over the radius
  double flux_along_ = 0.0;    ///< of z over the half length
};

}  // namespace concave_distance::detail
