#pragma once

#include <cstddef>
#include <string>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "convex_piece.h"

namespace concave_distance {

struct PartitionOptions {
  /// Edges with more than half a turn of material around them. Every one is cut through: pieces and time grow
  /// with their count, by its square at worst.
  std::size_t reflex_edge_limit = 1500;
};

/// What a partition cost, and what was partitioned.
struct PartitionReport {
  std::size_t reflex_edges = 0;
  std::size_t shells = 0;
  std::size_t dropped_slivers = 0;  ///< pieces thinner than doubles can say
  double seconds = 0.0;
};

struct PartitionedBody {
  ConvexPartition partition;
  PartitionReport report;
};

/// Cuts a closed surface into convex pieces with disjoint interiors, by vertical walls through its reflex
/// edges (Chazelle 1984, as Carretero, sec. 6.1.2; here CGAL's convex decomposition of a Nef polyhedron in
/// exact arithmetic). Corners are rounded to doubles at the end only. Several shells: the union of those that
/// turn outwards, less those that turn inwards.
/// @param mesh repaired, body frame, metres @param name of the body, also in errors
/// @throws Error when the surface is open, crosses itself or has more reflex edges than the limit
PartitionedBody partitionMesh(const SurfaceMesh& mesh, const std::string& name,
                              const PartitionOptions& options = {});

/// Edges of a closed surface with more than half a turn of material around them, by exact signs. O(n).
std::size_t countReflexEdges(const SurfaceMesh& mesh);

}  // namespace concave_distance
