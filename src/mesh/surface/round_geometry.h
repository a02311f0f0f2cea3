#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "concave_distance/mesh/surface/round_shape.h"

namespace concave_distance::detail {

/// Holds what the rules ask about a kind of round solid: all of them are a cylindrical part between two ends.
struct RoundTraits {
  bool has_side;       ///< the cylindrical part has a length; false: only the ends are left
  bool has_flat_ends;  ///< the ends are discs with rims; false: they are half balls
};

/// The one switch over RoundKind. A new kind does not compile before it is answered here; one that these
/// answers do not describe, such as a cone, is a primitive with a mesh alone (primitive_table.h).
constexpr RoundTraits traitsOf(RoundKind kind) {
  switch (kind) {
    case RoundKind::Sphere:
      return {false, false};
    case RoundKind::Capsule:
      return {true, false};
    case RoundKind::Cylinder:
      return {true, true};
  }
  return {};
}

inline bool hasSide(const RoundShape& shape) {
  return traitsOf(shape.kind).has_side;
}

inline bool hasFlatEnds(const RoundShape& shape) {
  return traitsOf(shape.kind).has_flat_ends;
}

/// Signed distance of a point (shape frame) to the surface, negative inside: a convex function with slope 1.
/// Error: a few machine epsilons of the point's distance from the centre and of the shape's size.
inline double signedDistance(const RoundShape& shape, const Eigen::Vector3d& p) {
  if (!hasSide(shape)) return p.norm() - shape.radius;
  const double beyond = std::abs(p.z()) - shape.half_length;
  if (!hasFlatEnds(shape)) {
    const double end = std::max(0.0, beyond);
    return std::sqrt(p.x() * p.x() + p.y() * p.y() + end * end) - shape.radius;
  }
  const double across = std::sqrt(p.x() * p.x() + p.y() * p.y()) - shape.radius;
  return across > 0.0 && beyond > 0.0 ? std::sqrt(across * across + beyond * beyond)
                                      : std::max(across, beyond);
}

/// The point of the core (centre, or segment of the axis) nearest to `p`.
inline Eigen::Vector3d corePoint(const RoundShape& shape, const Eigen::Vector3d& p) {
  return {0.0, 0.0, std::clamp(p.z(), -shape.half_length, shape.half_length)};
}

/// A subgradient of signedDistance(), of length 1: where several are, one of them.
inline Eigen::Vector3d outwardDirection(const RoundShape& shape, const Eigen::Vector3d& p) {
  if (!hasFlatEnds(shape)) {
    const Eigen::Vector3d out = p - corePoint(shape, p);
    const double length = out.norm();
    return length > 0.0 ? Eigen::Vector3d(out / length) : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  }
  const double rho = std::sqrt(p.x() * p.x() + p.y() * p.y());
  const double across = rho - shape.radius;
  const double beyond = std::abs(p.z()) - shape.half_length;
  double radial = across > beyond ? 1.0 : 0.0;
  double axial = 1.0 - radial;
  if (across > 0.0 && beyond > 0.0) {
    const double length = std::sqrt(across * across + beyond * beyond);
    radial = across / length;
    axial = beyond / length;
  }
  const double share = rho > 0.0 ? radial / rho : 0.0;
  if (!(rho > 0.0) && radial > 0.0) return Eigen::Vector3d::UnitX();
  return {share * p.x(), share * p.y(), std::copysign(axial, p.z())};
}

/// The point of the surface that is nearest to `p`; exact outside and, but on the medial axis, inside.
inline Eigen::Vector3d surfacePoint(const RoundShape& shape, const Eigen::Vector3d& p) {
  return p - signedDistance(shape, p) * outwardDirection(shape, p);
}

/// The solid's point that is farthest along a direction.
inline Eigen::Vector3d supportPoint(const RoundShape& shape, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d end(0.0, 0.0, std::copysign(shape.half_length, direction.z()));
  if (hasFlatEnds(shape)) {
    const double across = std::sqrt(direction.x() * direction.x() + direction.y() * direction.y());
    if (!(across > 0.0)) return end;
    return end +
           Eigen::Vector3d(shape.radius / across * direction.x(), shape.radius / across * direction.y(), 0.0);
  }
  const double length = direction.norm();
  return length > 0.0 ? Eigen::Vector3d(end + shape.radius / length * direction) : end;
}

/// Returns the greatest distance of the solid's points from its centre, metres.
inline double reachOf(const RoundShape& shape) {
  return hasFlatEnds(shape) ? std::hypot(shape.radius, shape.half_length) : shape.radius + shape.half_length;
}

/// Returns the area of the solid's surface, m^2.
inline double surfaceAreaOf(const RoundShape& shape) {
  const double ends = hasFlatEnds(shape) ? shape.radius : 2.0 * shape.radius;
  return 2.0 * kPi * shape.radius * (ends + 2.0 * shape.half_length);
}

/// Returns the greatest distance of the solid's points from `p` (shape frame), metres.
inline double farthestDistance(const RoundShape& shape, const Eigen::Vector3d& p) {
  const double rho = std::hypot(p.x(), p.y());
  const double far = std::abs(p.z()) + shape.half_length;
  return hasFlatEnds(shape) ? std::hypot(rho + shape.radius, far) : std::hypot(rho, far) + shape.radius;
}

}  // namespace concave_distance::detail
