#include "scene_size.h"

#include <algorithm>
#include <cmath>

namespace concave_distance {
namespace {

constexpr double kMuchFarther = 6.0;  // than the median body reaches from the middle
constexpr double kNoticeable = 0.1;   // change of the size over itself

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

std::vector<Eigen::AlignedBox3d> locatedBoxes(const Scene& scene, const PublishedPairs& pairs) {
  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<bool> known(scene.bodies.size(), false);
  const auto add = [&](std::size_t body, const Eigen::Isometry3d& reference_from_body) {
    if (!known[body]) boxes.push_back(boxInReference(scene.bodies[body].bounds, reference_from_body));
    known[body] = true;
  };
  for (const auto& pair : pairs) {
    if (!hasPoses(*pair)) continue;
    add(pair->tracked->origin->body_a, pair->heading.reference_from_a);
    add(pair->tracked->origin->body_b, pair->heading.reference_from_a * pair->tracked->input.a_from_b);
  }
  return boxes;
}

Eigen::AlignedBox3d usualRegion(const std::vector<Eigen::AlignedBox3d>& boxes) {
  Eigen::AlignedBox3d region;
  if (boxes.empty()) return region;
  std::vector<double> values(boxes.size());
  const auto medianOf = [&](const auto& value) {
    std::transform(boxes.begin(), boxes.end(), values.begin(), value);
    const auto median = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), median, values.end());
    return *median;
  };
  Eigen::Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    middle[axis] = medianOf([&](const Eigen::AlignedBox3d& box) { return box.center()[axis]; });
  }
  const auto reach = [&](const Eigen::AlignedBox3d& box) {
    return (box.center() - middle).norm() + 0.5 * box.diagonal().norm();
  };
  const double farthest = kMuchFarther * medianOf(reach);
  for (const Eigen::AlignedBox3d& box : boxes) {
    if (reach(box) <= farthest) region.extend(box);
  }
  return region;
}

double sceneSize(const std::vector<Eigen::AlignedBox3d>& boxes, double before) {
  if (boxes.empty()) return before;
  const double size = usualRegion(boxes).diagonal().norm();
  return std::abs(size - before) > kNoticeable * before ? size : before;
}

}  // namespace concave_distance
