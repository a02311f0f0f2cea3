#include "marker_layout.h"

#include <algorithm>
#include <cmath>

#include "marker_parts.h"

namespace concave_distance {
namespace {

constexpr double kMuchFarther = 6.0;    // than the median body reaches from the middle
constexpr double kScaleShare = 0.009;   // diameter of the nearest points over the scene's size
constexpr double kLetterShare = 2.5;    // height of the letters over that diameter
constexpr double kFarShare = 0.2;       // end of the colour gradient over the scene's size
constexpr double kNoticeable = 0.1;     // change of the region over its size
constexpr double kSizeOfNothing = 1.0;  // m
constexpr double kSlope = 0.35;         // tangent of the camera's pitch up to which the list hides nothing
constexpr double kLift = 1.5;           // height of the list above the scene, in letters

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

bool isNoticed(const Eigen::AlignedBox3d& region, const Eigen::AlignedBox3d& before) {
  const double change = std::max((region.min() - before.min()).norm(), (region.max() - before.max()).norm());
  return before.isEmpty() || change > kNoticeable * before.diagonal().norm();
}

}  // namespace

std::vector<LocatedBody> locateBodies(const Scene& scene, const PublishedPairs& pairs) {
  std::vector<LocatedBody> located;
  std::vector<bool> known(scene.bodies.size(), false);
  const auto add = [&](std::size_t index, const Eigen::Isometry3d& reference_from_body) {
    if (known[index]) return;
    known[index] = true;
    located.push_back(
        {index, boxInReference(scene.bodies[index].bounds, reference_from_body), reference_from_body});
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (!hasPoses(*pairs[k])) continue;
    const ScenePair& pair = *pairs[k]->tracked->origin;
    add(pair.body_a, pairs[k]->heading.reference_from_a);
    add(pair.body_b, pairs[k]->heading.reference_from_a * pairs[k]->tracked->input.a_from_b);
  }
  return located;
}

Eigen::AlignedBox3d usualRegion(const std::vector<LocatedBody>& bodies) {
  Eigen::AlignedBox3d region;
  if (bodies.empty()) return region;
  std::vector<double> values(bodies.size());
  const auto medianOf = [&](const auto& value) {
    std::transform(bodies.begin(), bodies.end(), values.begin(), value);
    const auto median = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), median, values.end());
    return *median;
  };
  Eigen::Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    middle[axis] = medianOf([&](const LocatedBody& body) { return body.box.center()[axis]; });
  }
  const auto reach = [&](const LocatedBody& body) {
    return (body.box.center() - middle).norm() + 0.5 * body.box.diagonal().norm();
  };
  const double farthest = kMuchFarther * medianOf(reach);
  for (const LocatedBody& body : bodies) {
    if (reach(body) <= farthest) region.extend(body.box);
  }
  return region;
}

MarkerLayout layOut(const std::vector<LocatedBody>& bodies, const MarkerStyle& style,
                    const Eigen::AlignedBox3d& before) {
  MarkerLayout layout{style, usualRegion(bodies)};
  Eigen::AlignedBox3d& region = layout.region;
  if (region.isEmpty() || !isNoticed(region, before)) region = before;
  const double size = region.isEmpty() ? kSizeOfNothing : region.diagonal().norm();
  if (style.scale == 0.0) layout.style.scale = kScaleShare * size;
  if (style.far == 0.0) layout.style.far = style.near + roundedUp(kFarShare * size);
  layout.letter_height = kLetterShare * layout.style.scale;
  if (region.isEmpty()) return layout;
  // From above, the far edges of the scene appear higher than the near ones.
  const double rear = kSlope * 0.5 * region.diagonal().head<2>().norm();
  layout.list_bottom = region.center();
  layout.list_bottom.z() = region.max().z() + rear + kLift * layout.letter_height;
  return layout;
}

}  // namespace concave_distance
