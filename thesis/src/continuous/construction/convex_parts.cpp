#include "convex_parts.h"

#include <algorithm>
#include <iterator>

namespace concave_distance {
namespace {

/// The planes of a part's own facets that are no cuts yet: any of them may be a wall between parts.
void addFacetPlanes(const SolidFacets& part, std::vector<CutPlane>& cuts) {
  for (const SolidFacet& facet : part.facets) {
    cuts.push_back({facet.normal, facet.offset});
  }
}

bool isNothing(const SolidFacets& solid, double tolerance) {
  return solid.facets.empty() || volumeOf(solid) <= tolerance * tolerance * tolerance ||
         thicknessOf(solid) <= tolerance;
}

void divideByWalls(const ExactSolid& solid, double tolerance, ConvexParts& result) {
  result.used_vertical_walls = true;
  for (const ExactSolid& part : solid.convexParts()) {
    const SolidFacets facets = part.facets();
    if (!isNothing(facets, tolerance)) {
      addFacetPlanes(facets, result.cuts);
      result.parts.push_back(facets);
    }
  }
}

/// Reflex edges that bend by less than the tolerance leave nothing between a solid and its hull.
bool fillsItsHull(const ExactSolid& solid, const ExactSolid& hull, double tolerance) {
  const std::vector<ExactSolid> rest = hull.minus(solid).components();
  return std::all_of(rest.begin(), rest.end(),
                     [&](const ExactSolid& part) { return isNothing(part.facets(), tolerance); });
}

/// Both sides of the first plane that leaves something on each.
std::vector<ExactSolid> cutOnce(const ExactSolid& solid, const std::vector<CutPlane>& planes,
                                ConvexParts& result) {
  for (const CutPlane& plane : planes) {
    const ExactSolid below = solid.below(plane.normal, plane.offset);
    const ExactSolid above = solid.minus(below);
    if (below.isEmpty() || above.isEmpty()) {
      continue;
    }
    result.cuts.push_back(plane);
    std::vector<ExactSolid> sides = below.components();
    std::vector<ExactSolid> others = above.components();
    sides.insert(sides.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
    return sides;
  }
  return {};
}

}  // namespace

ConvexParts convexParts(const ExactSolid& solid, double tolerance, std::uint32_t cut_limit) {
  ConvexParts result;
  std::vector<ExactSolid> open{solid};
  while (!open.empty()) {
    const ExactSolid piece = std::move(open.back());
    open.pop_back();
    const SolidFacets facets = piece.facets();
    if (isNothing(facets, tolerance)) {
      continue;
    }
    if (isConvex(facets, tolerance)) {
      result.parts.push_back(facets);
      continue;
    }
    const std::vector<CutPlane> planes = cutPlanes(facets, tolerance);
    if (planes.empty()) {
      const ExactSolid hull = piece.hull();
      if (fillsItsHull(piece, hull, tolerance)) {
        result.parts.push_back(hull.facets());
        continue;
      }
    }
    std::vector<ExactSolid> sides;
    if (result.cuts.size() < cut_limit) {
      sides = cutOnce(piece, planes, result);
    }
    if (sides.empty()) {
      divideByWalls(piece, tolerance, result);
    }
    open.insert(open.end(), std::make_move_iterator(sides.begin()), std::make_move_iterator(sides.end()));
  }
  return result;
}

}  // namespace concave_distance
