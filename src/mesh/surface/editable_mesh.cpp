#include "editable_mesh.h"

#include <cmath>

#include "base/number_text.h"
#include "concave_distance/base/error.h"

namespace concave_distance::detail {

EditableMesh::EditableMesh(const SurfaceMesh& mesh, std::vector<std::uint32_t> tags)
    : vertices_(mesh.vertices()), triangles_(mesh.triangles()), tags_(std::move(tags)) {
  const EdgeTable table = buildEdgeTable(triangles_);
  edge_of_ = table.edge_of_half_edge;
  next_.assign(edge_of_.size(), kNoHalfEdge);
  edges_.resize(table.edgeCount());
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const HalfEdge first = table.half_edges[table.first[e]];
    edges_[e] = {startOf(triangles_, first), endOf(triangles_, first), first};
    for (std::uint32_t i = table.first[e]; i + 1 < table.first[e + 1]; ++i) {
      next_[table.half_edges[i]] = table.half_edges[i + 1];
    }
  }
}

NodeIndex EditableMesh::split(std::size_t edge, const Eigen::Vector3d& position) {
  const NodeIndex a = edges_[edge].a;
  const NodeIndex b = edges_[edge].b;
  const NodeIndex m{vertices_.size()};
  vertices_.push_back(position);
  HalfEdge half_edge = edges_[edge].first;
  edges_[edge] = {a, m, kNoHalfEdge};
  const std::size_t other_half = addEdge(m, b);
  while (half_edge != kNoHalfEdge) {
    const HalfEdge following = next_[half_edge];
    const bool from_a = startOf(triangles_, half_edge) == a;
    splitTriangle(half_edge, m, from_a ? edge : other_half, from_a ? other_half : edge);
    half_edge = following;
  }
  return m;
}

NodeIndex EditableMesh::insert(std::uint32_t triangle, const Eigen::Vector3d& position) {
  const NodeIndex m{vertices_.size()};
  vertices_.push_back(position);
  const TriangleNodes corners = triangles_[triangle];
  const std::uint32_t edge_b_c = edge_of_[3 * triangle + 1];
  const std::uint32_t edge_c_a = edge_of_[3 * triangle + 2];
  detach(3 * triangle + 1);
  detach(3 * triangle + 2);
  triangles_[triangle] = {corners[0], corners[1], m};
  const std::uint32_t second = addTriangle({corners[1], corners[2], m}, tags_[triangle]);
  const std::uint32_t third = addTriangle({corners[2], corners[0], m}, tags_[triangle]);
  const std::size_t edge_a_m = addEdge(corners[0], m);
  const std::size_t edge_b_m = addEdge(corners[1], m);
  const std::size_t edge_c_m = addEdge(corners[2], m);
  attach(3 * triangle + 1, edge_b_m);
  attach(3 * triangle + 2, edge_a_m);
  attach(3 * second, edge_b_c);
  attach(3 * second + 1, edge_c_m);
  attach(3 * second + 2, edge_b_m);
  attach(3 * third, edge_c_a);
  attach(3 * third + 1, edge_a_m);
  attach(3 * third + 2, edge_c_m);
  return m;
}

void EditableMesh::flip(std::size_t edge) {
  // (a, b, c) and (b, a, d) become (a, d, c) and (d, b, c).
  const HalfEdge h = edges_[edge].first;
  const HalfEdge g = next_[h];
  const std::uint32_t t = h / 3;
  const std::uint32_t u = g / 3;
  const auto corner = [](HalfEdge from, std::uint32_t steps) {
    return from - from % 3 + (from % 3 + steps) % 3;
  };
  const NodeIndex a = startOf(triangles_, h);
  const NodeIndex b = startOf(triangles_, g);
  const NodeIndex c = startOf(triangles_, corner(h, 2));
  const NodeIndex d = startOf(triangles_, corner(g, 2));
  const std::uint32_t edge_b_c = edge_of_[corner(h, 1)];
  const std::uint32_t edge_c_a = edge_of_[corner(h, 2)];
  const std::uint32_t edge_a_d = edge_of_[corner(g, 1)];
  const std::uint32_t edge_d_b = edge_of_[corner(g, 2)];
  for (std::uint32_t k = 1; k < 3; ++k) {
    detach(corner(h, k));
    detach(corner(g, k));
  }
  triangles_[t] = {a, d, c};
  triangles_[u] = {d, b, c};
  edges_[edge] = {c, d, kNoHalfEdge};
  attach(3 * t, edge_a_d);
  attach(3 * t + 1, edge);
  attach(3 * t + 2, edge_c_a);
  attach(3 * u, edge_d_b);
  attach(3 * u + 1, edge_b_c);
  attach(3 * u + 2, edge);
}

std::size_t EditableMesh::addEdge(NodeIndex a, NodeIndex b) {
  edges_.push_back({a, b, kNoHalfEdge});
  return edges_.size() - 1;
}

std::uint32_t EditableMesh::addTriangle(const TriangleNodes& nodes, std::uint32_t tag) {
  triangles_.push_back(nodes);
  tags_.push_back(tag);
  edge_of_.resize(edge_of_.size() + 3);
  next_.resize(next_.size() + 3, kNoHalfEdge);
  return static_cast<std::uint32_t>(triangles_.size() - 1);
}

void EditableMesh::attach(HalfEdge half_edge, std::size_t edge) {
  edge_of_[half_edge] = static_cast<std::uint32_t>(edge);
  next_[half_edge] = edges_[edge].first;
  edges_[edge].first = half_edge;
}

void EditableMesh::detach(HalfEdge half_edge) {
  HalfEdge* link = &edges_[edge_of_[half_edge]].first;
  while (*link != half_edge) {
    link = &next_[*link];
  }
  *link = next_[half_edge];
}

/// Triangle (u, v, w) with its edge (u, v) in two becomes (u, m, w) and (m, v, w), same winding.
void EditableMesh::splitTriangle(HalfEdge half_edge, NodeIndex m, std::size_t edge_u_m,
                                 std::size_t edge_m_v) {
  const std::uint32_t t = half_edge / 3;
  const std::uint32_t k = half_edge % 3;
  const std::uint32_t k1 = (k + 1) % 3;
  const NodeIndex v = triangles_[t][k1];
  const NodeIndex w = triangles_[t][(k + 2) % 3];
  const std::uint32_t edge_v_w = edge_of_[3 * t + k1];
  detach(3 * t + k1);
  triangles_[t][k1] = m;
  const std::uint32_t added = addTriangle({m, v, w}, tags_[t]);
  const std::size_t edge_m_w = addEdge(m, w);
  attach(half_edge, edge_u_m);
  attach(3 * t + k1, edge_m_w);
  attach(3 * added, edge_m_v);
  attach(3 * added + 1, edge_v_w);
  attach(3 * added + 2, edge_m_w);
}

void checkRefinement(const SurfaceMesh& mesh, double max_edge_length) {
  if (!(max_edge_length > 0.0) || !std::isfinite(max_edge_length)) {
    TextStream seen;
    seen << "the largest edge length is " << max_edge_length;
    throw Error("refinement", seen.str(), "give a positive, finite length in metres");
  }
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleNodes& nodes = mesh.triangles()[t];
    if (nodes[0] == nodes[1] || nodes[1] == nodes[2] || nodes[2] == nodes[0]) {
      throw Error("refinement", "triangle " + std::to_string(t) + " has the same corner twice",
                  "repair the mesh first");
    }
  }
}

void throwTooManyNodes(double max_edge_length, std::size_t node_limit) {
  TextStream seen;
  seen << "a largest edge of " << max_edge_length << " m needs more than " << node_limit << " nodes";
  throw Error("refinement", seen.str(), "give a larger edge length");
}

void checkNodeLimit(const SurfaceMesh& mesh, double max_edge_length, std::size_t node_limit) {
  double twice_area = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const Eigen::Vector3d& a = mesh.corner(triangle, 0);
    twice_area += (mesh.corner(triangle, 1) - a).cross(mesh.corner(triangle, 2) - a).norm();
  }
  const double least_triangles =
      0.5 * twice_area / (0.25 * std::sqrt(3.0) * max_edge_length * max_edge_length);
  if (least_triangles > 4.0 * static_cast<double>(node_limit)) {
    throwTooManyNodes(max_edge_length, node_limit);
  }
}

}  // namespace concave_distance::detail
