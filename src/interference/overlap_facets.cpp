#include "overlap_facets.h"

namespace concave_distance::detail {
namespace {

struct Owner {
  Side side;
  TriangleIndex triangle;
  Eigen::Vector3d normal;
};

OverlapFacet facetOf(const Owner& owner) {
  OverlapFacet facet;
  facet.normal_in_a = owner.normal;
  facet.triangle = owner.triangle;
  facet.of_b = owner.side == Side::B;
  return facet;
}

void addWhole(WorkingFrame& frame, const Owner& owner, std::vector<OverlapFacet>& facets) {
  const Corners corners = frame.corners(owner.side, owner.triangle);
  OverlapFacet facet = facetOf(owner);
  for (std::size_t k = 0; k < 3; ++k) facet.corners_in_a[k] = frame.pointInA(*corners[k]);
  facets.push_back(facet);
}

Eigen::Vector3d middleOf(const PieceEdge* first, const PieceEdge* last) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0.0;
  for (const PieceEdge* edge = first; edge != last; ++edge) {
    const double length = (edge->to - edge->from).norm();
    sum += 0.5 * length * (edge->from + edge->to - 2.0 * first->from);
    total += length;
  }
  return total > 0.0 ? Eigen::Vector3d(first->from + sum / total) : first->from;
}

void addFan(WorkingFrame& frame, const Owner& owner, const PieceEdge* first, const PieceEdge* last,
            std::vector<OverlapFacet>& facets) {
  const Eigen::Vector3d apex = middleOf(first, last);
  const std::size_t begin = facets.size();
  bool leaves = false;
  for (const PieceEdge* edge = first; edge != last; ++edge) {
    const double height = (edge->from - apex).cross(edge->to - apex).dot(owner.normal);
    if (height == 0.0) continue;
    OverlapFacet facet = facetOf(owner);
    facet.corners_in_a = {frame.pointInA(apex), frame.pointInA(edge->from), frame.pointInA(edge->to)};
    facet.is_negative = height < 0.0;
    leaves = leaves || facet.is_negative;
    facets.push_back(facet);
  }
  for (std::size_t i = begin; i < facets.size(); ++i) facets[i].may_leave = leaves;
}

}  // namespace

void appendFacets(WorkingFrame& frame, const SurfacePieces (&pieces)[2], const BoundaryComponents& components,
                  const BoundaryComponent& region, std::vector<OverlapFacet>& facets) {
  const BoundaryComponent* part = &region;
  while (true) {
    for (const Side side : {Side::A, Side::B}) {
      const SurfacePieces& on_side = pieces[at(side)];
      forEachWholeTriangle(on_side, *part, side, [&](TriangleIndex triangle) {
        const Owner owner{side, triangle, frame.normal(side, triangle)};
        if (!owner.normal.isZero()) addWhole(frame, owner, facets);
      });
      forEachCutTriangle(on_side, *part, side,
                         [&](TriangleIndex triangle, std::uint32_t first, std::uint32_t last) {
                           const Owner owner{side, triangle, frame.normal(side, triangle)};
                           if (owner.normal.isZero()) return;
                           const PieceEdge* edges = on_side.edges().data();
                           addFan(frame, owner, edges + first, edges + last, facets);
                         });
    }
    if (part->next_cavity == kNone) return;
    part = &components.all()[part->next_cavity];
  }
}

}  // namespace concave_distance::detail
