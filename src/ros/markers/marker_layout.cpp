#include "marker_layout.h"

#include <algorithm>
#include <cmath>

namespace concave_distance {
namespace {

constexpr double kMuchLarger = 6.0;        // than the median body: a floor, a hall
constexpr double kFarOff = 8.0;            // median distances from the median centre
constexpr double kScaleShare = 0.009;      // diameter of the nearest points over the scene's size
constexpr double kLabelLetterShare = 2.5;  // height of the letters over that diameter
constexpr double kFarShare = 0.25;         // end of the colour gradient over the scene's size
constexpr double kResizeStep = 1.3;        // the size is updated when it has changed by this factor
constexpr double kMoveStep = 0.1;          // the place is updated when it has moved by this share of the size
constexpr double kSizeOfNothing = 1.0;     // m

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// 1, 2 or 5 times a power of ten, not above the value.
double roundedDown(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  const double digit = value / power;
  return power * (digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0);
}

Eigen::AlignedBox3d boxInReference(const BodyBounds& bounds, const Eigen::Isometry3d& reference_from_body) {
  const Eigen::Vector3d centre = reference_from_body * bounds.centre;
  const Eigen::Vector3d half = reference_from_body.linear().cwiseAbs() * bounds.half_extents;
  return {centre - half, centre + half};
}

bool hasPoses(const PublishedPair& pair) {
  return pair.demand().due && pair.status.code != PairStatus::MISSING_TRANSFORM &&
         pair.status.code != PairStatus::STALE_TRANSFORM && pair.status.code != PairStatus::INVALID_POSE &&
         pair.tracked->input.a_from_b.matrix().allFinite() &&
         pair.heading.reference_from_a.matrix().allFinite();
}

}  // namespace

std::vector<LocatedBody> locateBodies(const Scene& scene, const PublishedPairs& pairs) {
  std::vector<LocatedBody> located;
  std::vector<bool> known(scene.bodies.size(), false);
  const auto add = [&](std::size_t index, const Eigen::Isometry3d& reference_from_body) {
    if (!known[index]) {
      known[index] = true;
      located.push_back(
          {index, boxInReference(scene.bodies[index].bounds, reference_from_body), reference_from_body});
    }
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (hasPoses(*pairs[k])) {
      add(scene.pairs[k].body_a, pairs[k]->heading.reference_from_a);
      add(scene.pairs[k].body_b, pairs[k]->heading.reference_from_a * pairs[k]->tracked->input.a_from_b);
    }
  }
  return located;
}

Eigen::AlignedBox3d usualRegion(const std::vector<LocatedBody>& bodies) {
  Eigen::AlignedBox3d region;
  if (bodies.empty()) {
    return region;
  }
  std::vector<double> sizes;
  std::vector<double> coordinates[3];
  for (const LocatedBody& body : bodies) {
    sizes.push_back(body.box.diagonal().norm());
    for (int axis = 0; axis < 3; ++axis) coordinates[axis].push_back(body.box.center()[axis]);
  }
  const double size = median(sizes);
  const Eigen::Vector3d middle(median(coordinates[0]), median(coordinates[1]), median(coordinates[2]));
  std::vector<double> distances;
  distances.reserve(bodies.size());
  for (const LocatedBody& body : bodies) distances.push_back((body.box.center() - middle).norm());
  const double far = kFarOff * (median(distances) + size);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (sizes[k] <= kMuchLarger * size && distances[k] <= far) region.extend(bodies[k].box);
  }
  return region;
}

void MarkerLayout::update(const std::vector<LocatedBody>& bodies, const MarkerStyle& style) {
  const Eigen::AlignedBox3d region = usualRegion(bodies);
  if (!region.isEmpty()) {
    const double size = region.diagonal().norm();
    const bool resized = size_ == 0.0 || size > kResizeStep * size_ || size_ > kResizeStep * size;
    const bool moved = region_.isEmpty() || (region.center() - region_.center()).norm() > kMoveStep * size_ ||
                       std::abs(region.max().z() - region_.max().z()) > kMoveStep * size_;
    if (resized) size_ = size;
    if (resized || moved) region_ = region;
  }
  const double size = size_ > 0.0 ? size_ : kSizeOfNothing;
  style_ = style;
  if (style.scale == 0.0) style_.scale = kScaleShare * size;
  if (style.far == 0.0) style_.far = style.near + roundedDown(kFarShare * size);
}

double MarkerLayout::letterHeight() const {
  return kLabelLetterShare * style_.scale;
}

}  // namespace concave_distance
