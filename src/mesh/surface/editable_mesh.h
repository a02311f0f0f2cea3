#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "edge_table.h"

namespace concave_distance::detail {

inline constexpr HalfEdge kNoHalfEdge = 0xffffffffU;

/// A mesh whose edges can be split and flipped and whose triangles carry a tag that their pieces inherit. The
/// half-edges along an edge form a linked list, so that an edge may have any number of triangles.
class EditableMesh {
 public:
  struct Edge {
    NodeIndex a;
    NodeIndex b;
    HalfEdge first = kNoHalfEdge;  ///< head of the list of half-edges along it
  };

  /// @param tags one for each triangle
  EditableMesh(const SurfaceMesh& mesh, std::vector<std::uint32_t> tags);

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<TriangleNodes>& triangles() const { return triangles_; }
  std::uint32_t tag(std::uint32_t triangle) const { return tags_[triangle]; }
  std::size_t edgeCount() const { return edges_.size(); }
  const Edge& edge(std::size_t edge) const { return edges_[edge]; }
  std::uint32_t edgeOf(HalfEdge half_edge) const { return edge_of_[half_edge]; }
  HalfEdge next(HalfEdge half_edge) const { return next_[half_edge]; }
  double squaredLength(std::size_t edge) const {
    return (vertices_[edges_[edge].a.value] - vertices_[edges_[edge].b.value]).squaredNorm();
  }

  /// Splits edge (a, b) at a new node m and every triangle along it. `edge` becomes (a, m); the new edges are
  /// the last ones: (m, b), then one to the opposite corner of each triangle. One new triangle, at the end,
  /// for each one split, in the order of the edge's list.
  NodeIndex split(std::size_t edge, const Eigen::Vector3d& position);

  /// Splits a triangle into three at a new node: itself and the two last ones; three new edges.
  NodeIndex insert(std::uint32_t triangle, const Eigen::Vector3d& position);

  /// Turns an edge of exactly two triangles, wound alike, into the other diagonal of their quadrilateral.
  void flip(std::size_t edge);

  std::vector<Eigen::Vector3d> releaseVertices() { return std::move(vertices_); }
  std::vector<TriangleNodes> releaseTriangles() { return std::move(triangles_); }
  std::vector<std::uint32_t> releaseTags() { return std::move(tags_); }

 private:
  std::size_t addEdge(NodeIndex a, NodeIndex b);
  std::uint32_t addTriangle(const TriangleNodes& nodes, std::uint32_t tag);
  void attach(HalfEdge half_edge, std::size_t edge);
  void detach(HalfEdge half_edge);
  void splitTriangle(HalfEdge half_edge, NodeIndex m, std::size_t edge_u_m, std::size_t edge_m_v);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<TriangleNodes> triangles_;
  std::vector<std::uint32_t> tags_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> edge_of_;  ///< per half-edge
  std::vector<HalfEdge> next_;          ///< per half-edge, the next one along the same edge
};

/// @throws Error for a length that is not positive and finite, or a triangle with the same corner twice
void checkRefinement(const SurfaceMesh& mesh, double max_edge_length);

[[noreturn]] void throwTooManyNodes(double max_edge_length, std::size_t node_limit);

/// Refuses a hopeless request before memory is spent on it: a triangle with no edge longer than h has at most
/// the area of the equilateral one, and a surface of T triangles about T / 2 nodes.
void checkNodeLimit(const SurfaceMesh& mesh, double max_edge_length, std::size_t node_limit);

}  // namespace concave_distance::detail
