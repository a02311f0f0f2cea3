#pragma once

#include <Eigen/Core>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// Closed, outward-oriented meshes of primitives, their boxes centred as URDF has them (cylinder, capsule and
/// cone along z). Round surfaces are inscribed: no point of the mesh lies outside the true solid, none of the
/// true surface is farther than `chord_error` (metres) from the mesh.
/// @throws Error (naming `where`) when a size or the chord error is not positive and finite
SurfaceMesh makeBox(const Eigen::Vector3d& size, const std::string& where = "box");
SurfaceMesh makeSphere(double radius, double chord_error, const std::string& where = "sphere");
SurfaceMesh makeCylinder(double radius, double length, double chord_error,
                         const std::string& where = "cylinder");
/// `length` is that of the cylindrical part.
SurfaceMesh makeCapsule(double radius, double length, double chord_error,
                        const std::string& where = "capsule");
/// The apex is at half of `length`, the base of this radius at minus that.
SurfaceMesh makeCone(double radius, double length, double chord_error, const std::string& where = "cone");

}  // namespace concave_distance
