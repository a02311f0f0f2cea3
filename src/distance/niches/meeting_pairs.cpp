#include "meeting_pairs.h"

#include <algorithm>
#include <cmath>

#include "facet_line.h"
#include "facet_pair_levels.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

Eigen::AlignedBox3d movedBox(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& a_from_b) {
  const Vector3d centre = a_from_b * box.center();
  const Vector3d half = 0.5 * (a_from_b.linear().cwiseAbs() * box.sizes());
  return {centre - half, centre + half};
}

/// The edges of one facet that are within the tolerance of another one.
std::uint8_t metEdges(const FacetPoints& of, const FacetPlane& by, double tolerance, bool& runs_through) {
  std::uint8_t met = 0;
  for (std::size_t k = 0; k < of.edgeCount(); ++k) {
    const std::size_t next = k + 1 == of.edgeCount() ? 0 : k + 1;
    LinePart part;
    if (!by.isMet(of.corners[k], of.corners[next], tolerance, part)) continue;
    met = static_cast<std::uint8_t>(met | (1U << k));
    runs_through = runs_through || part.is_through;
  }
  return met;
}

}  // namespace

bool MeetingPairs::collect(const PairFrame& frame, LocalMinimaCost& cost, WorkLimit& limit) {
  clear();
  const TriangleTree& tree_a = frame.a.tree();
  const TriangleTree& tree_b = frame.b.tree();
  const double tolerance = meetingTolerance(frame);
  // Boxes are compared in A's own frame, far from whose origin coordinates round coarser.
  const double origin = frame.a.surface().boundingBox().center().cwiseAbs().maxCoeff() +
                        frame.b.surface().boundingBox().center().cwiseAbs().maxCoeff();
  const double margin = tolerance + 1e-14 * (origin + frame.size);
  open_.clear();
  open_.emplace_back(0U, 0U);
  while (!open_.empty()) {
    if (limit.isOverNow()) return false;
    const auto [i, j] = open_.back();
    open_.pop_back();
    const TriangleTree::Node& a = tree_a.nodes()[i];
    const TriangleTree::Node& b = tree_b.nodes()[j];
    ++cost.node_pairs;
    if (a.box.squaredExteriorDistance(movedBox(b.box, frame.a_from_b)) > margin * margin) continue;
    if (a.count > 0 && b.count > 0) {
      for (std::uint32_t k = a.first; k < a.first + a.count; ++k) {
        for (std::uint32_t l = b.first; l < b.first + b.count; ++l) {
          const TriangleIndex ta = tree_a.order()[k];
          const TriangleIndex tb = tree_b.order()[l];
          if (!frame.areOnSurface(ta, tb)) continue;
          ++cost.candidates;
          const TrianglePair facets = frame.facetPairOf(ta, tb);
          if (!look(frame, facets.a, facets.b, tolerance, limit)) return false;
        }
      }
    } else if (b.count > 0 || (a.count == 0 && a.box.sizes().sum() >= b.box.sizes().sum())) {
      open_.emplace_back(i + 1, j);
      open_.emplace_back(a.first, j);
    } else {
      open_.emplace_back(i, j + 1);
      open_.emplace_back(i, b.first);
    }
  }
  return true;
}

/// Adds a facet pair if it meets and is not there yet. Returns false when the limit admits no more.
bool MeetingPairs::look(const PairFrame& frame, TriangleIndex a, TriangleIndex b, double tolerance,
                        WorkLimit& limit) {
  if (table_.find(a, b) != kNone) return true;
  const FacetPoints points_a = frame.facetOfA(a);
  const FacetPoints points_b = frame.facetOfB(b);
  const FacetPlane plane_a(points_a);
  const FacetPlane plane_b(points_b);
  if (FacetPlane::areClearlyApart(plane_a, plane_b, tolerance)) return true;
  bool runs_through = false;
  const std::uint8_t of_a = metEdges(points_a, plane_b, tolerance, runs_through);
  const std::uint8_t of_b = metEdges(points_b, plane_a, tolerance, runs_through);
  if (of_a == 0 && of_b == 0) return true;
  const double distance = runs_through ? 0.0 : std::sqrt(facetPairLevels(points_a, points_b).least());
  if (!limit.admits(pairs_.size() + 1)) return false;
  table_.insert(a, b, static_cast<std::uint32_t>(pairs_.size()));
  pairs_.push_back({a, b, distance, {of_a, of_b}});
  return true;
}

}  // namespace concave_distance::detail
