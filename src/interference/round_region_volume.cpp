// The volume of a region of overlap of a round solid and a mesh.
#include <algorithm>
#include <limits>

#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/round_geometry.h"
#include "mesh/trees/shell_contacts.h"
#include "round_overlap.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

// Where a region is a smaller share of the solid, or leaves a smaller one, roundings of the solid's volume
// exceed the errors of ShallowRoundVolume, which needs a surface this share of the radius from the core.
constexpr double kNegligibleShare = 1e-8;
constexpr double kFarFromCore = 0.5;
// A share this small may be rounded below 0, and then seems to be all of the solid.
constexpr double kRoundedAway = 1e-12;

double restOf(const RoundVolume& volume) {
  return std::min(volume.share(), 1.0 - volume.share());
}

}  // namespace

/// Shells that meet others may overlap them, so that all together may hold more than the solid: each has a
/// volume of its own.
RoundVolume& RoundOverlap::volumeOfShell(TriangleIndex triangle) {
  const bool meet = !pair_->mesh.shellContacts().isEmpty();
  const std::uint32_t shell = meet ? pair_->mesh.topology().shell_of_triangle[triangle.value] : 0;
  std::size_t i = 0;
  while (i < volume_count_ && volumes_[i].shell != shell) ++i;
  if (i == volume_count_) {
    if (++volume_count_ > volumes_.size()) volumes_.emplace_back();
    volumes_[i].shell = shell;
    volumes_[i].volume.begin(pair_->shape);
  }
  return volumes_[i].volume;
}

void RoundOverlap::measureVolume(const Group& group, bool is_only, InterferenceRegion& region) {
  double rest = 0.0;
  for (std::size_t i = 0; i < volume_count_; ++i) {
    volumes_[i].volume.finish();
    rest = std::max(rest, restOf(volumes_[i].volume));
  }
  const int side = sideOf();
  if (rest < kNegligibleShare && leastFromCore(side) > kFarFromCore * pair_->shape.radius)
    return measureShallowVolume(group, is_only, side, region);
  if (volume_count_ > 1) return addShells(region);
  const RoundVolume& volume = volumes_.front().volume;
  const bool is_rounded_away = rest < kRoundedAway && volume.share() > 0.5 && !holdsCentre(group, is_only);
  setVolume(is_rounded_away ? 0.0 : volume.volume(), volume.moment(), volume.area(), region);
}

/// Adds the shells: what two of them have in common counts twice, up to all of the solid.
void RoundOverlap::addShells(InterferenceRegion& region) const {
  double sum = 0.0;
  double area = 0.0;
  Vector3d moment = Vector3d::Zero();
  for (std::size_t i = 0; i < volume_count_; ++i) {
    const RoundVolume& volume = volumes_[i].volume;
    const bool is_rounded_away = restOf(volume) < kRoundedAway && volume.share() > 0.5;
    const double times = is_rounded_away || isCavity(volumes_[i].shell) ? 1.0 : 0.0;
    sum += volume.volume() - times * volumeOf(pair_->shape);
    area += volume.area() - times * surfaceAreaOf(pair_->shape);
    moment += volume.moment();
  }
  setVolume(sum, moment, std::clamp(area, 0.0, surfaceAreaOf(pair_->shape)), region);
}

/// Returns whether a closed shell is turned inwards. O(triangles of the mesh).
bool RoundOverlap::isCavity(std::uint32_t shell) const {
  const SurfaceMesh& surface = pair_->mesh.surface();
  const Vector3d middle = surface.boundingBox().center();
  double volume = 0.0;
  for (std::uint32_t t = 0; t < surface.triangleCount(); ++t) {
    if (pair_->mesh.topology().shell_of_triangle[t] != shell) continue;
    const auto corner = [&](int k) { return Vector3d(surface.corner(TriangleIndex{t}, k) - middle); };
    volume += corner(0).dot(corner(1).cross(corner(2)));
  }
  return volume < 0.0;
}

void RoundOverlap::setVolume(double volume, const Vector3d& moment, double area,
                             InterferenceRegion& region) const {
  region.volume = std::clamp(volume, 0.0, volumeOf(pair_->shape));
  if (volume > 0.0) region.centroid_in_a = inA(moment / volume);
  (shape_is_a_ ? region.surface_area_a : region.surface_area_b) = area;
}

/// Returns the end of a cylinder that all samples are well on the way to, 1 or -1; else 0.
int RoundOverlap::sideOf() const {
  if (!hasFlatEnds(pair_->shape)) return 0;
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const RoundSample& sample : samples_) {
    least = std::min(least, sample.point.z());
    most = std::max(most, sample.point.z());
  }
  const double margin = 0.05 * pair_->shape.half_length;
  return least > margin ? 1 : most < -margin ? -1 : 0;
}

/// Returns how far the samples stay from where the fields of ShallowRoundVolume are singular, metres.
double RoundOverlap::leastFromCore(int side) const {
  double least = std::numeric_limits<double>::infinity();
  if (side != 0) return least;
  const bool is_cylinder = hasFlatEnds(pair_->shape);
  for (const RoundSample& sample : samples_) {
    const Vector3d out = sample.point - corePoint(pair_->shape, sample.point);
    least = std::min(least, is_cylinder ? sample.point.head<2>().norm() : out.norm());
  }
  return least;
}

void RoundOverlap::measureShallowVolume(const Group& group, bool is_only, int side,
                                        InterferenceRegion& region) {
  ShallowRoundVolume volume(pair_->shape, side);
  for (const RoundSample& sample : samples_) volume.add(sample);
  addCore(group, is_only, volume);
  setVolume(volume.volume(), volume.moment(), volume.area(), region);
}

/// Parts of the axis inside the mesh belong to the region that their ends are on, or that the centre is in.
void RoundOverlap::addCore(const Group& group, bool is_only, ShallowRoundVolume& volume) {
  const double h = pair_->shape.half_length;
  if (h == 0.0) {
    if (holdsCentre(group, is_only)) volume.addCore(0.0, 0.0);
    return;
  }
  // Beside the axis, so that it does not run along an edge: scenes are symmetrical.
  const double beside = 1e-9 * pair_->shape.radius;
  const Vector3d from(beside, 0.71 * beside, -h);
  const Vector3d to(beside, 0.71 * beside, h);
  findCrossings(from, to);
  if (crossings_.empty()) {
    if (holdsCentre(group, is_only)) volume.addCore(-h, h);
    return;
  }
  double inside_from = -h;
  for (const Crossing& crossing : crossings_) {
    const double height = (2.0 * crossing.at - 1.0) * h;
    if (crossing.outward > 0.0 && has(group, crossing.patch)) volume.addCore(inside_from, height);
    inside_from = height;
  }
  const Crossing& last = crossings_.back();
  if (last.outward < 0.0 && has(group, last.patch)) volume.addCore(inside_from, h);
}

bool RoundOverlap::holdsCentre(const Group& group, bool is_only) {
  if (!meshHolds(Vector3d::Zero())) return false;
  if (is_only) return true;
  const Entry& deepest = deepestOf(entries_.data(), entries_.data() + entries_.size());
  findCrossings(Vector3d::Zero(), deepest.lowest.point);
  return has(group, crossings_.empty() ? deepest.patch : crossings_.front().patch);
}

}  // namespace concave_distance::detail
