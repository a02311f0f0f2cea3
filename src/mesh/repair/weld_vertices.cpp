#include "weld_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>

#include "mesh/surface/edge_table.h"
#include "mesh/surface/face_table.h"

namespace concave_distance::detail {
namespace {

WeldedVertices weldEqual(const std::vector<Eigen::Vector3d>& vertices) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto less = [&](std::uint32_t l, std::uint32_t r) {
    for (int k = 0; k < 3; ++k) {
      if (vertices[l][k] != vertices[r][k]) {
        return vertices[l][k] < vertices[r][k];
      }
    }
    return l < r;
  };
  std::sort(order.begin(), order.end(), less);
  std::vector<std::uint32_t> representative(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool equal = i > 0 && vertices[order[i]] == vertices[order[i - 1]];
    representative[order[i]] = equal ? representative[order[i - 1]] : order[i];
  }
  WeldedVertices welded;
  welded.node_of_vertex.resize(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (representative[v] == v) {
      welded.node_of_vertex[v] = NodeIndex{welded.vertices.size()};
      welded.vertices.push_back(vertices[v]);
    } else {
      welded.node_of_vertex[v] = welded.node_of_vertex[representative[v]];
    }
  }
  return welded;
}

struct Cell {
  std::array<std::int64_t, 3> index;
  friend bool operator==(const Cell& l, const Cell& r) { return l.index == r.index; }
};

struct CellHash {
  std::size_t operator()(const Cell& cell) const noexcept {
    std::uint64_t hash = 0;
    for (const std::int64_t i : cell.index) {
      hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 32U;
    }
    return hash;
  }
};

/// Representatives closer than a cell's width lie in one of the 27 cells around a vertex; a cell holds few,
/// since representatives keep the tolerance from each other.
WeldedVertices weldNear(const std::vector<Eigen::Vector3d>& vertices, double tolerance,
                        const Eigen::Vector3d& origin) {
  WeldedVertices welded;
  welded.node_of_vertex.reserve(vertices.size());
  std::unordered_map<Cell, std::vector<NodeIndex>, CellHash> cells;
  for (const Eigen::Vector3d& vertex : vertices) {
    Cell home{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      home.index[k] = static_cast<std::int64_t>(std::floor((vertex[axis] - origin[axis]) / tolerance));
    }
    double nearest = tolerance * tolerance;
    NodeIndex node{welded.vertices.size()};
    for (int i = 0; i < 27; ++i) {
      const auto found =
          cells.find({{home.index[0] + i % 3 - 1, home.index[1] + i / 3 % 3 - 1, home.index[2] + i / 9 - 1}});
      if (found == cells.end()) {
        continue;
      }
      for (const NodeIndex candidate : found->second) {
        const double squared_distance = (welded.vertices[candidate.value] - vertex).squaredNorm();
        if (squared_distance < nearest || (squared_distance == nearest && candidate < node)) {
          nearest = squared_distance;
          node = candidate;
        }
      }
    }
    if (node.value == welded.vertices.size()) {
      welded.vertices.push_back(vertex);
      cells[home].push_back(node);
    }
    welded.node_of_vertex.push_back(node);
  }
  return welded;
}

}  // namespace

WeldedVertices weldVertices(const std::vector<Eigen::Vector3d>& vertices, double tolerance) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : vertices) {
    box.extend(vertex);
  }
  // Below this no two different vertices are within the tolerance, and cell numbers would leave the range of
  // whole numbers.
  constexpr double kLeastFraction = 1e-17;
  if (vertices.empty() || !(tolerance > kLeastFraction * box.diagonal().norm())) {
    return weldEqual(vertices);
  }
  return weldNear(vertices, tolerance, box.min());
}

BorderWeld weldBorders(const std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles,
                       double tolerance) {
  const std::vector<TriangleNodes> faces = cornersOf(buildFaceTable(triangles));
  const EdgeTable edges = buildEdgeTable(faces);
  std::vector<bool> at_border(vertices.size(), false);
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    if (edges.first[e + 1] - edges.first[e] == 1) {
      const HalfEdge h = edges.half_edges[edges.first[e]];
      at_border[startOf(faces, h).value] = true;
      at_border[endOf(faces, h).value] = true;
    }
  }
  std::vector<NodeIndex> border;
  std::vector<Eigen::Vector3d> border_vertices;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (at_border[v]) {
      border.emplace_back(v);
      border_vertices.push_back(vertices[v]);
    }
  }
  const WeldedVertices welded = weldVertices(border_vertices, tolerance);
  std::vector<NodeIndex> first_of_group(welded.vertices.size());
  for (std::size_t i = border.size(); i-- > 0;) {
    first_of_group[welded.node_of_vertex[i].value] = border[i];
  }
  std::vector<NodeIndex> renumbered(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    renumbered[v] = NodeIndex{v};
  }
  BorderWeld result;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const NodeIndex node = first_of_group[welded.node_of_vertex[i].value];
    renumbered[border[i].value] = node;
    result.joined_vertices += node != border[i] ? 1U : 0U;
    result.farthest = std::max(result.farthest, (vertices[node.value] - border_vertices[i]).norm());
  }
  for (TriangleNodes& nodes : triangles) {
    for (NodeIndex& node : nodes) {
      node = renumbered[node.value];
    }
  }
  return result;
}

}  // namespace concave_distance::detail
