#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "support/given_pose.h"

namespace concave_distance::test {

/// How two bodies lie to each other.
enum class Relation { Apart, Meeting, Swallowed };

/// A query that is hard for floating point.
struct NumericCase {
  std::string name;
  SurfaceMesh a;
  SurfaceMesh b;
  GivenPose b_in_a;
  Relation relation = Relation::Apart;
  /// The distance by construction, metres: a second opinion on the oracle.
  std::optional<double> closed_form = std::nullopt;
  bool coarse_grid = false;  ///< for the search: as little time as the case can be done in
};

inline void PrintTo(const NumericCase& numeric_case, std::ostream* out) {
  *out << numeric_case.name;
}

/// Parallel and coplanar faces, edge on edge, vertex on vertex, touching exactly, each at gaps from 1e-12 to
/// 1e3 body diameters.
std::vector<NumericCase> contactCases();
/// Needles, caps, zero area, duplicated vertices, one triangle, holes, shells, windings, denormal numbers.
std::vector<NumericCase> meshCases();
/// Far origins, tiny and huge bodies, rotations by 1e-9 and by pi, quaternions off the unit norm.
std::vector<NumericCase> poseCases();
/// Nested, swallowed and linked bodies, combs, pegs.
std::vector<NumericCase> concaveCases();

/// Shifted and not turned.
inline GivenPose at(double x, double y, double z) {
  return givenPose(Eigen::Quaterniond::Identity(), {x, y, z});
}

/// About an axis by an angle, as exact in double precision as a quaternion can say it.
inline Eigen::Quaterniond turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

}  // namespace concave_distance::test
