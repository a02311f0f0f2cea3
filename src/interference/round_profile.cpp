#include "round_profile.h"

#include <algorithm>
#include <cmath>

#include "mesh/surface/round_geometry.h"

namespace concave_distance::detail {
namespace {

ProfileTail plus(const ProfileTail& l, const ProfileTail& r) {
  return {l.volume + r.volume, l.raised + r.raised, l.cubed + r.cubed, l.area + r.area};
}

ProfileTail times(double factor, const ProfileTail& tail) {
  return {factor * tail.volume, factor * tail.raised, factor * tail.cubed, factor * tail.area};
}

}  // namespace

RoundProfile::RoundProfile(const RoundShape& shape) : shape_(shape) {
  const double h = shape.half_length;
  const bool is_round = !hasFlatEnds(shape);
  wide_height_ = is_round ? h + 0.3 * shape.radius : h;
  const ProfileTail half = times(shape.radius * shape.radius, ofSide(0.0));
  whole_ = {2.0 * half.volume, 0.0, 2.0 * half.cubed, 2.0 * half.area};
}

/// Returns the integrals of a half ball on the end of the side.
ProfileTail RoundProfile::ofEnd(double height, double rho) const {
  const double r = shape_.radius;
  const double y = std::clamp(height - shape_.half_length, 0.0, r);
  const double volume = (r - y) * (2.0 * r + y) / (3.0 * (r + y));
  const double squared = (r - y) * (r + y);
  const double cubed =
      0.375 * r * r * r * r * std::acos(y / r) - 0.125 * y * (5.0 * r * r - 2.0 * y * y) * std::sqrt(squared);
  return {volume, shape_.half_length * volume + 0.25 * squared, rho > 0.0 ? cubed / (rho * rho) : 0.0,
          r / (r + y)};
}

/// Returns the integrals of what is above a height of the side.
ProfileTail RoundProfile::ofSide(double height) const {
  const double r = shape_.radius;
  const double h = shape_.half_length;
  const double length = h - height;
  const ProfileTail side{length, 0.5 * length * (h + height), r * length, length / r};
  return hasFlatEnds(shape_) ? side : plus(side, ofEnd(h, r));
}

ProfileTail RoundProfile::above(double height, double rho) const {
  const double h = shape_.half_length;
  if (height >= h) return hasFlatEnds(shape_) ? ProfileTail{} : ofEnd(height, rho);
  if (height > -h) return ofSide(height);
  const ProfileTail all = times(1.0 / (rho * rho), whole_);
  if (hasFlatEnds(shape_)) return all;
  const ProfileTail end = ofEnd(-height, rho);
  return plus(all, {-end.volume, end.raised, -end.cubed, -end.area});
}

ProfileTail RoundProfile::below(double height, double rho) const {
  const ProfileTail tail = above(-height, rho);
  return {tail.volume, -tail.raised, tail.cubed, tail.area};
}

}  // namespace concave_distance::detail
