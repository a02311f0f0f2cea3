#include "round_pair_overlap.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/constants.h"
#include "distance/kernels/round_kernels.h"
#include "gauss_points.h"
#include "mesh/surface/round_geometry.h"
#include "round_lines.h"

namespace concave_distance::detail {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// A core may lie along the other surface: the patch's middle is that of what is within this share
// of the depth.
constexpr double kPlateau = 0.1;
constexpr int kMostSteps = 60;
constexpr int kRimPoints = 16;

/// All in the frame of `solid`, whose depth is integrated over the surface of `own`.
class PairOverlap {
 public:
  PairOverlap(const RoundShape& own, const RoundShape& solid, const Isometry3d& solid_from_own)
      : own_(own),
        solid_(solid),
        solid_from_own_(solid_from_own),
        own_from_solid_(solid_from_own.inverse(Eigen::Isometry)) {}

  /// The deepest point of `own`. False where the solids are apart or one holds the other's core.
  bool locate();
  /// False where the patch reaches round.
  bool integrate(std::vector<OverlapSample>& samples, bool solid_is_a, const Isometry3d& a_from_solid);
  void report(bool solid_is_a, const Isometry3d& a_from_solid, InterferenceRegion& region) const;
  double depth() const { return depth_; }

 private:
  struct Front {
    bool is_there = false;
    Vector3d point;
    double value = 0.0;  ///< signed distance to `solid`
  };
  Vector3d core(double share) const {
    return solid_from_own_ * Vector3d(0.0, 0.0, (2.0 * share - 1.0) * own_.half_length);
  }
  bool holdsSolid() const;
  double coreValue(double share) const { return signedDistance(solid_, core(share)); }
  double plateauEnd(double from, double to, double level) const;
  Front frontAt(const Vector3d& in_plane) const;
  std::optional<double> border(const Vector3d& direction) const;
  void add(const Vector3d& in_plane, double area, std::vector<OverlapSample>& samples, bool solid_is_a,
           const Isometry3d& a_from_solid);

  const RoundShape& own_;
  const RoundShape& solid_;
  Isometry3d solid_from_own_;
  Isometry3d own_from_solid_;
  double depth_ = 0.0;
  Vector3d lowest_;  ///< of `own`
  Vector3d middle_;  ///< of the patch, on `own`
  Vector3d out_;     ///< of `own` there
  Vector3d axis_u_;
  Vector3d axis_v_;
  double own_area_ = 0.0;
  double solid_area_ = 0.0;
  double volume_ = 0.0;
  double along_ = 0.0;
  double reach_ = 0.0;
  Vector3d vector_area_ = Vector3d::Zero();
  Vector3d moment_ = Vector3d::Zero();
};

double PairOverlap::plateauEnd(double from, double to, double level) const {
  if (coreValue(to) <= level) return to;
  for (int i = 0; i < kMostSteps; ++i) {
    const double middle = 0.5 * (from + to);
    (coreValue(middle) <= level ? from : to) = middle;
  }
  return from;
}

/// Looks at the solid's points that are farthest out: its ends, of a cylinder points all around them.
bool PairOverlap::holdsSolid() const {
  const bool is_round = !hasFlatEnds(solid_);
  for (const double end : {-solid_.half_length, solid_.half_length}) {
    for (int i = 0; i < (is_round ? 1 : kRimPoints); ++i) {
      const double angle = 2.0 * kPi * i / kRimPoints;
      const double rim = is_round ? 0.0 : solid_.radius;
      const Vector3d point(rim * std::cos(angle), rim * std::sin(angle), end);
      const double more = is_round ? solid_.radius : 0.0;
      if (signedDistance(own_, own_from_solid_ * point) + more > 0.0) return false;
    }
  }
  return true;
}

bool PairOverlap::locate() {
  const LowestPoint lowest = lowestOnSegment(solid_, core(0.0), core(1.0));
  depth_ = own_.radius - lowest.value;
  if (depth_ <= 0.0) return false;
  if (std::max(coreValue(0.0), coreValue(1.0)) + own_.radius <= 0.0 || holdsSolid()) return false;
  lowest_ = lowest.point - own_.radius * outwardDirection(solid_, lowest.point);
  const Vector3d length = core(1.0) - core(0.0);
  const double squared = length.squaredNorm();
  const double at =
      squared > 0.0 ? std::clamp((lowest.point - core(0.0)).dot(length) / squared, 0.0, 1.0) : 0.0;
  const double level = lowest.value + kPlateau * depth_;
  const Vector3d centre = core(0.5 * (plateauEnd(at, 0.0, level) + plateauEnd(at, 1.0, level)));
  out_ = -outwardDirection(solid_, centre);
  middle_ = centre + own_.radius * out_;
  axis_u_ = length - length.dot(out_) * out_;
  axis_u_ = axis_u_.norm() > 1e-9 * own_.radius ? axis_u_.normalized() : out_.unitOrthogonal();
  axis_v_ = out_.cross(axis_u_);
  return true;
}

/// The surface of `own` below a point of the tangent plane.
PairOverlap::Front PairOverlap::frontAt(const Vector3d& in_plane) const {
  const Vector3d from = own_from_solid_ * in_plane;
  const Vector3d down = own_from_solid_.linear() * -out_;
  const double reach = 2.0 * (own_.radius + own_.half_length);
  const LowestPoint lowest = lowestOnSegment(own_, from, from + reach * down);
  Front front;
  if (lowest.value >= 0.0) return front;
  front.is_there = true;
  const Vector3d on_own =
      lowest.point - wayOut(own_, lowest.point, -down, (lowest.point - from).norm()) * down;
  front.point = solid_from_own_ * on_own;
  front.value = signedDistance(solid_, front.point);
  return front;
}

/// Returns how far the patch goes along the tangent plane; nothing where it reaches round `own`.
std::optional<double> PairOverlap::border(const Vector3d& direction) const {
  double inside = 0.0;
  double step = 0.5 * std::sqrt(2.0 * own_.radius * std::min(depth_, own_.radius));
  double outside = step;
  Front front = frontAt(middle_ + outside * direction);
  for (int i = 0; front.is_there && front.value < 0.0; ++i) {
    if (i == kMostSteps) return std::nullopt;
    inside = outside;
    step *= 1.5;
    outside += step;
    front = frontAt(middle_ + outside * direction);
  }
  bool was_there = front.is_there;
  for (int i = 0; i < kMostSteps && outside - inside > 1e-15 * outside; ++i) {
    const double middle = 0.5 * (inside + outside);
    front = frontAt(middle_ + middle * direction);
    const bool is_inside = front.is_there && front.value < 0.0;
    if (!is_inside) was_there = front.is_there;
    (is_inside ? inside : outside) = middle;
  }
  return was_there ? std::optional<double>(inside) : std::nullopt;
}

bool PairOverlap::integrate(std::vector<OverlapSample>& samples, bool solid_is_a,
                            const Isometry3d& a_from_solid) {
  const int parts = !hasSide(own_) && !hasSide(solid_) ? 6 : 16;
  const auto direction_at = [&](double angle) {
    return Vector3d(std::cos(angle) * axis_u_ + std::sin(angle) * axis_v_);
  };
  std::optional<double> first = border(direction_at(0.0));
  if (!first) return false;
  Vector3d start = *first * direction_at(0.0);
  for (int part = 0; part < parts; ++part) {
    const Vector3d direction = direction_at((part + 1) % parts * 2.0 * kPi / parts);
    const std::optional<double> last = border(direction);
    if (!last) return false;
    const Vector3d end = *last * direction;
    const double twice_area = start.cross(end).dot(out_);
    for (const GaussPoint& at : kGaussFive) {
      const Vector3d chord = start + at.at * (end - start);
      const double length = chord.norm();
      if (!(length > 0.0)) continue;
      const std::optional<double> way = border(chord / length);
      if (!way) return false;
      const Vector3d ray = *way / length * chord;
      const double weight = at.weight * twice_area * (*way / length) * (*way / length);
      for (const GaussPoint& along : kGaussFour)
        add(middle_ + along.at * ray, weight * along.at * along.weight, samples, solid_is_a, a_from_solid);
    }
    start = end;
  }
  return true;
}

void PairOverlap::add(const Vector3d& in_plane, double area, std::vector<OverlapSample>& samples,
                      bool solid_is_a, const Isometry3d& a_from_solid) {
  const Front front = frontAt(in_plane);
  if (!front.is_there || front.value >= 0.0) return;
  const Vector3d normal = solid_from_own_.linear() * outwardDirection(own_, own_from_solid_ * front.point);
  const double slope = normal.dot(out_);
  if (!(slope > 0.0)) return;
  const double share = area / slope;
  const Eigen::Matrix3d turn = a_from_solid.linear();
  const double sign = solid_is_a ? -1.0 : 1.0;
  samples.push_back({a_from_solid * front.point, sign * (turn * normal),
                     -sign * (turn * outwardDirection(solid_, front.point)), share, -front.value});
  const double column = wayOut(solid_, front.point, -out_, 2.0 * reachOf(solid_));
  const Vector3d other = front.point - column * out_;
  own_area_ += share;
  vector_area_ += share * normal;
  volume_ += area * column;
  moment_ += area * column * (front.point - 0.5 * column * out_);
  const double other_slope = -outwardDirection(solid_, other).dot(out_);
  if (other_slope > 1e-3) solid_area_ += area / other_slope;
  along_ = std::max(along_, column);
  reach_ = std::max(reach_, (front.point - middle_).norm());
}

void PairOverlap::report(bool solid_is_a, const Isometry3d& a_from_solid, InterferenceRegion& region) const {
  const double length = vector_area_.norm();
  const Vector3d normal = length > 0.0 ? Vector3d(vector_area_ / length) : out_;
  region.normal_in_a = (solid_is_a ? -1.0 : 1.0) * (a_from_solid.linear() * normal);
  region.contact_area = length;
  (solid_is_a ? region.surface_area_b : region.surface_area_a) = own_area_;
  (solid_is_a ? region.surface_area_a : region.surface_area_b) = solid_area_;
  region.volume = volume_;
  region.centroid_in_a = a_from_solid * Vector3d(volume_ > 0.0 ? Vector3d(moment_ / volume_) : middle_);
  region.reach = 1.1 * reach_;
  region.depth = depth_;
  region.depth_along_normal = std::max(depth_, along_);
  const Vector3d on_solid = surfacePoint(solid_, lowest_);
  region.point_a_in_a = a_from_solid * (solid_is_a ? on_solid : lowest_);
  region.point_b_in_a = a_from_solid * (solid_is_a ? lowest_ : on_solid);
  const Vector3d below = lowest_ - region.depth_along_normal * normal;
  region.along_normal_a_in_a = a_from_solid * (solid_is_a ? below : lowest_);
  region.along_normal_b_in_a = a_from_solid * (solid_is_a ? lowest_ : below);
}

/// Orders the solids by whose surface is integrated: a sphere's where there is one, else a capsule's; of two
/// of a kind that of the smaller.
std::tuple<bool, bool, double> rankOf(const RoundShape& shape) {
  return {hasFlatEnds(shape), hasSide(shape), shape.radius};
}

}  // namespace

bool findRoundPairOverlap(const BodyMesh& a, const BodyMesh& b, const Isometry3d& a_from_b,
                          Interference& result) {
  const RoundShape& shape_a = *a.shape();
  const RoundShape& shape_b = *b.shape();
  if (hasFlatEnds(shape_a) && hasFlatEnds(shape_b)) return false;
  const bool solid_is_a = rankOf(shape_b) < rankOf(shape_a);
  const Isometry3d a_from_solid = solid_is_a ? shape_a.body_from_shape : a_from_b * shape_b.body_from_shape;
  const Isometry3d a_from_own = solid_is_a ? a_from_b * shape_b.body_from_shape : shape_a.body_from_shape;
  PairOverlap overlap(solid_is_a ? shape_b : shape_a, solid_is_a ? shape_a : shape_b,
                      a_from_solid.inverse(Eigen::Isometry) * a_from_own);
  if (!overlap.locate()) return overlap.depth() <= 0.0;
  InterferenceRegion region;
  if (overlap.depth() <= result.rounding_bound) {
    overlap.report(solid_is_a, a_from_solid, region);
    region.touching = true;
    region.depth = region.depth_along_normal = 0.0;
    result.regions.push_back(region);
    return true;
  }
  if (!overlap.integrate(result.samples, solid_is_a, a_from_solid)) {
    result.samples.clear();
    return false;
  }
  overlap.report(solid_is_a, a_from_solid, region);
  region.sample_count = static_cast<std::uint32_t>(result.samples.size());
  region.loop_count = 1;
  result.loop_areas_in_a.push_back(region.contact_area * region.normal_in_a);
  result.regions.push_back(region);
  return true;
}

}  // namespace concave_distance::detail
