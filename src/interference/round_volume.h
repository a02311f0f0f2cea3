#pragma once

#include <Eigen/Core>
#include <vector>

#include "round_outline.h"
#include "round_profile.h"

namespace concave_distance::detail {

/// Volume, centroid and area of the part of a round solid inside a mesh, from the mesh's surface inside the
/// solid alone, by Stokes' theorem twice. With the solid's radius f(z), the volume is the integral of
/// rho^2 / 2 dtheta dz over the mesh's part, and on the solid's surface, where that is f^2 / 2 dtheta dz, the
/// integral of G dtheta / 2 along the curves where the surfaces cross, dG = f^2 dz. Neither is singular
/// anywhere near the axis: the curves lie on the solid's surface, and near either pole G is counted from
/// there. What that leaves out is a whole number of times the solid's volume, and the volume lies between 0
/// and one. So nothing is asked of where the axis or the centre is. The moments are found in the same way.
/// Errors are roundings of the solid's volume: a region must not be much smaller (isSmall()).
class RoundVolume {
 public:
  void begin(const RoundShape& shape);
  /// A triangle inside the solid, counterclockwise as seen from outside the mesh. Shape's frame.
  void addTriangle(const TrianglePoints& triangle);
  /// The sector between the outline's centre and an arc of it.
  void addSector(const RoundOutline& outline, const RoundOutline::Arc& arc);
  void finish();

  /// Share of the solid's volume, between 0 and 1.
  double share() const { return volume_ / whole_volume_; }
  double volume() const { return volume_; }
  const Eigen::Vector3d& moment() const { return moment_; }
  double area() const { return area_; }  ///< of the solid's surface inside the mesh

 private:
  /// Integrals along a part of a curve. The height is counted from one of the solid's ends.
  struct AlongCurve {
    double volume = 0.0;
    double area = 0.0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  };
  struct CurvePart {
    double start_height;
    Eigen::Vector3d end;
    AlongCurve from_top;
    AlongCurve from_bottom;
  };

  void addFlux(const Eigen::Vector3d& point, const Eigen::Vector3d& area);
  void addChord(const RoundOutline& outline, const Eigen::Vector3d& start, const Eigen::Vector3d& end,
                int halvings);
  void addPart(const RoundShape& shape, const Eigen::Vector3d& start, const Eigen::Vector3d& along,
               const Eigen::Vector3d& across);
  double chooseHeight();
  void addCurves(double height);
  void chooseWhole();

  RoundProfile profile_;
  std::vector<CurvePart> curves_;
  std::vector<double> heights_;
  double whole_volume_ = 1.0;
  double volume_ = 0.0;
  double area_ = 0.0;
  double flux_along_ = 0.0;  ///< of z along the axis
  Eigen::Vector3d moment_ = Eigen::Vector3d::Zero();
};

}  // namespace concave_distance::detail
