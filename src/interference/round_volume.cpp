#include "round_volume.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/constants.h"
#include "gauss_points.h"
#include "mesh/surface/round_geometry.h"
#include "round_lines.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

constexpr double kWidestSector = kPi / 3.0;
// An arc is halved until its heights over its chord at the quarters are those of a parabola but for this
// share of that in the middle: as of an arc of 32 degrees of a circle, however that is stretched. Five points
// then leave some 1e-10 of it.
constexpr double kParabola = 0.005;
// Nor where it is no farther from its chord than this share of the solid.
constexpr double kFlat = 1e-10;
constexpr int kMostHalvings = 16;
// Gauss points on [0, 1], exact for cubic functions.
constexpr std::array<double, 2> kBetween{{0.2113248654051871177, 0.7886751345948128823}};

double heightOver(const RoundShape& shape, const Vector3d& on_chord, const Vector3d& across) {
  return wayOut(shape, on_chord, across, reachOf(shape));
}

bool isParabola(const RoundShape& shape, const Vector3d& start, const Vector3d& along,
                const Vector3d& across) {
  const double middle = heightOver(shape, start + 0.5 * along, across);
  if (middle <= kFlat * reachOf(shape)) return true;
  return std::abs(heightOver(shape, start + 0.25 * along, across) - 0.75 * middle) <= kParabola * middle &&
         std::abs(heightOver(shape, start + 0.75 * along, across) - 0.75 * middle) <= kParabola * middle;
}

}  // namespace

void RoundVolume::begin(const RoundShape& shape) {
  profile_ = RoundProfile(shape);
  curves_.clear();
  whole_volume_ = kPi * profile_.whole().volume;
  volume_ = area_ = flux_along_ = 0.0;
  moment_.setZero();
}

/// Adds the flux of rho^2 / 2 dtheta dz, the same times z, and rho^3 / 3 dtheta dz times cosine and sine.
void RoundVolume::addFlux(const Vector3d& point, const Vector3d& area) {
  const double across = point.head<2>().dot(area.head<2>());
  volume_ += 0.5 * across;
  moment_.head<2>() += across / 3.0 * point.head<2>();
  moment_.z() += 0.5 * across * point.z();
  flux_along_ += point.z() * area.z();
}

void RoundVolume::addTriangle(const TrianglePoints& triangle) {
  const Vector3d third = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]) / 6.0;
  for (std::size_t k = 0; k < 3; ++k) addFlux(0.5 * (triangle[k] + triangle[(k + 1) % 3]), third);
}

void RoundVolume::addSector(const RoundOutline& outline, const RoundOutline::Arc& arc) {
  const double width = arc.to - arc.from;
  const auto parts = std::max(1, static_cast<int>(std::ceil(width / kWidestSector - 1e-9)));
  Vector3d start = arc.start;
  for (int part = 1; part <= parts; ++part) {
    const Vector3d end = part == parts ? arc.end : outline.border(arc.from + part * width / parts);
    addChord(outline, start, end, 0);
    start = end;
  }
}

void RoundVolume::addChord(const RoundOutline& outline, const Vector3d& start, const Vector3d& end,
                           int halvings) {
  const Vector3d along = end - start;
  const double length = along.norm();
  if (!(length > 0.0)) return;
  const Vector3d across = along.cross(outline.normal()) / length;
  if (halvings < kMostHalvings && !isParabola(outline.shape(), start, along, across)) {
    const Vector3d middle = start + 0.5 * along;
    const Vector3d at = middle + heightOver(outline.shape(), middle, across) * across;
    addChord(outline, start, at, halvings + 1);
    return addChord(outline, at, end, halvings + 1);
  }
  addTriangle({outline.centre(), start, end});
  addPart(outline.shape(), start, along, across);
}

/// Adds what lies between an arc and its chord, and the integrals along the arc, a height over the chord.
void RoundVolume::addPart(const RoundShape& shape, const Vector3d& start, const Vector3d& along,
                          const Vector3d& across) {
  CurvePart part{start.z(), start + along, {}, {}};
  const auto add = [](AlongCurve& sum, double share, const ProfileTail& tail, const Vector3d& direction) {
    sum.volume += 0.5 * share * tail.volume;
    sum.area += share * tail.area;
    sum.moment.head<2>() += share / 3.0 * tail.cubed * direction.head<2>();
    sum.moment.z() += 0.5 * share * tail.raised;
  };
  const Vector3d area = across.cross(along);
  for (const GaussPoint& at : kGaussFive) {
    const Vector3d on_chord = start + at.at * along;
    const double beyond = heightOver(shape, on_chord, across);
    for (const double ray : kBetween)
      addFlux(on_chord + ray * beyond * across, 0.5 * at.weight * beyond * area);
    const Vector3d point = on_chord + beyond * across;
    const Vector3d out = outwardDirection(shape, point);
    const double rise = out.dot(across);
    const Vector3d step = rise > 0.0 ? Vector3d(along - out.dot(along) / rise * across) : along;
    const double share = at.weight * (point.x() * step.y() - point.y() * step.x());
    const double rho = std::hypot(point.x(), point.y());
    const Vector3d direction = rho > 0.0 ? Vector3d(point / rho) : Vector3d(Vector3d::UnitX());
    add(part.from_top, -share, profile_.above(point.z(), rho), direction);
    add(part.from_bottom, share, profile_.below(point.z(), rho), direction);
  }
  curves_.push_back(part);
}

/// Where curves pass from being counted from one end of the solid to the other: away from every point where
/// two parts of a curve meet, which two triangles may have on different sides.
double RoundVolume::chooseHeight() {
  const double most = profile_.wideHeight();
  heights_.clear();
  for (const CurvePart& part : curves_) {
    for (const double height : {part.start_height, part.end.z()})
      heights_.push_back(std::clamp(height, -most, most));
  }
  heights_.push_back(-most);
  heights_.push_back(most);
  std::sort(heights_.begin(), heights_.end());
  double height = 0.0;
  double widest = -1.0;
  for (std::size_t i = 0; i + 1 < heights_.size(); ++i) {
    const double gap = heights_[i + 1] - heights_[i];
    if (gap <= widest) continue;
    widest = gap;
    height = heights_[i] + 0.5 * gap;
  }
  return height;
}

/// A part of a curve is counted from the end that it starts at; where the next is counted from the other
/// end, the angle there counts with the solid's whole integral.
void RoundVolume::addCurves(double height) {
  const ProfileTail& whole = profile_.whole();
  for (const CurvePart& part : curves_) {
    const bool starts_above = part.start_height > height;
    const AlongCurve& along = starts_above ? part.from_top : part.from_bottom;
    volume_ += along.volume;
    area_ += along.area;
    moment_ += along.moment;
    if (starts_above == (part.end.z() > height)) continue;
    const double sign = starts_above ? 1.0 : -1.0;
    const double rho = std::hypot(part.end.x(), part.end.y());
    const double angle = sign * std::atan2(part.end.y(), part.end.x());
    volume_ += 0.5 * whole.volume * angle;
    area_ += whole.area * angle;
    moment_.x() += sign * whole.cubed / 3.0 * part.end.y() / rho;
    moment_.y() -= sign * whole.cubed / 3.0 * part.end.x() / rho;
  }
}

void RoundVolume::chooseWhole() {
  const double times = std::floor(volume_ / whole_volume_);
  volume_ -= times * whole_volume_;
  area_ -= times * 2.0 * kPi * profile_.whole().area;
  if (hasFlatEnds(profile_.shape())) area_ += (volume_ - flux_along_) / profile_.shape().half_length;
  area_ = std::max(0.0, area_);
}

void RoundVolume::finish() {
  addCurves(chooseHeight());
  chooseWhole();
}

}  // namespace concave_distance::detail
