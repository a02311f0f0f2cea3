#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "solid_facets.h"
#include "thesis/src/continuous/constraint_tree.h"

namespace concave_distance {

/// A plane through which a piece was cut; its points satisfy normal . p = offset.
struct CutPlane {
  Eigen::Vector3d normal;  ///< unit
  double offset;
};

/// The constraints of a convex solid. Facets that an accepted constraint's plane meets within `tolerance` at
/// every corner add none (largest facets first); each plane is moved outwards until every vertex satisfies
/// it. Left out are those that an ancestor states already. Those in the plane of a cut are moved out by
/// `overlap`, so that parts of one piece leave no gap between them. All lengths in metres.
std::vector<LinearConstraint> hullConstraints(const SolidFacets& hull,
                                              const std::vector<LinearConstraint>& ancestors,
                                              const std::vector<CutPlane>& cuts, double tolerance,
                                              double overlap);

}  // namespace concave_distance
