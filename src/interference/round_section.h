#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "distance/kernels/round_kernels.h"
#include "gauss_points.h"
#include "round_outline.h"

namespace concave_distance::detail {

class RoundVolume;

/// A point of a surface inside a round solid, in the solid's frame.
struct RoundSample {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;  ///< unit, of the surface
  Eigen::Vector3d out;     ///< the shortest way out of the solid, unit
  double area;             ///< m^2 that it stands for
  double depth;            ///< metres below the solid's surface
};

/// Integrates over the part of a triangle that is inside a round solid. That part is convex, and the depth is
/// concave: polar coordinates about its deepest point, with Gauss points between the corners, the crossings
/// of the edges and the places where the solid's surface changes from one piece to another: 3 by 3 where the
/// depth is as good as quadratic, as in shallow contact, else more. Small triangles wholly inside take 3
/// or 6.
class RoundSection {
 public:
  /// Appends the samples, to `fan` triangles that cover the part: corners on the border, chords of it, and
  /// the part itself to `volume`.
  /// @param lowest of the triangle (lowestOnTriangle), inside
  /// @param sparse a triangle wholly inside has one sample: it is one of very many
  void integrate(const RoundShape& shape, const TrianglePoints& triangle, const LowestPoint& lowest,
                 bool sparse, std::vector<RoundSample>& samples, std::vector<TrianglePoints>& fan,
                 RoundVolume& volume);

 private:
  void moveCentre();
  void addInside(bool sparse);
  void addStraight(const RoundOutline::Straight& piece);
  bool bendsLittle(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  void addArc(const RoundOutline::Arc& arc);
  void addCircleArc(const RoundOutline::Arc& arc);
  void addArcPart(const GaussRule& rule, const Eigen::Vector3d& start, const Eigen::Vector3d& end);
  bool isNearlyStraight(const Eigen::Vector3d& start, const Eigen::Vector3d& end) const;
  void addToFan(const Eigen::Vector3d& start, std::size_t count, const Eigen::Vector3d& end);
  void addRay(const Eigen::Vector3d& end, double weight);
  void add(const Eigen::Vector3d& point, double area);
  const RoundShape* shape_ = nullptr;
  TrianglePoints triangle_;
  Eigen::Vector3d centre_;
  double core_ = 0.0;  ///< distance of the centre from the core, metres
  Eigen::Vector3d normal_;
  std::vector<RoundSample>* samples_ = nullptr;
  std::vector<TrianglePoints>* fan_ = nullptr;
  RoundVolume* volume_ = nullptr;
  RoundOutline outline_;
  std::array<Eigen::Vector3d, kGaussFive.size()> arc_points_;
};

}  // namespace concave_distance::detail
