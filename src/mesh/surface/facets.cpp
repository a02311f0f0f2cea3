#include "facets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace concave_distance {
namespace {

using Eigen::Vector3d;

/// A corner may be off the other triangle's plane by this share of the diameter.
constexpr double kLevelHeight = 0x1.0p-49;
/// Longest edge squared over the height on it, in diameters: the plane of a longer needle is not known well
/// enough (rounding makes 2^-48 of the diameter of it).
constexpr double kLongestNeedle = 8.0;

class FacetJoiner {
 public:
  FacetJoiner(const SurfaceMesh& mesh, const MeshTopology& topology, const std::vector<bool>& hidden)
      : mesh_(mesh), topology_(topology), hidden_(hidden) {}

  Facets join() {
    const std::size_t count = mesh_.triangleCount();
    facets_.second.assign(count, kNoTriangle);
    facets_.facet_of_triangle.resize(count);
    facets_.nodes.resize(count);
    for (std::uint32_t t = 0; t < count; ++t) {
      const TriangleNodes& nodes = mesh_.triangle(TriangleIndex{t});
      facets_.facet_of_triangle[t] = TriangleIndex{t};
      facets_.nodes[t] = {nodes[0], nodes[1], nodes[2], nodes[0]};
    }
    is_joined_.assign(count, false);
    for (std::uint32_t t = 0; t < count; ++t) joinLongest(TriangleIndex{t});
    return std::move(facets_);
  }

 private:
  bool isFree(TriangleIndex t) const {
    return !is_joined_[t.value] && (hidden_.empty() || !hidden_[t.value]);
  }
  NodeIndex node(TriangleIndex t, std::size_t k) const { return mesh_.triangle(t)[k % 3]; }
  double doubleArea(TriangleIndex t) const {
    return (mesh_.corner(t, 1) - mesh_.corner(t, 0)).cross(mesh_.corner(t, 2) - mesh_.corner(t, 0)).norm();
  }

  /// Joins a triangle over the longest edge that will do: most often the diagonal of a rectangle.
  void joinLongest(TriangleIndex t) {
    if (!isFree(t)) return;
    std::array<std::size_t, 3> edges{0, 1, 2};
    const auto length = [&](std::size_t k) {
      return (mesh_.vertex(node(t, k + 1)) - mesh_.vertex(node(t, k))).squaredNorm();
    };
    std::sort(edges.begin(), edges.end(),
              [&](std::size_t l, std::size_t r) { return length(l) > length(r); });
    std::any_of(edges.begin(), edges.end(), [&](std::size_t k) { return joinOver(t, k); });
  }

  bool joinOver(TriangleIndex t, std::size_t k) {
    const TriangleIndex other = topology_.triangle_across_edge[t.value][k];
    if (other == kNoTriangle || other == t || !isFree(other) ||
        topology_.shell_of_triangle[t.value] != topology_.shell_of_triangle[other.value] ||
        countAt(node(t, k), node(t, k + 1)) != 2) {
      return false;
    }
    std::size_t across = 0;
    while (across < 3 && node(other, across) != node(t, k + 1)) ++across;
    if (across == 3 || node(other, across + 1) != node(t, k)) return false;  // wound the other way
    const bool t_is_first = doubleArea(t) >= doubleArea(other);
    return t_is_first ? join(t, k, other, across) : join(other, across, t, k);
  }

  std::size_t countAt(NodeIndex from, NodeIndex to) const {
    const auto fan = topology_.triangles_of_vertex.row(from.value);
    return static_cast<std::size_t>(std::count_if(fan.begin(), fan.end(), [&](TriangleIndex t) {
      const TriangleNodes& nodes = mesh_.triangle(t);
      return std::find(nodes.begin(), nodes.end(), to) != nodes.end();
    }));
  }

  /// Checks the edges that both have in common.
  bool join(TriangleIndex first, std::size_t edge, TriangleIndex second, std::size_t edge_of_second) {
    const std::array<NodeIndex, 4> nodes{node(first, edge + 1), node(first, edge + 2), node(first, edge),
                                         node(second, edge_of_second + 2)};
    if (!isFlatAndConvex(nodes)) return false;
    facets_.nodes[first.value] = nodes;
    facets_.second[first.value] = second;
    facets_.facet_of_triangle[second.value] = first;
    is_joined_[first.value] = is_joined_[second.value] = true;
    return true;
  }

  bool isFlatAndConvex(const std::array<NodeIndex, 4>& nodes) const {
    if (nodes[1] == nodes[3]) return false;
    std::array<Vector3d, 4> edges;
    for (std::size_t k = 0; k < 4; ++k) edges[k] = mesh_.vertex(nodes[(k + 1) % 4]) - mesh_.vertex(nodes[k]);
    const Vector3d diagonal = edges[0] + edges[1];
    const Vector3d normal = edges[0].cross(edges[1]);
    const double area = normal.norm();
    const double longest =
        std::sqrt(std::max({edges[0].squaredNorm(), edges[1].squaredNorm(), edges[2].squaredNorm(),
                            edges[3].squaredNorm(), diagonal.squaredNorm()}));
    if (!(longest * longest * longest <= kLongestNeedle * mesh_.diameter() * area)) return false;
    if (std::abs(normal.dot(edges[3])) > kLevelHeight * mesh_.diameter() * area) return false;
    const auto turns = [&](std::size_t k) { return edges[k].cross(edges[(k + 1) % 4]).dot(normal) > 0.0; };
    return turns(1) && turns(2) && turns(3);
  }

  const SurfaceMesh& mesh_;
  const MeshTopology& topology_;
  const std::vector<bool>& hidden_;
  Facets facets_;
  std::vector<bool> is_joined_;
};

}  // namespace

Facets joinFlatTriangles(const SurfaceMesh& mesh, const MeshTopology& topology,
                         const std::vector<bool>& hidden) {
  return FacetJoiner(mesh, topology, hidden).join();
}

CompressedRows<AdjacentTriangle> facetAdjacency(const Facets& facets,
                                                const CompressedRows<AdjacentTriangle>& adjacency) {
  const std::size_t count = facets.facet_of_triangle.size();
  return compressedRows<AdjacentTriangle>(count, [&](const auto& visit) {
    for (std::uint32_t t = 0; t < count; ++t) {
      const TriangleIndex facet = facets.facet_of_triangle[t];
      for (AdjacentTriangle next : adjacency.row(t)) {
        next.triangle = facets.facet_of_triangle[next.triangle.value];
        if (next.triangle != facet) visit(facet.value, next);
      }
    }
  });
}

}  // namespace concave_distance
