#include "round_overlap.h"

#include <algorithm>
#include <tuple>

#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/round_geometry.h"
#include "mesh/trees/shell_contacts.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

// More patches than these are not compared each with each.
constexpr std::size_t kMostPatches = 32;

/// A triangle enters the solid where one of its edges does, also where rounding hides it: the triangle across
/// that edge enters, and both bound the region.
LowestPoint lowestOf(const RoundShape& shape, const TrianglePoints& corners) {
  LowestPoint lowest = lowestOnTriangle(shape, corners);
  if (lowest.value < 0.0 || lowest.value > kRoundDistanceError * (lowest.point.norm() + reachOf(shape)))
    return lowest;
  for (std::size_t k = 0; k < 3; ++k) {
    const LowestPoint edge = lowestOnEdge(shape, corners[k], corners[(k + 1) % 3]);
    if (edge.value < lowest.value) lowest = edge;
  }
  return lowest;
}

}  // namespace

void RoundOverlap::find(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                        Interference& result, WorkLimit& limit) {
  shape_is_a_ = a.shape() != nullptr;
  const BodyMesh& round = shape_is_a_ ? a : b;
  a_from_shape_ = shape_is_a_ ? round.shape()->body_from_shape : a_from_b * round.shape()->body_from_shape;
  pair_.emplace(*round.shape(), shape_is_a_ ? b : a,
                shape_is_a_ ? a_from_b.inverse(Eigen::Isometry) : a_from_b);
  rounding_ = result.rounding_bound;
  if (!collect(limit)) {
    result.status = InterferenceStatus::Cut;
    return;
  }
  if (entries_.empty()) {
    if (meshHolds(Vector3d::Zero())) addSwallowedShape(result);
    return;
  }
  joinEntries();
  joinPatches();
  std::sort(entries_.begin(), entries_.end(), [](const Entry& l, const Entry& r) {
    return std::tie(l.region, l.hidden, l.patch, l.triangle.value) <
           std::tie(r.region, r.hidden, r.patch, r.triangle.value);
  });
  const bool is_only = entries_.front().region == entries_.back().region;
  const Entry* const end = entries_.data() + entries_.size();
  for (const Entry* first = entries_.data(); first != end;) {
    const Entry* last =
        std::find_if(first, end, [&](const Entry& entry) { return entry.region != first->region; });
    const Entry* last_seen = std::find_if(first, last, [](const Entry& entry) { return entry.hidden; });
    if (last_seen != first) addRegion({first, last_seen, last, 0, 0}, is_only, result);
    first = last;
  }
}

/// Triangles that enter the solid. False when the limit was reached first.
bool RoundOverlap::collect(WorkLimit& limit) {
  entries_.clear();
  const BodyMesh& mesh = pair_->mesh;
  const RoundShape& shape = pair_->shape;
  stack_.assign(1, 0U);
  while (!stack_.empty()) {
    if (limit.isOverNow()) return false;
    const TriangleTree::Node& node = mesh.tree().nodes()[stack_.back()];
    const std::uint32_t index = stack_.back();
    stack_.pop_back();
    const Vector3d middle = pair_->inShape(node.box.center());
    const Vector3d out = pair_->shape_from_mesh.transpose() * outwardDirection(shape, middle);
    if (signedDistance(shape, middle) - 0.5 * out.cwiseAbs().dot(node.box.sizes()) > rounding_) continue;
    if (node.count == 0) {
      stack_.push_back(node.first);
      stack_.push_back(index + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const TriangleIndex triangle = mesh.tree().order()[i];
      const TrianglePoints corners = pair_->triangleInShape(triangle);
      if (lowerBoundOnTriangle(shape, corners) > rounding_) continue;
      const LowestPoint lowest = lowestOf(shape, corners);
      const Vector3d& normal = mesh.topology().triangle_normals[triangle.value];
      if (lowest.value >= 0.0 || normal.isZero()) continue;
      const bool leaves = std::any_of(corners.begin(), corners.end(), [&](const Vector3d& corner) {
        return signedDistance(shape, corner) > 0.0;
      });
      entries_.push_back({triangle, 0, 0, lowest, corners, pair_->shape_from_mesh * normal, leaves,
                          mesh.shellContacts().isHidden(triangle)});
    }
  }
  return true;
}

/// Joins entries over edges that enter the solid.
void RoundOverlap::joinEntries() {
  const MeshTopology& topology = pair_->mesh.topology();
  const std::size_t triangles = pair_->mesh.surface().triangleCount();
  if (stamps_.size() < triangles) {
    stamps_.resize(triangles, 0);
    place_of_triangle_.resize(triangles, 0);
  }
  if (++stamp_ == 0) {
    std::fill(stamps_.begin(), stamps_.end(), 0U);
    stamp_ = 1;
  }
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    stamps_[entries_[i].triangle.value] = stamp_;
    place_of_triangle_[entries_[i].triangle.value] = static_cast<std::uint32_t>(i);
  }
  patches_.reset(entries_.size());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const TriangleIndex across = topology.triangle_across_edge[entries_[i].triangle.value][k];
      if (across == kNoTriangle || stamps_[across.value] != stamp_) continue;
      const std::uint32_t other = place_of_triangle_[across.value];
      if (patches_.areJoined(other, static_cast<std::uint32_t>(i))) continue;
      const TrianglePoints& corners = entries_[i].corners;
      if (lowestOnEdge(pair_->shape, corners[k], corners[(k + 1) % 3]).value < 0.0)
        patches_.unite(static_cast<std::uint32_t>(i), other);
    }
  }
  for (std::size_t i = 0; i < entries_.size(); ++i)
    entries_[i].patch = patches_.find(static_cast<std::uint32_t>(i));
}

/// Patches bound one region where material of the mesh joins them. It is looked for on the lines between
/// their deepest points: patches that it does not show are regions of their own.
void RoundOverlap::joinPatches() {
  deepest_.clear();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].hidden) continue;
    const auto known = std::find_if(deepest_.begin(), deepest_.end(), [&](std::uint32_t entry) {
      return entries_[entry].patch == entries_[i].patch;
    });
    if (known == deepest_.end()) {
      deepest_.push_back(static_cast<std::uint32_t>(i));
    } else if (entries_[i].lowest.value < entries_[*known].lowest.value) {
      *known = static_cast<std::uint32_t>(i);
    }
  }
  const std::size_t count = std::min(deepest_.size(), kMostPatches);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      const Entry& from = entries_[deepest_[i]];
      const Entry& to = entries_[deepest_[j]];
      if (!patches_.areJoined(from.patch, to.patch)) joinAlong(from, to);
    }
  }
  joinHidden();
  for (Entry& entry : entries_) entry.region = patches_.find(entry.patch);
}

/// A patch that is hidden all over bounds what another patch of its shell does.
void RoundOverlap::joinHidden() {
  const std::vector<std::uint32_t>& shells = pair_->mesh.topology().shell_of_triangle;
  for (const Entry& entry : entries_) {
    if (!entry.hidden) continue;
    const auto is_seen = [&](std::uint32_t other) {
      return patches_.areJoined(entries_[other].patch, entry.patch);
    };
    if (std::any_of(deepest_.begin(), deepest_.end(), is_seen)) continue;
    const std::uint32_t shell = shells[entry.triangle.value];
    const auto same = std::find_if(deepest_.begin(), deepest_.end(), [&](std::uint32_t other) {
      return shells[entries_[other].triangle.value] == shell;
    });
    if (same != deepest_.end()) patches_.unite(entries_[*same].patch, entry.patch);
  }
}

void RoundOverlap::joinAlong(const Entry& from, const Entry& to) {
  const Vector3d way = to.lowest.point - from.lowest.point;
  findCrossings(from.lowest.point, to.lowest.point);
  Crossing before{0.0, from.normal.dot(way), from.patch};
  crossings_.push_back({1.0, to.normal.dot(way), to.patch});
  for (const Crossing& crossing : crossings_) {
    if (before.outward < 0.0 && crossing.outward > 0.0) patches_.unite(before.patch, crossing.patch);
    before = crossing;
  }
}

/// Finds where the mesh crosses a segment inside the solid, but at its ends; ascending.
void RoundOverlap::findCrossings(const Vector3d& from, const Vector3d& to) {
  constexpr double kEnd = 1e-9;
  crossings_.clear();
  const Vector3d way = to - from;
  for (const Entry& entry : entries_) {
    const Vector3d e1 = entry.corners[1] - entry.corners[0];
    const Vector3d e2 = entry.corners[2] - entry.corners[0];
    const Vector3d across = way.cross(e2);
    const double det = e1.dot(across);
    if (det == 0.0) continue;
    const Vector3d s = from - entry.corners[0];
    const double u = s.dot(across) / det;
    const Vector3d q = s.cross(e1);
    const double v = way.dot(q) / det;
    const double at = e2.dot(q) / det;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || at < kEnd || at > 1.0 - kEnd) continue;
    crossings_.push_back({at, entry.normal.dot(way), entry.patch});
  }
  std::sort(crossings_.begin(), crossings_.end(),
            [](const Crossing& l, const Crossing& r) { return l.at < r.at; });
}

/// @param point shape's frame
bool RoundOverlap::meshHolds(const Vector3d& point) const {
  const MeshTopology& topology = pair_->mesh.topology();
  return containsPoint(pair_->mesh.tree(), pair_->mesh.surface(), topology.shell_is_closed,
                       topology.shell_of_triangle,
                       pair_->centre_in_mesh + pair_->shape_from_mesh.transpose() * point);
}

}  // namespace concave_distance::detail
