#include "triangle_adjacency.h"

#include <algorithm>

#include "base/union_find.h"
#include "edge_table.h"

namespace concave_distance {
namespace {

using detail::EdgeTable;
using detail::HalfEdge;

/// Triangles at one edge that are all next to each other; more of them make a ring. What shares the edge is
/// connected at the edge's level either way, but not with k (k - 1) steps.
constexpr std::uint32_t kLargestClique = 8;

struct Join {
  std::uint32_t of;
  AdjacentTriangle to;
};

void joinAcrossEdges(const SurfaceMesh& mesh, const EdgeTable& edges, std::vector<Join>& joins) {
  const std::vector<TriangleNodes>& triangles = mesh.triangles();
  // Each half-edge has here its place in the group of its edge.
  std::vector<std::uint32_t> places(edges.half_edges.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) places[edges.half_edges[i]] = i;
  for (HalfEdge h = 0; h < places.size(); ++h) {
    const NodeIndex from = detail::startOf(triangles, h);
    const NodeIndex to = detail::endOf(triangles, h);
    if (from == to) continue;
    const auto join = [&](std::uint32_t place) {
      const HalfEdge other = edges.half_edges[place];
      if (other / 3 != h / 3) joins.push_back({h / 3, {TriangleIndex{other / 3}, from, to}});
    };
    const std::uint32_t edge = edges.edge_of_half_edge[h];
    const std::uint32_t first = edges.first[edge];
    const std::uint32_t last = edges.first[edge + 1];
    if (last - first > kLargestClique) {
      join(places[h] + 1 < last ? places[h] + 1 : first);
    } else {
      for (std::uint32_t place = first; place < last; ++place) join(place);
    }
  }
}

/// Corner k of triangle t, numbered 3 t + k, in sets that edges at their vertex connect.
UnionFind cornerGroups(const std::vector<TriangleNodes>& triangles, const EdgeTable& edges) {
  UnionFind groups(edges.half_edges.size());
  const auto end_corner = [](HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; };
  for (std::size_t i = 1; i < edges.half_edges.size(); ++i) {
    const HalfEdge l = edges.half_edges[i - 1];
    const HalfEdge r = edges.half_edges[i];
    if (edges.edge_of_half_edge[l] != edges.edge_of_half_edge[r]) continue;
    const bool same_direction = detail::startOf(triangles, l) == detail::startOf(triangles, r);
    groups.unite(l, same_direction ? r : end_corner(r));
    groups.unite(end_corner(l), same_direction ? end_corner(r) : r);
  }
  return groups;
}

/// A chain over the first triangles of the groups that are connected by edges at the vertex.
void joinOverVertices(const SurfaceMesh& mesh, const MeshTopology& topology, const EdgeTable& edges,
                      std::vector<Join>& joins) {
  UnionFind groups = cornerGroups(mesh.triangles(), edges);
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    const NodeIndex vertex{v};
    const auto fan = topology.triangles_of_vertex.row(v);
    TriangleIndex last = fan.empty() ? kNoTriangle : fan[0];
    for (const TriangleIndex t : fan) {
      const TriangleNodes& nodes = mesh.triangle(t);
      const auto corner =
          static_cast<std::uint32_t>(std::find(nodes.begin(), nodes.end(), vertex) - nodes.begin());
      if (t == last || groups.find(3 * t.value + corner) != 3 * t.value + corner) continue;
      joins.push_back({last.value, {t, vertex, vertex}});
      joins.push_back({t.value, {last, vertex, vertex}});
      last = t;
    }
  }
}

}  // namespace

CompressedRows<AdjacentTriangle> triangleAdjacency(const SurfaceMesh& mesh, const MeshTopology& topology) {
  const EdgeTable edges = detail::buildEdgeTable(mesh.triangles());
  std::vector<Join> joins;
  joins.reserve(3 * mesh.triangleCount());
  joinAcrossEdges(mesh, edges, joins);
  joinOverVertices(mesh, topology, edges, joins);
  return compressedRows<AdjacentTriangle>(mesh.triangleCount(), [&](const auto& visit) {
    for (const Join& join : joins) visit(join.of, join.to);
  });
}

}  // namespace concave_distance
