#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "concave_distance/contact/pressure_field.h"
#include "concave_distance/interference/interference.h"

namespace concave_distance {

/// One body's surface in a region of overlap, with the pressure on it.
struct PressedSurface {
  const OverlapFacet* first;  ///< of the region; those of the other body are left out
  const OverlapFacet* last;
  bool of_b;              ///< B's surface inside A, else A's inside B
  const BodyMesh& other;  ///< the body that it lies in
  Eigen::Isometry3d other_from_a;
  const PressureField& field;
};

struct PressurePoint {
  Eigen::Vector3d point_in_a;
  double pressure;  ///< Pa, a tenth of the way from the point to the middle of its triangle
};
using PressureTriangle = std::array<PressurePoint, 3>;

/// The surface cut into triangles so small that the pressure between their corners is nearly linear: about
/// `kPressureTriangles`, fewer where that is more than `most`.
/// @param lift metres that each triangle is moved out of its body; negative: out of the other body, and
///        turned over, to be seen from there
/// @return nothing when the facets alone are more than `most`
std::vector<PressureTriangle> pressureTriangles(const PressedSurface& surface, double lift, std::size_t most);
inline constexpr double kPressureTriangles = 1000.0;

}  // namespace concave_distance
