#include "hull_constraints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace concave_distance {
namespace {

bool liesOnPlane(const SolidFacets& hull, const SolidFacet& facet, const Eigen::Vector3d& normal,
                 double offset, double tolerance) {
  return std::all_of(facet.loops.begin(), facet.loops.end(), [&](const std::vector<std::uint32_t>& loop) {
    return std::all_of(loop.begin(), loop.end(), [&](std::uint32_t vertex) {
      return std::abs(normal.dot(hull.vertices[vertex]) + offset) <= tolerance;
    });
  });
}

bool meetsAny(const SolidFacets& hull, const SolidFacet& facet,
              const std::vector<LinearConstraint>& constraints, double tolerance) {
  return std::any_of(constraints.begin(), constraints.end(), [&](const LinearConstraint& constraint) {
    // Half a right angle: a facet beside a sharp edge, thinner than the tolerance, lies on its neighbour's
    // plane and is decided by nothing else; one that faces the other way is another wall.
    return constraint.normal.dot(facet.normal) < 0.0 &&
           liesOnPlane(hull, facet, constraint.normal, constraint.offset, tolerance);
  });
}

/// Satisfied by every vertex.
LinearConstraint supportingConstraint(const SolidFacets& hull, const SolidFacet& facet) {
  LinearConstraint constraint;
  constraint.normal = Eigen::Vector3d::Zero() - facet.normal;  // no negative zeros in files
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& vertex : hull.vertices) {
    least = std::min(least, constraint.normal.dot(vertex));
  }
  constraint.offset = -least;
  return constraint;
}

}  // namespace

std::vector<LinearConstraint> hullConstraints(const SolidFacets& hull,
                                              const std::vector<LinearConstraint>& ancestors,
                                              const std::vector<CutPlane>& cuts, double tolerance,
                                              double overlap) {
  std::vector<std::size_t> order(hull.facets.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> areas;
  for (const SolidFacet& facet : hull.facets) {
    areas.push_back(areaVector(hull, facet).norm());
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t l, std::size_t r) { return areas[l] > areas[r]; });
  std::vector<LinearConstraint> all;
  std::vector<LinearConstraint> own;
  for (const std::size_t index : order) {
    const SolidFacet& facet = hull.facets[index];
    if (meetsAny(hull, facet, all, tolerance)) {
      continue;
    }
    LinearConstraint constraint = supportingConstraint(hull, facet);
    all.push_back(constraint);
    if (meetsAny(hull, facet, ancestors, tolerance)) {
      continue;
    }
    const bool is_cut = std::any_of(cuts.begin(), cuts.end(), [&](const CutPlane& cut) {
      return liesOnPlane(hull, facet, cut.normal, -cut.offset, tolerance);
    });
    constraint.offset += is_cut ? overlap : 0.0;
    own.push_back(constraint);
  }
  return own;
}

}  // namespace concave_distance
