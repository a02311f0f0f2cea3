#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface/connected_pieces.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/triangle_adjacency.h"
#include "triangle_tree.h"

namespace concave_distance {

/// A body is the union of its closed shells: where surfaces meet, those of two shells or two parts of one, a
/// path goes over from one to the other, and what lies in the material of another shell is no surface.
struct ShellContacts {
  /// Two triangles and the ends of a straight part of what they have in common besides shared corners and
  /// edges; the same point twice where they touch in one.
  struct Joint {
    TriangleIndex first;
    TriangleIndex second;
    Eigen::Vector3d from;
    Eigen::Vector3d to;
  };
  std::vector<Joint> joints;
  std::vector<bool> hidden;  ///< by triangle; empty when none is

  bool isEmpty() const { return joints.empty() && hidden.empty(); }
  bool isHidden(TriangleIndex t) const { return !hidden.empty() && hidden[t.value]; }
};

/// Calls visit(vertex) for those that triangles in sight have in common with `vertex`, some of them twice.
template <typename Visit>
void forEachNeighbour(const SurfaceMesh& mesh, const MeshTopology& topology, const std::vector<bool>& hidden,
                      NodeIndex vertex, const Visit& visit) {
  if (hidden.empty()) {
    for (const NodeIndex neighbour : topology.neighbours_of_vertex.row(vertex.value)) visit(neighbour);
    return;
  }
  for (const TriangleIndex t : topology.triangles_of_vertex.row(vertex.value)) {
    if (hidden[t.value]) continue;
    for (const NodeIndex node : mesh.triangle(t)) {
      if (node != vertex) visit(node);
    }
  }
}

/// Joins shells: what is nearer than 1e-9 of the diameter touches. Hidden are triangles that meet no other
/// shell and lie in one's material; those that another shell crosses count whole. O(n log n) and the pairs
/// that meet.
ShellContacts findShellContacts(const SurfaceMesh& mesh, const MeshTopology& topology,
                                const TriangleTree& tree);

/// Returns whether a point of a triangle's shell lies in the material of another shell.
bool isInsideOtherShell(const SurfaceMesh& mesh, const MeshTopology& topology, const TriangleTree& tree,
                        TriangleIndex triangle, const Eigen::Vector3d& point);

/// Adds the joints to triangles next to each other, and takes hidden triangles out. The ends of joint j are
/// numbered like vertices, mesh.vertexCount() + 2 j and the next, or twice the first where it is a point.
CompressedRows<AdjacentTriangle> joinedAdjacency(const SurfaceMesh& mesh, const ShellContacts& joints,
                                                 const CompressedRows<AdjacentTriangle>& adjacency);

/// Makes pieces that are joined one.
void joinPieces(const ShellContacts& joints, ConnectedPieces& pieces);

}  // namespace concave_distance
