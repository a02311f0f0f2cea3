// Measures a region of overlap of a round solid and a mesh.
#include <algorithm>
#include <cmath>
#include <limits>

#include "distance/bound/closest_point.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/round_geometry.h"
#include "round_lines.h"
#include "round_overlap.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

// Where the vector area is a smaller share of the surface than this, it says nothing of the normal.
constexpr double kCancels = 1e-6;
// Triangles wholly inside have one sample each where a region has more triangles than these.
constexpr std::ptrdiff_t kManyTriangles = 400;

Vector3d unitOr(const Vector3d& vector, const Vector3d& other) {
  const double length = vector.norm();
  return length > 0.0 ? Vector3d(vector / length) : other;
}

}  // namespace

void RoundOverlap::place(const Vector3d& on_mesh, const Vector3d& on_shape, Vector3d& on_a,
                         Vector3d& on_b) const {
  on_a = inA(shape_is_a_ ? on_shape : on_mesh);
  on_b = inA(shape_is_a_ ? on_mesh : on_shape);
}

/// The direction in which the mesh ends, shape's frame.
Vector3d RoundOverlap::outOfMesh(const Vector3d& normal_in_a) const {
  const Vector3d normal = a_from_shape_.linear().transpose() * normal_in_a;
  return shape_is_a_ ? Vector3d(-normal) : normal;
}

const RoundOverlap::Entry& RoundOverlap::deepestOf(const Entry* first, const Entry* last) {
  return *std::min_element(first, last,
                           [](const Entry& l, const Entry& r) { return l.lowest.value < r.lowest.value; });
}

bool RoundOverlap::has(const Group& group, std::uint32_t patch) {
  return std::any_of(group.first, group.last, [&](const Entry& entry) { return entry.patch == patch; });
}

/// Samples and facets of a region; what is hidden counts for the volumes of its shells alone.
void RoundOverlap::gatherSamples(Group& group) {
  samples_.clear();
  patch_samples_.clear();
  fan_.clear();
  fan_ends_.clear();
  volume_count_ = 0;
  const bool sparse = group.last - group.first > kManyTriangles;
  for (const Entry* entry = group.first; entry != group.last; ++entry) {
    if (entry == group.first || entry->patch != (entry - 1)->patch) patch_samples_.push_back(samples_.size());
    section_.integrate(pair_->shape, entry->corners, entry->lowest, sparse, samples_, fan_,
                       volumeOfShell(entry->triangle));
    fan_ends_.push_back(fan_.size());
  }
  patch_samples_.push_back(samples_.size());
  group.last_sample = samples_.size();
  const std::size_t drawn = fan_.size();
  for (const Entry* entry = group.last; entry != group.last_hidden; ++entry) {
    section_.integrate(pair_->shape, entry->corners, entry->lowest, true, samples_, fan_,
                       volumeOfShell(entry->triangle));
  }
  samples_.resize(group.last_sample);
  fan_.resize(drawn);
}

void RoundOverlap::addRegion(Group group, bool is_only, Interference& result) {
  InterferenceRegion region;
  region.closed = std::all_of(group.first, group.last, [&](const Entry& entry) {
    return pair_->mesh.topology().isOnClosedShell(entry.triangle);
  });
  gatherSamples(group);
  double surface = 0.0;
  Vector3d vector_area = Vector3d::Zero();
  Vector3d middle = Vector3d::Zero();
  for (const RoundSample& sample : samples_) {
    surface += sample.area;
    vector_area += sample.area * sample.normal;
    middle += sample.area * sample.point;
  }
  region.touching = region.closed && -deepestOf(group.first, group.last).lowest.value <= rounding_;
  region.centroid_in_a = inA(surface > 0.0 ? Vector3d(middle / surface) : group.first->lowest.point);
  chooseNormal(group, surface, vector_area, region);
  region.contact_area = region.closed ? vector_area.norm() : region.contact_area;
  if (region.closed) {
    (shape_is_a_ ? region.surface_area_b : region.surface_area_a) = surface;
    (shape_is_a_ ? region.surface_area_a : region.surface_area_b) = 0.0;
    region.depth = region.depth_along_normal = region.volume = 0.0;
    place(group.first->lowest.point, group.first->lowest.point, region.point_a_in_a, region.point_b_in_a);
  }
  if (region.closed && !region.touching) {
    measureVolume(group, is_only, region);
    measureDepths(group, region);
    addLoops(group, result, region);
    addSamples(group, result, region);
    addFacets(group, result, region);
  } else if (!region.closed) {
    region.loop_count = 1;
  }
  for (const TrianglePoints& drawn : fan_) {
    for (const Vector3d& corner : drawn)
      region.reach = std::max(region.reach, (inA(corner) - region.centroid_in_a).norm());
  }
  result.regions.push_back(region);
}

/// A patch with a border counts as one loop, the vector area of which is the patch's.
void RoundOverlap::addLoops(const Group& group, Interference& result, InterferenceRegion& region) {
  region.first_loop = static_cast<std::uint32_t>(result.loop_areas_in_a.size());
  std::size_t patch = 0;
  for (const Entry* entry = group.first; entry != group.last; ++patch) {
    const Entry* last =
        std::find_if(entry, group.last, [&](const Entry& other) { return other.patch != entry->patch; });
    if (std::any_of(entry, last, [](const Entry& part) { return part.leaves; })) {
      Vector3d area = Vector3d::Zero();
      for (std::size_t s = patch_samples_[patch]; s < patch_samples_[patch + 1]; ++s)
        area += samples_[s].area * samples_[s].normal;
      result.loop_areas_in_a.push_back(a_from_shape_.linear() * (shape_is_a_ ? Vector3d(-area) : area));
    }
    entry = last;
  }
  region.loop_count = static_cast<std::uint32_t>(result.loop_areas_in_a.size()) - region.first_loop;
  if (region.loop_count == 0) (shape_is_a_ ? region.b_swallowed : region.a_swallowed) = true;
}

/// The vector area's direction or, where that cancels, the axis of either body along which the solid has
/// least far to go.
void RoundOverlap::chooseNormal(const Group& group, double surface, const Vector3d& vector_area,
                                InterferenceRegion& region) {
  Vector3d out = unitOr(vector_area, group.first->normal);
  if (vector_area.norm() < kCancels * surface) {
    region.normal_is_fallback = true;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const Vector3d& direction) {
      const double depth = depthAlong(group, direction, nullptr);
      if (depth >= least) return;
      least = depth;
      out = direction;
    };
    for (const Entry* entry = group.first; entry != group.last; ++entry) {
      if (entry == group.first || entry->patch != (entry - 1)->patch) consider(entry->normal);
    }
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        consider(sign * Vector3d::Unit(axis));
        consider(sign * pair_->shape_from_mesh.col(axis));
      }
    }
  }
  region.normal_in_a = a_from_shape_.linear() * (shape_is_a_ ? Vector3d(-out) : out);
}

/// Returns how far the solid must go along a direction out of the mesh until it is above all of the patch
/// that faces that way, as far as the samples show it.
double RoundOverlap::depthAlong(const Group& group, const Vector3d& out_of_mesh, Vector3d* at) const {
  double depth = 0.0;
  const double reach = 2.0 * reachOf(pair_->shape);
  const auto look = [&](const Vector3d& point) {
    const double below = wayOut(pair_->shape, point, -out_of_mesh, reach);
    if (below <= depth) return;
    depth = below;
    if (at != nullptr) *at = point;
  };
  for (std::size_t s = group.first_sample; s < group.last_sample; ++s) {
    if (samples_[s].normal.dot(out_of_mesh) > 0.0) look(samples_[s].point);
  }
  for (const Entry* entry = group.first; entry != group.last; ++entry) {
    if (entry->normal.dot(out_of_mesh) > 0.0) look(entry->lowest.point);
  }
  return depth;
}

void RoundOverlap::measureDepths(const Group& group, InterferenceRegion& region) {
  const Entry& deepest = deepestOf(group.first, group.last);
  region.depth = -deepest.lowest.value;
  place(deepest.lowest.point, surfacePoint(pair_->shape, deepest.lowest.point), region.point_a_in_a,
        region.point_b_in_a);
  const Vector3d out = outOfMesh(region.normal_in_a);
  Vector3d top = deepest.lowest.point;
  region.depth_along_normal = depthAlong(group, out, &top);
  place(top, top - region.depth_along_normal * out, region.along_normal_a_in_a, region.along_normal_b_in_a);
  lookAtBottom(group, out, region);
}

/// The solid's own point that is farthest in the mesh: how far it is from the mesh's surface, and below it.
void RoundOverlap::lookAtBottom(const Group& group, const Vector3d& out_of_mesh, InterferenceRegion& region) {
  const Vector3d bottom = supportPoint(pair_->shape, -out_of_mesh);
  const double reach = 2.0 * reachOf(pair_->shape);
  findCrossings(bottom, bottom + reach * out_of_mesh);
  if (crossings_.empty() || crossings_.front().outward <= 0.0) return;
  const Crossing& above = crossings_.front();
  if (!has(group, above.patch)) return;
  const double height = above.at * reach;
  if (height > region.depth_along_normal) {
    region.depth_along_normal = height;
    place(bottom + height * out_of_mesh, bottom, region.along_normal_a_in_a, region.along_normal_b_in_a);
  }
  const Vector3d in_mesh = pair_->centre_in_mesh + pair_->shape_from_mesh.transpose() * bottom;
  const SurfacePoint nearest = closestPoint(pair_->mesh, in_mesh, group.first->triangle);
  const double depth = std::sqrt(nearest.squared_distance);
  if (depth <= region.depth) return;
  region.depth = depth;
  place(pair_->inShape(nearest.point), bottom, region.point_a_in_a, region.point_b_in_a);
}

void RoundOverlap::addSamples(const Group& group, Interference& result, InterferenceRegion& region) const {
  region.first_sample = static_cast<std::uint32_t>(result.samples.size());
  const Eigen::Matrix3d turn = a_from_shape_.linear();
  const double sign = shape_is_a_ ? -1.0 : 1.0;
  for (std::size_t s = group.first_sample; s < group.last_sample; ++s) {
    const RoundSample& sample = samples_[s];
    result.samples.push_back({inA(sample.point), sign * (turn * sample.normal), -sign * (turn * sample.out),
                              sample.area, sample.depth});
  }
  region.sample_count = static_cast<std::uint32_t>(result.samples.size()) - region.first_sample;
}

void RoundOverlap::addFacets(const Group& group, Interference& result, InterferenceRegion& region) const {
  region.first_facet = static_cast<std::uint32_t>(result.facets.size());
  std::size_t next = 0;
  for (const Entry* entry = group.first; entry != group.last; ++entry) {
    OverlapFacet facet;
    facet.normal_in_a = a_from_shape_.linear() * entry->normal;
    facet.triangle = entry->triangle;
    facet.of_b = shape_is_a_;
    for (const std::size_t end = fan_ends_[static_cast<std::size_t>(entry - group.first)]; next < end;
         ++next) {
      for (std::size_t k = 0; k < 3; ++k) facet.corners_in_a[k] = inA(fan_[next][k]);
      result.facets.push_back(facet);
    }
  }
  region.facet_count = static_cast<std::uint32_t>(result.facets.size()) - region.first_facet;
}

/// Nothing of the mesh is inside the solid: all of the solid is the region, its way out that along the axes
/// of the mesh's box.
void RoundOverlap::addSwallowedShape(Interference& result) {
  InterferenceRegion region;
  const RoundShape& shape = pair_->shape;
  (shape_is_a_ ? region.a_swallowed : region.b_swallowed) = true;
  region.normal_is_fallback = true;
  region.volume = volumeOf(shape);
  region.centroid_in_a = inA(Vector3d::Zero());
  region.contact_area = 0.0;
  (shape_is_a_ ? region.surface_area_a : region.surface_area_b) = surfaceAreaOf(shape);
  (shape_is_a_ ? region.surface_area_b : region.surface_area_a) = 0.0;
  const Eigen::AlignedBox3d& box = pair_->mesh.surface().boundingBox();
  region.depth_along_normal = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Vector3d out = sign * pair_->shape_from_mesh.col(axis);
      const double top =
          (sign > 0.0 ? box.max()[axis] : -box.min()[axis]) - sign * pair_->centre_in_mesh[axis];
      const Vector3d bottom = supportPoint(shape, -out);
      const double way = top - out.dot(bottom);
      if (way >= region.depth_along_normal) continue;
      region.depth_along_normal = way;
      region.normal_in_a = a_from_shape_.linear() * (shape_is_a_ ? Vector3d(-out) : out);
      place(bottom + way * out, bottom, region.along_normal_a_in_a, region.along_normal_b_in_a);
    }
  }
  const Vector3d bottom = supportPoint(shape, -outOfMesh(region.normal_in_a));
  const SurfacePoint nearest = closestPoint(
      pair_->mesh, pair_->centre_in_mesh + pair_->shape_from_mesh.transpose() * bottom, TriangleIndex{0});
  region.depth = std::sqrt(nearest.squared_distance);
  place(pair_->inShape(nearest.point), bottom, region.point_a_in_a, region.point_b_in_a);
  result.regions.push_back(region);
}

}  // namespace concave_distance::detail
