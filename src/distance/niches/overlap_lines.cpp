#include <algorithm>
#include <tuple>

#include "overlap_sets.h"

// Straight lines within one facet: its edges, and one from each curve that no edge meets to a corner.

namespace concave_distance::detail {

using Eigen::Vector3d;
bool OverlapSets::joinAlongEdges(Side side) {
  for (const MetFacet& met : at(side).met) {
    const FacetPoints points = facetPoints(side, met.facet);
    for (std::size_t k = 0; k < points.edgeCount() && count_ > 1; ++k) {
      if (limit_->isOverNow()) return false;
      const std::size_t next = k + 1 == points.edgeCount() ? 0 : k + 1;
      const NodeIndex from = facets(side).nodes[met.facet.value][k];
      const NodeIndex to = facets(side).nodes[met.facet.value][next];
      collectHits(side, met, points.corners[k], points.corners[next], static_cast<int>(k));
      if (!hits_.empty()) {
        joinHits(side, points.corners[k], points.corners[next]);
        joinEnds(side, from, to, (points.corners[next] - points.corners[k]).norm());
      } else if (isInside(side, from)) {
        unite(markInside(side, from), markInside(side, to));
      } else {
        markOutside(side, to);
      }
    }
    if (count_ <= 1) break;
  }
  return true;
}

/// Joins the curves that no edge of their facet meets, and what hangs together where shells meet.
bool OverlapSets::joinInFacets(Side side) {
  Surface& surface = at(side);
  is_hole_.assign(met_->pairs().size(), 1);
  for (const std::uint32_t pair : surface.pairs) {
    if (met_->pairs()[pair].met_edges[side == Side::A ? 0 : 1] != 0)
      is_hole_[surface.clusters.find(pair)] = 0;
  }
  for (const MetFacet& met : surface.met) {
    const FacetPoints points = facetPoints(side, met.facet);
    for (std::uint32_t i = met.first; i < met.last; ++i) {
      if (count_ <= 1) return true;
      const std::uint32_t pair = surface.pairs[i];
      if (surface.clusters.find(pair) != pair || is_hole_[pair] == 0) continue;
      if (limit_->isOverNow()) return false;
      const Vector3d from = pointOf(side, pair);
      collectHits(side, met, from, points.corners[0], -1);
      joinHits(side, from, points.corners[0]);
      joinEnds(side, {}, facets(side).nodes[met.facet.value][0], (points.corners[0] - from).norm());
    }
    if (!joinOverJoints(side, met.facet, true)) return false;
  }
  return true;
}

void OverlapSets::collectHits(Side side, const MetFacet& met, const Vector3d& from, const Vector3d& to,
                              int edge) {
  hits_.clear();
  for (std::uint32_t i = met.first; i < met.last; ++i) {
    const std::uint32_t pair = at(side).pairs[i];
    const std::uint8_t met_edges = met_->pairs()[pair].met_edges[side == Side::A ? 0 : 1];
    if (edge >= 0 && (met_edges >> static_cast<unsigned>(edge) & 1U) == 0) continue;
    const FacetPoints points = facetPoints(otherOf(side), facetIn(otherOf(side), pair));
    LinePart part;
    if (!FacetPlane(points).isMet(from, to, tolerance_, part)) continue;
    hits_.push_back({part, pair});
  }
  std::sort(hits_.begin(), hits_.end(), [](const Hit& l, const Hit& r) {
    return std::tie(l.part.first, l.pair) < std::tie(r.part.first, r.pair);
  });
}

void OverlapSets::joinHits(Side side, const Vector3d& from, const Vector3d& to) {
  if (hits_.empty()) return;
  const double gap = kLeastGap * tolerance_ / (to - from).norm();
  Hit last = hits_.front();
  for (const Hit& hit : hits_) {
    const double middle = 0.5 * (last.part.last + hit.part.first);
    if (hit.part.first - last.part.last > gap && !sets_.areJoined(last.pair, hit.pair) &&
        holds(otherOf(side), from + middle * (to - from))) {
      unite(last.pair, hit.pair);
    }
    if (hit.part.last >= last.part.last) last = hit;
  }
}

void OverlapSets::joinEnds(Side side, std::optional<NodeIndex> from, NodeIndex to, double length) {
  if (hits_.empty()) return;
  const double gap = kLeastGap * tolerance_;
  if (from && hits_.front().part.first * length > gap && isInside(side, *from)) {
    unite(markInside(side, *from), hits_.front().pair);
  }
  const Hit& last = *std::max_element(hits_.begin(), hits_.end(),
                                      [](const Hit& l, const Hit& r) { return l.part.last < r.part.last; });
  if ((1.0 - last.part.last) * length > gap && isInside(side, to)) {
    unite(markInside(side, to), last.pair);
  }
}

std::uint32_t OverlapSets::elementAt(Side side, TriangleIndex facet, const Vector3d& point) {
  const Surface& surface = at(side);
  const Mark& mark = surface.facets[facet.value];
  const NodeIndex corner = facets(side).nodes[facet.value][0];
  if (mark.stamp != surface.stamp || mark.value == kNone) return markInside(side, corner);
  const Vector3d to = side == Side::A ? frame_->vertexOfA(corner) : frame_->vertexOfB(corner);
  collectHits(side, surface.met[mark.value], point, to, -1);
  return hits_.empty() ? markInside(side, corner) : hits_.front().pair;
}

Vector3d OverlapSets::pointOf(Side side, std::uint32_t pair) const {
  const MeetingPair& met = met_->pairs()[pair];
  const TrianglePairDistance closest = frame_->closestIn({met.a, met.b}).second;
  return side == Side::A ? closest.point_a : closest.point_b;
}

}  // namespace concave_distance::detail
