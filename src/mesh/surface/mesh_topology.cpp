#include "mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "resolve_shells.h"

namespace concave_distance {
namespace {

/// One side of a triangle, keyed by its two ends whatever the direction.
struct EdgeUse {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t triangle;
  std::uint8_t edge;
  bool ascending;  ///< runs from low to high
};

/// A triangle that names a vertex twice has an edge from that vertex to itself; it borders nothing.
std::vector<EdgeUse> collectEdges(const SurfaceMesh& mesh) {
  std::vector<EdgeUse> edges;
  edges.reserve(3 * mesh.triangleCount());
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleNodes& nodes = mesh.triangles()[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = nodes[k].value;
      const std::uint32_t to = nodes[(k + 1) % 3].value;
      if (from == to) continue;
      edges.push_back({std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(t),
                       static_cast<std::uint8_t>(k), from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const EdgeUse& l, const EdgeUse& r) {
    if (l.low != r.low) return l.low < r.low;
    if (l.high != r.high) return l.high < r.high;
    return l.triangle < r.triangle;
  });
  return edges;
}

template <typename Visit>
void forEachEdge(const std::vector<EdgeUse>& edges, Visit visit) {
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && edges[last].low == edges[first].low &&
           edges[last].high == edges[first].high) {
      ++last;
    }
    visit(first, last);
    first = last;
  }
}

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

CompressedRows<NodeIndex> neighboursOfVertices(const std::vector<EdgeUse>& edges, std::size_t vertex_count) {
  CompressedRows<NodeIndex> rows = compressedRows<NodeIndex>(vertex_count, [&](const auto& visit) {
    forEachEdge(edges, [&](std::size_t first, std::size_t) {
      const EdgeUse& edge = edges[first];
      visit(edge.low, NodeIndex{edge.high});
      visit(edge.high, NodeIndex{edge.low});
    });
  });
  for (std::size_t v = 0; v < vertex_count; ++v) {
    std::sort(rows.values.begin() + rows.offsets[v], rows.values.begin() + rows.offsets[v + 1]);
  }
  return rows;
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
  const std::vector<EdgeUse> edges = collectEdges(mesh);
  topology.triangles_of_vertex = trianglesOfVertices(mesh);
  topology.neighbours_of_vertex = neighboursOfVertices(edges, mesh.vertexCount());
  topology.triangle_across_edge.assign(mesh.triangleCount(), {kNoTriangle, kNoTriangle, kNoTriangle});
  forEachEdge(edges, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t j = first; j < last; ++j) {
        if (edges[j].triangle == edges[i].triangle) continue;
        topology.triangle_across_edge[edges[i].triangle][edges[i].edge] = TriangleIndex{edges[j].triangle};
        break;
      }
    }
  });
  detail::ShellLabels shells = detail::labelShells(mesh.vertices(), mesh.triangles());
  topology.shell_of_triangle = std::move(shells.shell_of_triangle);
  topology.triangle_of_shell = std::move(shells.triangle_of_shell);
  topology.shell_is_closed = std::move(shells.shell_is_closed);
  collectNormals(mesh, topology);
  return topology;
}

}  // namespace concave_distance
