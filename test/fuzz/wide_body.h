#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "support/exact_triangle_distance.h"

namespace concave_distance::test {

using WidePoint = ExactVector<long double>;
using WideTriangle = ExactTriangle<long double>;

inline WidePoint widened(const Eigen::Vector3d& p) {
  return WidePoint(p);
}

/// One body as the enumeration of niches sees it: triangles in long double in the body's frame, and what
/// every two of them have in common. Looks at every pair of triangles; uses nothing of the package but the
/// container.
class WideBody {
 public:
  /// Triangles l and r meet in the hull of `points`: these triangles, segments and points cover it.
  struct Joint {
    std::uint32_t l;
    std::uint32_t r;
    std::vector<WideTriangle> shared;
  };

  explicit WideBody(const SurfaceMesh& mesh);

  const std::vector<WideTriangle>& triangles() const { return triangles_; }
  const std::vector<Joint>& shellContacts() const { return joints_; }
  /// False for a triangle with material of other shells on both sides.
  bool isSurface(std::size_t triangle) const { return is_surface_[triangle]; }
  bool isOnClosedShell(std::size_t triangle) const { return is_closed_[shell_of_[triangle]]; }
  /// Sum of the winding numbers of all closed shells around a point: material where it is above 0.
  long double winding(const WidePoint& point) const;
  /// How far a vertex lies above the plane of a triangle at most, metres: at most 0 for a convex solid.
  /// Infinite where a shell is open or there are several.
  long double highestOverPlane() const;
  long double diameter() const { return diameter_; }
  /// The largest magnitude of a coordinate.
  long double reach() const { return reach_; }

 private:
  void findShells(const SurfaceMesh& mesh);
  void findJoints(const SurfaceMesh& mesh);
  void findSurface();
  long double windingOf(std::uint32_t shell, const WidePoint& point) const;

  std::vector<WideTriangle> triangles_;
  std::vector<Joint> joints_;
  std::vector<std::uint32_t> shell_of_;
  std::vector<bool> is_closed_;  ///< of each shell
  std::vector<bool> is_surface_;
  long double diameter_ = 0.0L;
  long double reach_ = 0.0L;
};

inline long double length(const WidePoint& v) {
  return std::sqrt(v.squaredNorm());
}

}  // namespace concave_distance::test
