#include "cylinder_pair_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/surface/round_geometry.h"
#include "round_kernels.h"

namespace concave_distance::detail {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kGolden = 0.61803398874989484820;
// The golden section of a disc's width falls below its roundings after these.
constexpr int kMostSections = 80;
// Two features closer to parallel than this have no normal in common that says anything.
constexpr double kParallel = 1e-300;

/// Finds the point with the least signed distance to `solid` on the disc at an end of `owner` (own frame).
class DiscSearch {
 public:
  DiscSearch(const RoundShape& solid, const RoundShape& owner, const Isometry3d& solid_from_owner, double end)
      : solid_(solid),
        radius_(owner.radius),
        centre_(solid_from_owner * Vector3d(0.0, 0.0, end)),
        along_(solid_from_owner.linear().col(0)),
        across_(solid_from_owner.linear().col(1)) {}

  /// No point of the disc is lower.
  double lowerBound() const { return signedDistance(solid_, centre_) - radius_; }

  LowestPoint find() const {
    double low = -radius_;
    double high = radius_;
    double l = high - kGolden * (high - low);
    double r = low + kGolden * (high - low);
    LowestPoint at_l = onChord(l);
    LowestPoint at_r = onChord(r);
    LowestPoint best = lowerOf(lowerOf(onChord(low), onChord(high)), lowerOf(at_l, at_r));
    for (int i = 0; i < kMostSections; ++i) {
      if (at_l.value < at_r.value) {
        high = r;
        r = l;
        at_r = at_l;
        l = high - kGolden * (high - low);
        at_l = onChord(l);
        best = lowerOf(best, at_l);
      } else {
        low = l;
        l = r;
        at_l = at_r;
        r = low + kGolden * (high - low);
        at_r = onChord(r);
        best = lowerOf(best, at_r);
      }
    }
    return best;
  }

 private:
  static LowestPoint lowerOf(const LowestPoint& l, const LowestPoint& r) { return r.value < l.value ? r : l; }

  LowestPoint onChord(double at) const {
    const double half = std::sqrt(std::max(0.0, (radius_ - at) * (radius_ + at)));
    const Vector3d middle = centre_ + at * along_;
    return lowestOnSegment(solid_, middle - half * across_, middle + half * across_);
  }

  const RoundShape& solid_;
  double radius_;
  Vector3d centre_;
  Vector3d along_;
  Vector3d across_;
};

/// All in A's frame.
class CylinderSearch {
 public:
  CylinderSearch(const RoundShape& a, const RoundShape& b, const Isometry3d& a_from_b)
      : a_(a),
        b_(b),
        a_from_b_(a_from_b),
        b_from_a_(a_from_b.inverse(Eigen::Isometry)),
        centre_(a_from_b.translation()),
        axis_(a_from_b.linear().col(2)) {}

  RoundPairDistance find() {
    lookBetweenSides();
    for (const double end : {-1.0, 1.0}) {
      const DiscSearch of_b(a_, b_, a_from_b_, end * b_.half_length);
      if (of_b.lowerBound() < value_) takePointOfB(of_b.find());
      const DiscSearch of_a(b_, a_, b_from_a_, end * a_.half_length);
      if (of_a.lowerBound() < value_) takePointOfA(of_a.find());
    }
    RoundPairDistance result;
    result.overlap = value_ <= 0.0;
    result.point_a = on_a_;
    result.point_b = on_b_;
    if (result.overlap) return result;
    result.distance = value_;
    result.lower_bound = std::min(value_, greatestSeparation());
    return result;
  }

 private:
  void takePointOfB(const LowestPoint& lowest) {
    if (lowest.value >= value_) return;
    value_ = lowest.value;
    on_b_ = lowest.point;
    on_a_ = value_ > 0.0 ? surfacePoint(a_, on_b_) : on_b_;
  }

  void takePointOfA(const LowestPoint& lowest) {
    if (lowest.value >= value_) return;
    value_ = lowest.value;
    on_a_ = a_from_b_ * lowest.point;
    on_b_ = value_ > 0.0 ? Vector3d(a_from_b_ * surfacePoint(b_, lowest.point)) : on_a_;
  }

  /// Tries where the axes are closest, if that is within both.
  void lookBetweenSides() {
    const Vector3d cross(-axis_.y(), axis_.x(), 0.0);
    const double squared = cross.squaredNorm();
    if (!(squared > 0.0)) return;
    const double on_b = -centre_.head<2>().dot(axis_.head<2>()) / squared;
    if (!(std::abs(on_b) <= b_.half_length)) return;
    if (std::abs(centre_.z() + on_b * axis_.z()) > a_.half_length) return;
    const Vector3d away = cross / std::sqrt(squared);
    const double side = centre_.dot(away) >= 0.0 ? 1.0 : -1.0;
    const Vector3d point = centre_ + on_b * axis_ - side * b_.radius * away;
    const double apart = std::abs(centre_.dot(away)) - a_.radius - b_.radius;
    takePointOfB({apart > 0.0 ? signedDistance(a_, point) : apart, point});
  }

  /// Returns how far a plane across a unit direction, from A to B, keeps the solids apart.
  double separation(const Vector3d& direction) const {
    const double along_b = std::abs(direction.dot(axis_));
    const double across_b = direction.cross(axis_).norm();
    return direction.dot(centre_) - b_.half_length * along_b - b_.radius * across_b -
           a_.half_length * std::abs(direction.z()) - a_.radius * direction.head<2>().norm();
  }

  double greatestSeparation() const {
    const Vector3d in_b = b_from_a_ * on_b_;
    const Vector3d out_a(on_a_.x(), on_a_.y(), 0.0);
    const Vector3d out_b = a_from_b_.linear() * Vector3d(in_b.x(), in_b.y(), 0.0);
    const Vector3d up = Vector3d::UnitZ();
    const Vector3d rim_a = up.cross(out_a);
    const Vector3d rim_b = axis_.cross(out_b);
    const std::array<Vector3d, 9> directions{up,
                                             axis_,
                                             up.cross(axis_),
                                             up.cross(rim_b),
                                             axis_.cross(rim_a),
                                             rim_a.cross(rim_b),
                                             Vector3d(on_b_.x(), on_b_.y(), 0.0),
                                             out_b,
                                             on_b_ - on_a_};
    double greatest = 0.0;
    for (const Vector3d& direction : directions) {
      const double length = direction.stableNorm();
      if (!(length > kParallel)) continue;
      const Vector3d unit = direction / length;
      greatest = std::max({greatest, separation(unit), separation(-unit)});
    }
    return greatest;
  }

  const RoundShape& a_;
  const RoundShape& b_;
  const Isometry3d& a_from_b_;
  Isometry3d b_from_a_;
  Vector3d centre_;  ///< of B
  Vector3d axis_;    ///< of B
  double value_ = std::numeric_limits<double>::infinity();
  Vector3d on_a_ = Vector3d::Zero();
  Vector3d on_b_ = Vector3d::Zero();
};

}  // namespace

RoundPairDistance searchCylinders(const RoundShape& a, const RoundShape& b, const Isometry3d& a_from_b) {
  return CylinderSearch(a, b, a_from_b).find();
}

}  // namespace concave_distance::detail
