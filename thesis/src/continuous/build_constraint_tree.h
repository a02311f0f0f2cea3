#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "constraint_tree.h"

namespace concave_distance {

struct TreeBuildOptions {
  /// Share of the body's diagonal. Pieces thinner than this are left out, and facets that differ by less are
  /// one constraint: files of single precision bend plane faces by 1e-7. Larger values make coarser trees.
  double flatness_tolerance = 1e-6;
  /// A piece whose hull has this share or more of the volume of its parent's hull ends the recursion.
  double stagnation_share = 1.0 - 1e-6;
  std::uint32_t depth_limit = 12;  ///< deepest level, without sign
  /// Most cuts tried on one piece before CGAL's vertical walls divide the rest.
  std::uint32_t cut_limit = 200;
};

/// Where and why convex pieces stand for what the alternating recursion did not come to an end with.
struct TreeFallback {
  enum class Reason : std::uint8_t {
    Stagnation,  ///< the piece's hull was its parent's: hull minus piece would give the parent again, for
                 ///< ever
    DepthLimit
  };
  Reason reason;
  int level;                 ///< of the convex pieces
  std::uint32_t parts;       ///< convex pieces made
  bool used_vertical_walls;  ///< the cuts met their limit
};

struct TreeBuildReport {
  std::vector<TreeFallback> fallbacks;
  std::uint32_t dropped_pieces = 0;  ///< thinner than the tolerance
  double thickest_dropped = 0.0;     ///< metres
  std::string summary() const;       ///< one line for a log: pieces left out, fall-backs
};

struct BuiltTree {
  ConstraintTree tree;
  TreeBuildReport report;
};

/// Builds the tree of a closed surface (Carretero, sec. 2.1.1): hull; hull minus body, taken apart into its
/// components; each of these in the same way. The differences are exact (CGAL's Nef polyhedra over an exact
/// kernel), so that coplanar faces and concavities that touch along an edge do no harm; planes are then
/// rounded to doubles. The points inside the tree are those inside the surface, to flatness_tolerance times
/// the diagonal.
///
/// The recursion does not end for every solid (a groove around a cylinder: the hull of what stands in the
/// groove's hull is that hull again). It ends exactly where a piece's hull is its parent's hull, as otherwise
/// each step loses a vertex of the hull for good; then, and at the depth limit, the piece is cut into convex
/// parts, which become leaves, and the report says so. Cuts go through reflex edges, most of them at once
/// first.
///
/// Takes milliseconds for tens of facets and minutes for thousands. Only where the package was built with
/// CGAL.
/// @param where names the body in errors
/// @throws Error when the surface is open, crosses itself or encloses nothing, or an option is out of range
BuiltTree buildConstraintTree(const SurfaceMesh& mesh, const TreeBuildOptions& options,
                              const std::string& where);

}  // namespace concave_distance
