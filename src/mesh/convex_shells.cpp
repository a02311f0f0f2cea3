#include "convex_shells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/union_find.h"
#include "mesh/surface/edge_table.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/hull_gap.h"

namespace concave_distance {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// A gap within this share of the diameter is rounding: that of a plane through three corners (64 units).
constexpr double kConvexGapShare = 0x1.0p-46;

/// Divides a surface into closed ones. Where two solids of one shell share an edge, those triangles go on
/// into each other that bend least without a dent: a part with another one is found not to be convex.
class Divider {
 public:
  explicit Divider(const BodyMesh& body)
      : surface_(body.surface()), topology_(body.topology()), parts_(surface_.triangleCount()) {}

  /// Returns the number of parts.
  std::uint32_t divide() {
    const detail::EdgeTable edges = detail::buildEdgeTable(surface_.triangles());
    for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
      around_.assign(edges.half_edges.begin() + edges.first[e],
                     edges.half_edges.begin() + edges.first[e + 1]);
      std::sort(around_.begin(), around_.end(), [this](HalfEdge l, HalfEdge r) {
        return shellOf(l) != shellOf(r) ? shellOf(l) < shellOf(r) : l < r;
      });
      for (auto first = around_.begin(); first != around_.end();) {
        const auto last =
            std::find_if(first, around_.end(), [&](HalfEdge h) { return shellOf(h) != shellOf(*first); });
        join(first, last);
        first = last;
      }
    }
    return number();
  }

  std::uint32_t partOf(std::uint32_t triangle) const { return part_of_triangle_[triangle]; }

 private:
  using HalfEdge = detail::HalfEdge;
  using Around = std::vector<HalfEdge>::iterator;

  std::uint32_t shellOf(HalfEdge h) const { return topology_.shell_of_triangle[h / 3]; }
  bool ascends(HalfEdge h) const {
    return detail::startOf(surface_.triangles(), h) < detail::endOf(surface_.triangles(), h);
  }
  void unite(HalfEdge l, HalfEdge r) { parts_.unite(l / 3, r / 3); }

  void join(Around first, Around last) {
    const Around middle = std::partition(first, last, [this](HalfEdge h) { return ascends(h); });
    if (last - first == 4 && middle - first == 2) {
      const bool is_crossed = std::min(bend(first[0], first[3]), bend(first[1], first[2])) <
                              std::min(bend(first[0], first[2]), bend(first[1], first[3]));
      unite(first[0], is_crossed ? first[3] : first[2]);
      unite(first[1], is_crossed ? first[2] : first[3]);
      return;
    }
    for (Around h = first; h != last; ++h) unite(*first, *h);
  }

  /// Returns how much the surface turns at an edge, radians, and much more where it turns inwards.
  double bend(HalfEdge l, HalfEdge r) const {
    constexpr double kDent = 100.0;
    const Eigen::Vector3d& from = surface_.vertex(detail::startOf(surface_.triangles(), l));
    const Eigen::Vector3d along = surface_.vertex(detail::endOf(surface_.triangles(), l)) - from;
    const Eigen::Vector3d& n0 = topology_.triangle_normals[l / 3];
    const Eigen::Vector3d& n1 = topology_.triangle_normals[r / 3];
    const double turn = std::atan2(n0.cross(n1).dot(along.stableNormalized()), n0.dot(n1));
    return turn < 0.0 ? kDent - turn : turn;
  }

  std::uint32_t number() {
    std::uint32_t count = 0;
    part_of_triangle_.assign(surface_.triangleCount(), kNone);
    std::vector<std::uint32_t> number_of_set(surface_.triangleCount(), kNone);
    for (std::uint32_t t = 0; t < surface_.triangleCount(); ++t) {
      std::uint32_t& number = number_of_set[parts_.find(t)];
      if (number == kNone) number = count++;
      part_of_triangle_[t] = number;
    }
    return count;
  }

  const SurfaceMesh& surface_;
  const MeshTopology& topology_;
  UnionFind parts_;
  std::vector<HalfEdge> around_;
  std::vector<std::uint32_t> part_of_triangle_;
};

ConvexShells::Shell shellOf(const BodyMesh& body, const Divider& divided, std::uint32_t part) {
  const SurfaceMesh& surface = body.surface();
  ConvexShells::Shell found;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  std::vector<std::uint32_t> vertex_of(surface.vertexCount(), kNone);
  for (std::uint32_t t = 0; t < surface.triangleCount(); ++t) {
    if (divided.partOf(t) != part) continue;
    TriangleNodes nodes = surface.triangle(TriangleIndex{t});
    for (NodeIndex& node : nodes) {
      std::uint32_t& vertex = vertex_of[node.value];
      if (vertex == kNone) {
        vertex = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(surface.vertex(node));
      }
      node = NodeIndex{vertex};
    }
    triangles.push_back(nodes);
    found.triangles.push_back(TriangleIndex{t});
  }
  found.centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vertex : vertices) found.centre += vertex;
  found.centre /= static_cast<double>(vertices.size());
  found.mesh = std::make_shared<const BodyMesh>(
      body.name(), SurfaceMesh(std::move(vertices), std::move(triangles), body.name()));
  return found;
}

}  // namespace

ConvexShells findConvexShells(const BodyMesh& body) {
  ConvexShells found;
  const MeshTopology& topology = body.topology();
  if (topology.shellCount() > kMostConvexShells || !topology.allShellsClosed()) return found;
  Divider divided(body);
  const std::uint32_t count = divided.divide();
  if (count > kMostConvexShells) return found;
  // Most bodies are one shell, and not convex: they need no copy to see it.
  if (count == 1 && !(body.hullGap().gap <= kConvexGapShare * body.diameter())) return found;
  for (std::uint32_t part = 0; part < count; ++part) {
    found.shells.push_back(shellOf(body, divided, part));
    const BodyMesh& mesh = *found.shells.back().mesh;
    if (!(mesh.hullGap().gap <= kConvexGapShare * mesh.diameter())) return {};
  }
  return found;
}

}  // namespace concave_distance
