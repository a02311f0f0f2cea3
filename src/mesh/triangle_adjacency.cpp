#include "concave_distance/mesh/triangle_adjacency.h"

#include <algorithm>
#include <numeric>

#include "union_find.h"

namespace concave_distance {
namespace {

struct Join {
  std::uint32_t of;
  AdjacentTriangle to;
};

bool hasCorner(const TriangleNodes& nodes, NodeIndex node) {
  return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}

void joinAcrossEdges(const SurfaceMesh& mesh, const MeshTopology& topology, std::vector<Join>& joins) {
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleNodes& nodes = mesh.triangles()[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeIndex from = nodes[k];
      const NodeIndex to = nodes[(k + 1) % 3];
      if (from == to) continue;
      for (const TriangleIndex other : topology.triangles_of_vertex.row(from.value)) {
        if (other.value != t && hasCorner(mesh.triangle(other), to)) joins.push_back({t, {other, from, to}});
      }
    }
  }
}

/// The triangles around a vertex in groups that are connected by edges at that vertex.
void joinOverVertices(const SurfaceMesh& mesh, const MeshTopology& topology, std::vector<Join>& joins) {
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    const auto fan = topology.triangles_of_vertex.row(v);
    detail::UnionFind groups(fan.size());
    for (std::uint32_t i = 0; i < fan.size(); ++i) {
      for (std::uint32_t j = 0; j < i; ++j) {
        const TriangleNodes& other = mesh.triangle(fan[j]);
        for (const NodeIndex node : mesh.triangle(fan[i])) {
          if (node.value != v && hasCorner(other, node)) groups.unite(i, j);
        }
      }
    }
    std::uint32_t last = 0;
    for (std::uint32_t i = 1; i < fan.size(); ++i) {
      if (groups.find(i) != i) continue;
      joins.push_back({fan[last].value, {fan[i], NodeIndex{v}, NodeIndex{v}}});
      joins.push_back({fan[i].value, {fan[last], NodeIndex{v}, NodeIndex{v}}});
      last = i;
    }
  }
}

}  // namespace

CompressedRows<AdjacentTriangle> triangleAdjacency(const SurfaceMesh& mesh, const MeshTopology& topology) {
  std::vector<Join> joins;
  joins.reserve(3 * mesh.triangleCount());
  joinAcrossEdges(mesh, topology, joins);
  joinOverVertices(mesh, topology, joins);
  CompressedRows<AdjacentTriangle> rows;
  rows.offsets.assign(mesh.triangleCount() + 1, 0);
  for (const Join& join : joins) ++rows.offsets[join.of + 1];
  std::partial_sum(rows.offsets.begin(), rows.offsets.end(), rows.offsets.begin());
  rows.values.resize(joins.size());
  std::vector<std::uint32_t> next(rows.offsets.begin(), rows.offsets.end() - 1);
  for (const Join& join : joins) rows.values[next[join.of]++] = join.to;
  return rows;
}

}  // namespace concave_distance
