#pragma once

#include <Eigen/Core>
#include <string>

#include "concave_distance/mesh/surface/round_shape.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// Says what a rigid body weighs and how it resists turning.
struct MassProperties {
  double mass = 1.0;                                            ///< kg
  Eigen::Vector3d centre_in_body = Eigen::Vector3d::Zero();     ///< of mass, body frame, metres
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity() * 0.1;  ///< about the centre, body axes, kg m^2

  /// @throws Error naming the quantity, the value seen and what is allowed: a positive mass, a symmetric
  ///         positive tensor no principal moment of which exceeds the sum of the two others
  void validate(const std::string& where) const;
};

/// Computes those of the solid that a closed, outward surface encloses, filled evenly: exact integrals of the
/// polynomials over the tetrahedra that the triangles make with the middle of the bounding box (Mirtich 1996,
/// by another way of summing), with their signs, so that cavities count as holes. O(triangles).
/// @param density kg/m^3 @param where named in the error
/// @throws Error when the density or the volume is not positive
MassProperties massPropertiesOf(const SurfaceMesh& closed, double density, const std::string& where);

/// The same for a given mass, kg.
MassProperties massPropertiesOfMass(const SurfaceMesh& closed, double mass, const std::string& where);

/// Computes those of a round solid by closed forms. @throws Error when the density or mass is not positive
MassProperties massPropertiesOf(const RoundShape& shape, double density, const std::string& where);
MassProperties massPropertiesOfMass(const RoundShape& shape, double mass, const std::string& where);

}  // namespace concave_distance
