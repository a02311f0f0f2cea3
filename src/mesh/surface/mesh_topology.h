#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compressed_rows.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// No triangle on the other side of an edge.
inline constexpr TriangleIndex kNoTriangle{0xffffffffU};

/// Says what touches what on a welded surface; O(triangles) to build and to store. Edge k of a triangle runs
/// from corner k to corner (k + 1) % 3.
struct MeshTopology {
  CompressedRows<TriangleIndex> triangles_of_vertex;
  CompressedRows<NodeIndex> neighbours_of_vertex;
  /// Each edge has here the triangle across it; kNoTriangle at a border, the first other one at a
  /// non-manifold edge.
  std::vector<std::array<TriangleIndex, 3>> triangle_across_edge;
  /// Triangles that bound one solid and are connected by edges, or sheets connected by edges or corners. A
  /// sheet attached to a solid, and solids that share an edge, are separate shells.
  std::vector<std::uint32_t> shell_of_triangle;
  std::vector<TriangleIndex> triangle_of_shell;  ///< the first of each
  /// Bounds a solid or a cavity: along each edge as many of the shell's triangles run one way as the other.
  /// The solid is where the closed shells' winding numbers add up to more than 0.
  std::vector<bool> shell_is_closed;
  std::vector<Eigen::Vector3d> triangle_normals;  ///< unit; zero for a triangle without area
  /// Angle-weighted sum of the incident normals, unit (Baerentzen and Aanaes 2005): its sign against the
  /// direction to a nearby point separates inside from outside.
  std::vector<Eigen::Vector3d> vertex_normals;

  std::size_t shellCount() const { return shell_is_closed.size(); }
  bool isOnClosedShell(TriangleIndex triangle) const {
    return shell_is_closed[shell_of_triangle[triangle.value]];
  }
  bool allShellsClosed() const;
};

MeshTopology buildMeshTopology(const SurfaceMesh& mesh);

}  // namespace concave_distance
