#include "mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edge_table.h"
#include "resolve_shells.h"

namespace concave_distance {
namespace {

CompressedRows<TriangleIndex> trianglesOfVertices(const SurfaceMesh& mesh) {
  const auto names_before = [](const TriangleNodes& nodes, std::size_t k) {
    return (k > 0 && nodes[k] == nodes[0]) || (k > 1 && nodes[k] == nodes[1]);
  };
  return compressedRows<TriangleIndex>(mesh.vertexCount(), [&](const auto& visit) {
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const TriangleNodes& nodes = mesh.triangles()[t];
      for (std::size_t k = 0; k < 3; ++k) {
        if (!names_before(nodes, k)) visit(nodes[k].value, TriangleIndex{t});
      }
    }
  });
}

/// Ascending, because edges come in the order of their lower, then higher node. A triangle that names a
/// vertex twice has an edge from that vertex to itself; it leads to no neighbour.
CompressedRows<NodeIndex> neighboursOfVertices(const SurfaceMesh& mesh, const detail::EdgeTable& edges) {
  return compressedRows<NodeIndex>(mesh.vertexCount(), [&](const auto& visit) {
    for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
      const detail::HalfEdge first = edges.half_edges[edges.first[e]];
      const NodeIndex from = detail::startOf(mesh.triangles(), first);
      const NodeIndex to = detail::endOf(mesh.triangles(), first);
      if (from == to) continue;
      visit(std::min(from, to).value, std::max(from, to));
      visit(std::max(from, to).value, std::min(from, to));
    }
  });
}

/// The other triangle of the lowest number along each edge of each triangle.
std::vector<std::array<TriangleIndex, 3>> trianglesAcrossEdges(const SurfaceMesh& mesh,
                                                               const detail::EdgeTable& edges) {
  std::vector<std::array<TriangleIndex, 3>> across(mesh.triangleCount(),
                                                   {kNoTriangle, kNoTriangle, kNoTriangle});
  for (detail::HalfEdge h = 0; h < 3 * mesh.triangleCount(); ++h) {
    if (detail::startOf(mesh.triangles(), h) == detail::endOf(mesh.triangles(), h)) continue;
    const std::uint32_t edge = edges.edge_of_half_edge[h];
    for (std::uint32_t i = edges.first[edge]; i < edges.first[edge + 1]; ++i) {
      if (edges.half_edges[i] / 3 == h / 3) continue;
      across[h / 3][h % 3] = TriangleIndex{edges.half_edges[i] / 3};
      break;
    }
  }
  return across;
}

/// Takes the two shorter edges, whose cross product cancels least.
Eigen::Vector3d unitNormal(const SurfaceMesh& mesh, TriangleIndex t) {
  const Eigen::Vector3d e0 = mesh.corner(t, 1) - mesh.corner(t, 0);
  const Eigen::Vector3d e1 = mesh.corner(t, 2) - mesh.corner(t, 1);
  const Eigen::Vector3d e2 = mesh.corner(t, 0) - mesh.corner(t, 2);
  const double l0 = e0.squaredNorm();
  const double l1 = e1.squaredNorm();
  const double l2 = e2.squaredNorm();
  Eigen::Vector3d normal;
  if (l0 >= l1 && l0 >= l2) {
    normal = e1.cross(e2);
  } else if (l1 >= l2) {
    normal = e2.cross(e0);
  } else {
    normal = e0.cross(e1);
  }
  return normal.stableNormalized();
}

void collectNormals(const SurfaceMesh& mesh, MeshTopology& topology) {
  topology.triangle_normals.reserve(mesh.triangleCount());
  topology.vertex_normals.assign(mesh.vertexCount(), Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const Eigen::Vector3d normal = unitNormal(mesh, triangle);
    topology.triangle_normals.push_back(normal);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& at = mesh.corner(triangle, k);
      const Eigen::Vector3d out = mesh.corner(triangle, (k + 1) % 3) - at;
      const Eigen::Vector3d back = mesh.corner(triangle, (k + 2) % 3) - at;
      const double angle = std::atan2(out.cross(back).norm(), out.dot(back));
      topology.vertex_normals[mesh.triangle(triangle)[static_cast<std::size_t>(k)].value] += angle * normal;
    }
  }
  for (Eigen::Vector3d& normal : topology.vertex_normals) {
    normal.stableNormalize();
  }
}

}  // namespace

bool MeshTopology::allShellsClosed() const {
  return std::all_of(shell_is_closed.begin(), shell_is_closed.end(), [](bool closed) { return closed; });
}

MeshTopology buildMeshTopology(const SurfaceMesh& mesh) {
  MeshTopology topology;
  const detail::EdgeTable edges = detail::buildEdgeTable(mesh.triangles());
  topology.triangles_of_vertex = trianglesOfVertices(mesh);
  topology.neighbours_of_vertex = neighboursOfVertices(mesh, edges);
  topology.triangle_across_edge = trianglesAcrossEdges(mesh, edges);
  detail::ShellLabels shells = detail::labelShells(mesh.vertices(), mesh.triangles(), edges);
  topology.shell_of_triangle = std::move(shells.shell_of_triangle);
  topology.triangle_of_shell = std::move(shells.triangle_of_shell);
  topology.shell_is_closed = std::move(shells.shell_is_closed);
  collectNormals(mesh, topology);
  return topology;
}

}  // namespace concave_distance
