#include "round_pair_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cylinder_pair_search.h"
#include "mesh/surface/round_geometry.h"
#include "round_kernels.h"

namespace concave_distance {
namespace {

using Eigen::Vector3d;

constexpr int kMostSupports = 200;
// Distance and bound this close are both right, with room for the roundings of either.
constexpr double kEnough = 0.5 * kRoundDistanceError;

Vector3d unitOr(const Vector3d& vector, const Vector3d& other) {
  const double length = vector.norm();
  return length > 0.0 ? Vector3d(vector / length) : other;
}

/// `rounded` is a sphere or a capsule: its core against the other solid, less its radius.
RoundPairDistance fromCore(const RoundShape& solid, const RoundShape& rounded,
                           const Eigen::Isometry3d& solid_from_rounded) {
  const Vector3d axis = rounded.half_length * solid_from_rounded.linear().col(2);
  const Vector3d centre = solid_from_rounded.translation();
  const LowestPoint core = lowestOnSegment(solid, centre - axis, centre + axis);
  RoundPairDistance result;
  const Vector3d out = detail::outwardDirection(solid, core.point);
  result.point_a = core.point - core.value * out;
  result.point_b = core.point - rounded.radius * out;
  result.overlap = core.value <= rounded.radius;
  result.distance = std::max(0.0, core.value - rounded.radius);
  result.lower_bound = result.distance;
  return result;
}

/// Corners of the difference A - B with the points that they come from.
struct Corner {
  Vector3d difference;
  Vector3d on_a;
  Vector3d on_b;
};

class Simplex {
 public:
  void add(const Corner& corner) { corners_[count_++] = corner; }
  std::size_t count() const { return count_; }
  bool holds(const Vector3d& difference) const {
    return std::any_of(corners_.begin(), corners_.begin() + static_cast<std::ptrdiff_t>(count_),
                       [&](const Corner& c) { return c.difference == difference; });
  }

  /// Keeps the part nearest to the origin. False when the origin is inside, by more than `least` from each
  /// face.
  bool reduce(double least) {
    if (count_ < 4) {
      keep(nearestOf({0, std::min<std::size_t>(1, count_ - 1), count_ - 1}));
      return true;
    }
    if (holdsOrigin(least)) return false;
    constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
    Part best = nearestOf(kFaces[0]);
    for (std::size_t f = 1; f < kFaces.size(); ++f) {
      const Part part = nearestOf(kFaces[f]);
      if (part.nearest.squared_distance < best.nearest.squared_distance) best = part;
    }
    keep(best);
    return true;
  }
  const Vector3d& nearest() const { return nearest_; }
  /// The points of the bodies that nearest() is the difference of.
  void points(Vector3d& on_a, Vector3d& on_b) const {
    on_a = on_b = Vector3d::Zero();
    for (std::size_t k = 0; k < count_; ++k) {
      on_a += weights_[k] * corners_[k].on_a;
      on_b += weights_[k] * corners_[k].on_b;
    }
  }

 private:
  struct Part {
    std::array<std::size_t, 3> corners;
    PointTriangleDistance nearest;
  };
  Part nearestOf(const std::array<std::size_t, 3>& c) const {
    return {c, pointTriangleDistance(Vector3d::Zero(), {corners_[c[0]].difference, corners_[c[1]].difference,
                                                        corners_[c[2]].difference})};
  }

  bool holdsOrigin(double least) const {
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3d& a = corners_[(k + 1) % 4].difference;
      const Vector3d normal =
          (corners_[(k + 2) % 4].difference - a).cross(corners_[(k + 3) % 4].difference - a);
      const double apex = normal.dot(corners_[k].difference - a);
      const double inside = std::copysign(1.0, apex) * normal.dot(-a);
      if (!(std::min(inside, std::abs(apex)) > least * normal.norm())) return false;
    }
    return true;
  }

  void keep(const Part& part) {
    const std::array<Corner, 3> c{corners_[part.corners[0]], corners_[part.corners[1]],
                                  corners_[part.corners[2]]};
    nearest_ = part.nearest.point;
    const auto feature = static_cast<std::size_t>(part.nearest.feature);
    if (feature < 3) {
      count_ = 1;
      corners_[0] = c[feature];
      weights_[0] = 1.0;
    } else if (feature < 6) {
      keepEdge(c[feature - 3], c[(feature - 2) % 3]);
    } else {
      keepFace(c);
    }
  }
  void keepEdge(const Corner& from, const Corner& to) {
    const Vector3d d = to.difference - from.difference;
    const double share = std::clamp((nearest_ - from.difference).dot(d) / d.squaredNorm(), 0.0, 1.0);
    count_ = 2;
    corners_[0] = from;
    corners_[1] = to;
    weights_[0] = 1.0 - share;
    weights_[1] = share;
  }
  void keepFace(const std::array<Corner, 3>& c) {
    const Vector3d normal = (c[1].difference - c[0].difference).cross(c[2].difference - c[0].difference);
    count_ = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      corners_[k] = c[k];
      const Vector3d& next = c[(k + 1) % 3].difference;
      weights_[k] =
          (c[(k + 2) % 3].difference - next).cross(nearest_ - next).dot(normal) / normal.squaredNorm();
    }
  }

  std::array<Corner, 4> corners_;
  std::array<double, 4> weights_{};
  std::size_t count_ = 0;
  Vector3d nearest_ = Vector3d::Zero();
};

/// The points of the difference nearest to the origin. Nothing where rounding hides whether they are: where
/// faces or sides are nearly parallel a simplex of points on rims is as good as flat.
std::optional<RoundPairDistance> bySupports(const RoundShape& a, const RoundShape& b,
                                            const Eigen::Isometry3d& a_from_b, double allowed) {
  const auto support = [&](const Vector3d& direction) {
    Corner corner;
    corner.on_a = detail::supportPoint(a, -direction);
    corner.on_b = a_from_b * detail::supportPoint(b, a_from_b.linear().transpose() * direction);
    corner.difference = corner.on_a - corner.on_b;
    return corner;
  };
  RoundPairDistance result;
  Simplex simplex;
  simplex.add(support(-unitOr(a_from_b.translation(), Vector3d::UnitX())));
  simplex.reduce(allowed);
  for (int i = 0; i < kMostSupports; ++i) {
    const double distance = simplex.nearest().norm();
    if (distance <= allowed) return std::nullopt;
    const Vector3d direction = simplex.nearest() / distance;
    const Corner corner = support(direction);
    result.lower_bound = std::max(result.lower_bound, direction.dot(corner.difference));
    if (distance - result.lower_bound <= allowed || simplex.holds(corner.difference)) break;
    simplex.add(corner);
    if (!simplex.reduce(allowed)) {
      result.overlap = true;
      result.lower_bound = 0.0;
      simplex.points(result.point_a, result.point_b);
      return result;
    }
  }
  simplex.points(result.point_a, result.point_b);
  // The corners' shares lose digits in a flat simplex: back onto the surfaces, which brings them no farther.
  result.point_a = detail::surfacePoint(a, result.point_b);
  result.point_b = a_from_b * detail::surfacePoint(b, a_from_b.inverse(Eigen::Isometry) * result.point_a);
  result.distance = (result.point_b - result.point_a).norm();
  if (!(result.distance - result.lower_bound <= allowed)) return std::nullopt;
  return result;
}

RoundPairDistance ofCylinders(const RoundShape& a, const RoundShape& b, const Eigen::Isometry3d& a_from_b) {
  const double scale = a_from_b.translation().norm() + detail::reachOf(a) + detail::reachOf(b);
  const std::optional<RoundPairDistance> found = bySupports(a, b, a_from_b, kEnough * scale);
  return found ? *found : detail::searchCylinders(a, b, a_from_b);
}

}  // namespace

RoundPairDistance roundPairDistance(const RoundShape& a, const RoundShape& b,
                                    const Eigen::Isometry3d& a_from_b) {
  if (!detail::hasFlatEnds(b)) return fromCore(a, b, a_from_b);
  if (detail::hasFlatEnds(a)) return ofCylinders(a, b, a_from_b);
  const RoundPairDistance mirrored = fromCore(b, a, a_from_b.inverse(Eigen::Isometry));
  RoundPairDistance result = mirrored;
  result.point_a = a_from_b * mirrored.point_b;
  result.point_b = a_from_b * mirrored.point_a;
  return result;
}

}  // namespace concave_distance
