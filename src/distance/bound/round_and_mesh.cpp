#include "round_and_mesh.h"

#include <algorithm>
#include <array>

#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/round_geometry.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance {
namespace {

using Eigen::Vector3d;

/// Depth first, the nearer box first.
class LowestSearch {
 public:
  LowestSearch(const RoundAndMesh& pair, const CertificateRequest& request, const RoundMinimum& best,
               CertificateCost& cost)
      : pair_(pair), request_(request), best_(best), least_skipped_(best.lowest.value), cost_(cost) {}

  void run() {
    std::array<Waiting, 96> stack;  // the builder keeps the depth below 80; one waiting child a level
    std::size_t waiting = 0;
    stack[waiting++] = bound(0);
    while (waiting > 0 && best_.lowest.value > 0.0) {
      const Waiting next = stack[--waiting];
      if (isSkipped(next.bound)) continue;
      if (request_.limit != nullptr && request_.limit->isOverNow()) {
        was_cut_ = true;
        for (++waiting; waiting > 0; --waiting) skip(stack[waiting - 1].bound);
        return;
      }
      const TriangleTree::Node& node = pair_.mesh.tree().nodes()[next.node];
      if (node.count == 0) {
        Waiting near = bound(next.node + 1);
        Waiting far = bound(node.first);
        if (far.bound < near.bound) std::swap(near, far);
        stack[waiting++] = far;
        stack[waiting++] = near;
      } else {
        lookAt(node);
      }
    }
  }

  LowestFound found() const { return {best_, std::min(least_skipped_, best_.lowest.value), was_cut_}; }

 private:
  struct Waiting {
    std::uint32_t node;
    double bound;
  };

  Waiting bound(std::uint32_t index) {
    ++cost_.box_bounds;
    const Eigen::AlignedBox3d& box = pair_.mesh.tree().nodes()[index].box;
    const Vector3d middle = pair_.inShape(box.center());
    const Vector3d out = pair_.shape_from_mesh.transpose() * detail::outwardDirection(pair_.shape, middle);
    return {index, detail::signedDistance(pair_.shape, middle) - 0.5 * out.cwiseAbs().dot(box.sizes())};
  }

  void skip(double bound) { least_skipped_ = std::min(least_skipped_, bound); }
  bool isSkipped(double bound) {
    const double best = best_.lowest.value;
    const double allowed = request_.toleranceAt(best);
    if (bound < best - allowed) return false;
    skip(bound);
    return true;
  }

  void lookAt(const TriangleTree::Node& leaf) {
    ++cost_.leaf_pairs;
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
      const TriangleIndex triangle = pair_.mesh.tree().order()[i];
      const TrianglePoints corners = pair_.triangleInShape(triangle);
      if (isSkipped(lowerBoundOnTriangle(pair_.shape, corners))) continue;
      ++cost_.triangle_pairs;
      const LowestPoint lowest = lowestOnTriangle(pair_.shape, corners);
      if (lowest.value < best_.lowest.value) best_ = {lowest, triangle};
    }
  }

  const RoundAndMesh& pair_;
  const CertificateRequest& request_;
  RoundMinimum best_;
  double least_skipped_;
  bool was_cut_ = false;
  CertificateCost& cost_;
};

/// Returns whether a point lies on a triangle but for roundings.
bool touches(const TrianglePoints& triangle, const Vector3d& point) {
  constexpr double kRoundings = 0x1.0p-42;
  const double size = (triangle[1] - triangle[0]).norm() + (triangle[2] - triangle[0]).norm() + point.norm();
  const double slack = kRoundings * size;
  return pointTriangleDistance(point, triangle).squared_distance <= slack * slack;
}

}  // namespace

RoundAndMesh::RoundAndMesh(const RoundShape& round, const BodyMesh& other,
                           const Eigen::Isometry3d& mesh_from_body)
    : shape(round), mesh(other) {
  const Eigen::Isometry3d mesh_from_shape = mesh_from_body * round.body_from_shape;
  shape_from_mesh = mesh_from_shape.linear().transpose();
  centre_in_mesh = mesh_from_shape.translation();
}

TrianglePoints RoundAndMesh::triangleInShape(TriangleIndex triangle) const {
  const SurfaceMesh& surface = mesh.surface();
  return {inShape(surface.corner(triangle, 0)), inShape(surface.corner(triangle, 1)),
          inShape(surface.corner(triangle, 2))};
}

RoundMinimum descendOnMesh(const RoundAndMesh& pair, TriangleIndex start) {
  RoundMinimum best{lowestOnTriangle(pair.shape, pair.triangleInShape(start)), start};
  for (bool moved = true; moved;) {
    moved = false;
    const TriangleNodes nodes = pair.mesh.surface().triangle(best.triangle);
    for (const NodeIndex node : nodes) {
      for (const TriangleIndex triangle : pair.mesh.topology().triangles_of_vertex.row(node.value)) {
        const TrianglePoints corners = pair.triangleInShape(triangle);
        if (!(lowerBoundOnTriangle(pair.shape, corners) < best.lowest.value)) continue;
        if (!touches(corners, best.lowest.point)) continue;
        const LowestPoint lowest = lowestOnTriangle(pair.shape, corners);
        if (!(lowest.value < best.lowest.value)) continue;
        best = {lowest, triangle};
        moved = true;
      }
    }
  }
  return best;
}

LowestFound findLowest(const RoundAndMesh& pair, const CertificateRequest& request, const RoundMinimum& best,
                       CertificateCost& cost) {
  LowestSearch search(pair, request, best, cost);
  search.run();
  return search.found();
}

std::optional<RoundMinimum> highestIfInside(const RoundAndMesh& pair) {
  const SurfaceMesh& surface = pair.mesh.surface();
  std::optional<RoundMinimum> highest;
  for (std::size_t v = 0; v < surface.vertexCount(); ++v) {
    const Vector3d point = pair.inShape(surface.vertices()[v]);
    const double value = detail::signedDistance(pair.shape, point);
    if (value >= 0.0) return std::nullopt;
    const CompressedRows<TriangleIndex>::Row around = pair.mesh.topology().triangles_of_vertex.row(v);
    if (!around.empty() && (!highest || value > highest->lowest.value)) highest = {{value, point}, around[0]};
  }
  return highest;
}

}  // namespace concave_distance
