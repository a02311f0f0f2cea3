#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

/// The overlap of two closed surfaces by CGAL's Booleans (corefinement, Loriot et al.) with exact
/// constructions: what interference/ is held against. CGAL is in cgal_overlap.cpp alone.
namespace concave_distance::test {

struct OverlapPart {
  double volume;
  Eigen::Vector3d centroid;
};

struct OverlapTruth {
  bool known = false;  ///< false: the result would be no 2-manifold, which CGAL refuses
  double volume = 0.0;
  double area_a = 0.0;  ///< of A's surface inside B
  double area_b = 0.0;
  double surface = 0.0;            ///< of the overlap; area_a + area_b, and what lies in both surfaces
  std::vector<OverlapPart> parts;  ///< connected solids, largest first; cavities taken off
};

/// b already in A's frame. Meshes must bound volumes and not cross themselves.
OverlapTruth cgalOverlap(const SurfaceMesh& a, const SurfaceMesh& b_in_a);

/// The surface of the union of closed solids, corners rounded to double precision; empty where it would be no
/// 2-manifold.
std::optional<SurfaceMesh> cgalUnion(const std::vector<SurfaceMesh>& solids);

/// Closed solids, asked by CGAL's winding numbers with exact arithmetic.
class CgalSolids {
 public:
  explicit CgalSolids(const std::vector<SurfaceMesh>& solids);
  ~CgalSolids();
  /// Whether one of them holds the point.
  bool hold(const Eigen::Vector3d& point) const;

 private:
  struct Solid;
  std::vector<std::unique_ptr<Solid>> solids_;
};

}  // namespace concave_distance::test
