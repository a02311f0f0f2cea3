#include "concave_distance/scene/broad_phase.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/surface/round_geometry.h"

namespace concave_distance {
namespace {

constexpr double kUnitRoundoff = 0.5 * std::numeric_limits<double>::epsilon();
// Every projection below is a sum of at most 20 products of two or three factors; each factor is computed
// with at most 8 roundings. 64 roundings of the sum of absolute terms (`scale`) cover it twice over.
constexpr double kRoundings = 64.0;
// Cross products of axes shorter than this lie along axes that are tried anyway, and would blow the slack up.
constexpr double kShortestCross = 1e-3;

double roundedUp(double x) {
  return std::nextafter(x, std::numeric_limits<double>::infinity());
}

// Length of the vector of the positive gaps: the distance of two boxes with common axes.
double lengthOfGaps(const Eigen::Vector3d& gaps) {
  return gaps.cwiseMax(0.0).norm();
}

BodyBounds boundsOf(const Eigen::AlignedBox3d& box) {
  BodyBounds bounds;
  bounds.centre = box.center();
  for (int i = 0; i < 3; ++i) {
    bounds.half_extents[i] =
        roundedUp(std::max(box.max()[i] - bounds.centre[i], bounds.centre[i] - box.min()[i]));
  }
  return bounds;
}

}  // namespace

BodyBounds boundsOf(const SurfaceMesh& surface) {
  BodyBounds bounds = boundsOf(surface.boundingBox());
  double squared_radius = 0.0;
  for (const Eigen::Vector3d& vertex : surface.vertices()) {
    squared_radius = std::max(squared_radius, (vertex - bounds.centre).squaredNorm());
  }
  bounds.radius = roundedUp(std::sqrt(squared_radius) * (1.0 + 8.0 * kUnitRoundoff));
  return bounds;
}

BodyBounds boundsOf(const BodyMesh& body) {
  if (body.shape() == nullptr) return boundsOf(body.surface());
  BodyBounds bounds = boundsOf(body.bounds());
  const double off = (bounds.centre - body.shape()->body_from_shape.translation()).norm();
  bounds.radius = roundedUp((detail::reachOf(*body.shape()) + off) * (1.0 + 8.0 * kUnitRoundoff));
  return bounds;
}

double distanceLowerBound(const BodyBounds& a, const BodyBounds& b, const Eigen::Isometry3d& a_from_b,
                          double margin) {
  const Eigen::Matrix3d m = a_from_b.linear();
  const Eigen::Matrix3d absolute_m = m.cwiseAbs();
  const Eigen::Vector3d t = a_from_b.translation();
  const Eigen::Vector3d centres = t + m * b.centre - a.centre;
  // |M^T v| <= stretch |v| (the greatest singular value is at most the root of M^T M's greatest row sum): 1
  // up to rounding for a rotation.
  const Eigen::Matrix3d gram = m.transpose() * m;
  const Eigen::Matrix3d absolute_gram = gram.cwiseAbs();
  const double stretch =
      std::max(1.0, std::sqrt(absolute_gram.rowwise().sum().maxCoeff()) * (1.0 + 8.0 * kUnitRoundoff));
  const double scale =
      stretch * (t.lpNorm<1>() + (absolute_m * b.centre.cwiseAbs()).sum() + a.centre.lpNorm<1>() +
                 a.half_extents.sum() + (absolute_m * b.half_extents).sum() + a.radius + stretch * b.radius);
  const double slack = kRoundings * kUnitRoundoff * scale;

  double bound = centres.norm() - a.radius - stretch * b.radius - slack;
  const Eigen::Vector3d on_axes_of_a = centres.cwiseAbs() - a.half_extents - absolute_m * b.half_extents;
  bound = std::max(bound, lengthOfGaps((on_axes_of_a.array() - slack).matrix()));
  const Eigen::Vector3d on_axes_of_b = (m.transpose() * centres).cwiseAbs() -
                                       absolute_m.transpose() * a.half_extents -
                                       absolute_gram * b.half_extents;
  bound = std::max(bound, lengthOfGaps((on_axes_of_b.array() - slack).matrix()) / stretch);

  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i).cross(m.col(j));
      const double length = axis.norm();
      if (!(length > kShortestCross)) continue;
      const double gap = std::abs(axis.dot(centres)) - axis.cwiseAbs().dot(a.half_extents) -
                         (axis.transpose() * m).cwiseAbs().dot(b.half_extents);
      bound = std::max(bound, (gap - slack) / length);
    }
  }
  bound *= 1.0 - 8.0 * kUnitRoundoff;
  if (margin > 0.0) bound = std::nextafter(bound - margin, -std::numeric_limits<double>::infinity());
  // NaN compares false: a pose that is not finite proves nothing.
  return bound > 0.0 && std::isfinite(scale) ? bound : 0.0;
}

}  // namespace concave_distance
