#include "concave_distance/mesh/refine_mesh.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <sstream>

#include "concave_distance/base/error.h"
#include "edge_table.h"

namespace concave_distance {
namespace {

using detail::HalfEdge;

constexpr HalfEdge kNoHalfEdge = 0xffffffffU;

/// A mesh whose edges can be split. The half-edges along an edge form a linked list, so that an edge may have
/// any number of triangles.
class SplittableMesh {
 public:
  explicit SplittableMesh(const SurfaceMesh& mesh)
      : vertices_(mesh.vertices()), triangles_(mesh.triangles()), original_triangle_(mesh.triangleCount()) {
    const detail::EdgeTable table = detail::buildEdgeTable(triangles_);
    edge_of_ = table.edge_of_half_edge;
    next_.assign(edge_of_.size(), kNoHalfEdge);
    edges_.resize(table.edgeCount());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const HalfEdge first = table.half_edges[table.first[e]];
      edges_[e] = {detail::startOf(triangles_, first), detail::endOf(triangles_, first), first};
      for (std::uint32_t i = table.first[e]; i + 1 < table.first[e + 1]; ++i) {
        next_[table.half_edges[i]] = table.half_edges[i + 1];
      }
    }
    for (std::size_t t = 0; t < original_triangle_.size(); ++t) {
      original_triangle_[t] = TriangleIndex{t};
    }
  }

  std::size_t vertexCount() const { return vertices_.size(); }
  std::size_t edgeCount() const { return edges_.size(); }

  double squaredLength(std::size_t edge) const {
    return (vertices_[edges_[edge].a.value] - vertices_[edges_[edge].b.value]).squaredNorm();
  }

  /// Splits edge (a, b) at its middle m and every triangle along it. `edge` becomes (a, m); the new edges are
  /// the last ones: (m, b), then one to the opposite corner of each triangle.
  void split(std::size_t edge) {
    const NodeIndex a = edges_[edge].a;
    const NodeIndex b = edges_[edge].b;
    const NodeIndex m{vertices_.size()};
    vertices_.push_back(0.5 * (vertices_[a.value] + vertices_[b.value]));
    HalfEdge half_edge = edges_[edge].first;
    edges_[edge] = {a, m, kNoHalfEdge};
    const std::size_t other_half = addEdge(m, b);
    while (half_edge != kNoHalfEdge) {
      const HalfEdge following = next_[half_edge];
      splitTriangle(half_edge, m, detail::startOf(triangles_, half_edge) == a ? edge : other_half,
                    detail::startOf(triangles_, half_edge) == a ? other_half : edge);
      half_edge = following;
    }
  }

  RefinedMesh release() {
    return {SurfaceMesh(std::move(vertices_), std::move(triangles_), "refined mesh"),
            std::move(original_triangle_)};
  }

 private:
  struct Edge {
    NodeIndex a;
    NodeIndex b;
    HalfEdge first;  ///< head of the list of half-edges along it
  };

  std::size_t addEdge(NodeIndex a, NodeIndex b) {
    edges_.push_back({a, b, kNoHalfEdge});
    return edges_.size() - 1;
  }

  void attach(HalfEdge half_edge, std::size_t edge) {
    edge_of_[half_edge] = static_cast<std::uint32_t>(edge);
    next_[half_edge] = edges_[edge].first;
    edges_[edge].first = half_edge;
  }

  void detach(HalfEdge half_edge) {
    HalfEdge* link = &edges_[edge_of_[half_edge]].first;
    while (*link != half_edge) {
      link = &next_[*link];
    }
    *link = next_[half_edge];
  }

  /// Triangle (u, v, w) with its edge (u, v) in two becomes (u, m, w) and (m, v, w), same winding.
  void splitTriangle(HalfEdge half_edge, NodeIndex m, std::size_t edge_u_m, std::size_t edge_m_v) {
    const std::uint32_t t = half_edge / 3;
    const std::uint32_t k = half_edge % 3;
    const std::uint32_t k1 = (k + 1) % 3;
    const NodeIndex v = triangles_[t][k1];
    const NodeIndex w = triangles_[t][(k + 2) % 3];
    const auto added = static_cast<std::uint32_t>(triangles_.size());

    const std::uint32_t edge_v_w = edge_of_[3 * t + k1];
    detach(3 * t + k1);
    triangles_[t][k1] = m;
    triangles_.push_back({m, v, w});
    original_triangle_.push_back(original_triangle_[t]);
    edge_of_.resize(edge_of_.size() + 3);
    next_.resize(next_.size() + 3);

    const std::size_t edge_m_w = addEdge(m, w);
    attach(half_edge, edge_u_m);
    attach(3 * t + k1, edge_m_w);
    attach(3 * added, edge_m_v);
    attach(3 * added + 1, edge_v_w);
    attach(3 * added + 2, edge_m_w);
  }

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<TriangleNodes> triangles_;
  std::vector<TriangleIndex> original_triangle_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> edge_of_;  ///< per half-edge
  std::vector<HalfEdge> next_;          ///< per half-edge, the next one along the same edge
};

double totalArea(const SurfaceMesh& mesh) {
  double twice = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const Eigen::Vector3d& a = mesh.corner(triangle, 0);
    twice += (mesh.corner(triangle, 1) - a).cross(mesh.corner(triangle, 2) - a).norm();
  }
  return 0.5 * twice;
}

[[noreturn]] void throwTooManyNodes(double max_edge_length, std::size_t node_limit) {
  std::ostringstream seen;
  seen << "a largest edge of " << max_edge_length << " m needs more than " << node_limit << " nodes";
  throw Error("refinement", seen.str(), "give a larger edge length");
}

void checkArguments(const SurfaceMesh& mesh, double max_edge_length) {
  if (!(max_edge_length > 0.0) || !std::isfinite(max_edge_length)) {
    std::ostringstream seen;
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

}  // namespace

RefinedMesh refineToEdgeLength(const SurfaceMesh& mesh, double max_edge_length, std::size_t node_limit) {
  checkArguments(mesh, max_edge_length);
  // A triangle with no edge longer than h has at most the area of the equilateral one: a hopeless request is
  // refused before memory is spent on it. (A surface of T triangles has about T / 2 nodes.)
  const double least_triangles =
      totalArea(mesh) / (0.25 * std::sqrt(3.0) * max_edge_length * max_edge_length);
  if (least_triangles > 4.0 * static_cast<double>(node_limit)) {
    throwTooManyNodes(max_edge_length, node_limit);
  }

  // The longest edge of all is the longest of each of its triangles: taking edges in descending order is
  // Rivara's longest-edge bisection without its propagation path, and the mesh conforms after every split.
  struct Candidate {
    double squared_length;
    std::uint32_t edge;
    bool operator<(const Candidate& r) const {  // longest first, then the lowest number
      return squared_length != r.squared_length ? squared_length < r.squared_length : edge > r.edge;
    }
  };
  SplittableMesh splittable(mesh);
  const double squared_limit = max_edge_length * max_edge_length;
  std::vector<Candidate> initial;
  for (std::size_t e = 0; e < splittable.edgeCount(); ++e) {
    const double squared_length = splittable.squaredLength(e);
    if (squared_length > squared_limit) {
      initial.push_back({squared_length, static_cast<std::uint32_t>(e)});
    }
  }
  std::priority_queue<Candidate> candidates({}, std::move(initial));
  while (!candidates.empty()) {
    if (splittable.vertexCount() >= node_limit) {
      throwTooManyNodes(max_edge_length, node_limit);
    }
    const std::size_t edge = candidates.top().edge;
    candidates.pop();
    const auto consider = [&](std::size_t e) {
      const double squared_length = splittable.squaredLength(e);
      if (squared_length > squared_limit) {
        candidates.push({squared_length, static_cast<std::uint32_t>(e)});
      }
    };
    const std::size_t edges_before = splittable.edgeCount();
    splittable.split(edge);
    consider(edge);
    for (std::size_t e = edges_before; e < splittable.edgeCount(); ++e) {
      consider(e);
    }
  }
  return splittable.release();
}

}  // namespace concave_distance
