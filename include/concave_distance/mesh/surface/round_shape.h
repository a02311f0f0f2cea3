#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

enum class RoundKind : std::uint8_t { Sphere, Capsule, Cylinder };

/// A body that is one round primitive. Distances, regions of overlap and masses are those of this solid; the
/// body's mesh is inscribed in it and serves to search and to draw.
struct RoundShape {
  RoundKind kind = RoundKind::Sphere;
  double radius = 1.0;  ///< metres
  /// Half of the cylindrical part along the shape's z axis, metres; 0 for a sphere.
  double half_length = 0.0;
  Eigen::Isometry3d body_from_shape = Eigen::Isometry3d::Identity();
  double chord_error = 0.01;  ///< no point of the solid's surface is farther from the mesh, metres

  /// @throws Error (naming `where`) for lengths that are not positive or too long, for a pose that is not
  ///         rigid, for a sphere with a length
  void validate(const std::string& where) const;
};

/// The inscribed mesh, body frame, within `chord_error`. @throws Error as validate() and makeSphere()
SurfaceMesh inscribedMesh(const RoundShape& shape, const std::string& where);

/// Returns the box in the body frame.
Eigen::AlignedBox3d boundingBox(const RoundShape& shape);

double volumeOf(const RoundShape& shape);  ///< m^3

}  // namespace concave_distance
