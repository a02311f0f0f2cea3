#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "solid_facets.h"

namespace concave_distance {

/// A closed, bounded polyhedral set of points with exact arithmetic behind it: the results of hull,
/// difference and cuts are exact, whatever lies in one plane or touches along an edge. Behind it are CGAL's
/// Nef polyhedra, which, unlike Booleans of surfaces by corefinement, represent results that are no
/// 2-manifold, as concavities that touch along an edge are. Cheap to copy; operations allocate and take
/// milliseconds to minutes, O(n^2) at worst.
class ExactSolid {
 public:
  /// The inside of a closed surface: of shells that lie within others, cavities and islands.
  /// @throws Error (naming `where`) when the surface has borders, crosses itself or encloses nothing
  static ExactSolid fromMesh(const SurfaceMesh& mesh, const std::string& where);

  bool isEmpty() const;
  ExactSolid hull() const;
  ExactSolid minus(const ExactSolid& other) const;
  /// The parts that do not hang together through their insides.
  std::vector<ExactSolid> components() const;
  /// The part with normal . p <= offset, the plane exactly as given.
  ExactSolid below(const Eigen::Vector3d& normal, double offset) const;
  /// Convex parts by vertical walls through the reflex edges (Chazelle 1984, as CGAL has it): robust, and
  /// many.
  std::vector<ExactSolid> convexParts() const;
  SolidFacets facets() const;

  struct Implementation;
  explicit ExactSolid(std::shared_ptr<const Implementation> implementation);

 private:
  std::shared_ptr<const Implementation> implementation_;
};

}  // namespace concave_distance
