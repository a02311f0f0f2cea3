#pragma once

#include <cstddef>
#include <string>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// Single precision rounds a coordinate by up to 6e-8 of its size, so that one corner, written by two
/// triangles of an STL file, may come out as two: many files of real robots have such slits. This tolerance
/// closes them.
inline constexpr double kSinglePrecisionWeld = 2e-7;

struct RepairOptions {
  /// Equal vertices always become one. Beyond that, vertices of border edges (used by one triangle
  /// only) within this fraction of the bounding box's diagonal become one, and none moves farther. 0
  /// moves no vertex.
  double weld_tolerance = kSinglePrecisionWeld;
  bool orient = true;  ///< turn triangles so that neighbours agree, and closed shells outwards
};

/// Says what repairMesh found and changed; counts refer to the input unless they say otherwise.
struct RepairReport {
  std::size_t vertices_in = 0;
  std::size_t triangles_in = 0;
  std::size_t welded_vertices = 0;
  double largest_move = 0.0;  ///< of a vertex by welding, metres
  std::size_t unused_vertices = 0;
  std::size_t zero_area_triangles = 0;  ///< dropped
  std::size_t split_triangles = 0;      ///< at a corner of a zero-area triangle on their edge
  std::size_t duplicate_triangles = 0;  ///< dropped; same three vertices as others, either winding
  /// Dropped because two solids share them, so that they are not on the surface of the union.
  std::size_t inner_wall_triangles = 0;
  std::size_t turned_triangles = 0;
  std::size_t shells = 0;  ///< of the result, as the rest
  std::size_t closed_shells = 0;
  std::size_t holes = 0;  ///< loops of border edges, each followed along the rim of the triangles it bounds
  std::size_t border_edges = 0;
  std::size_t non_manifold_edges = 0;  ///< used by more than two triangles
  std::size_t inconsistent_edges = 0;  ///< two triangles in the same direction; left over by a Moebius strip
  /// One short line for a log: empty when nothing was found or changed.
  std::string summary() const;
};

struct RepairedMesh {
  SurfaceMesh mesh;
  RepairReport report;
};

/// Welds vertices, drops triangles without area and duplicates, and orients. Vertices move only by welding,
/// so distances between surfaces stay right. A zero-area triangle between a long edge and two short ones is
/// replaced by splitting the triangle at the long edge; a segment that no other triangle covers is lost.
/// O(n log n). @throws Error when nothing with an area is left (`where` names the file)
RepairedMesh repairMesh(const TriangleSoup& soup, const RepairOptions& options, const std::string& where);

/// Gives equal vertices one number and changes nothing else: triangles keep their order, winding and area or
/// lack of it. O(n log n). @throws Error as SurfaceMesh does (`where` names the file)
SurfaceMesh weldEqualVertices(const TriangleSoup& soup, const std::string& where);

}  // namespace concave_distance
