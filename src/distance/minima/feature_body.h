#pragma once

#include <algorithm>

#include "distance/kernels/pair_frame.h"
#include "mesh/trees/normal_cone_tree.h"

namespace concave_distance::detail {

/// Sine of the angle between edges below which the direction across them is not believed.
inline constexpr double kNearlyParallel = 1e-6;

/// Gives the vertices and edges of one body in its own axes, relative to its centre in the frame.
struct FeatureBody {
  using Item = NormalConeTree::Item;

  FeatureBody(const PairFrame& frame, Side of)
      : side(of),
        mesh(of == Side::A ? frame.a : frame.b),
        centre(of == Side::A ? frame.centre_a : frame.centre_b),
        frame(frame) {}

  Eigen::Vector3d vertex(NodeIndex node) const { return mesh.surface().vertex(node) - centre; }
  Eigen::Vector3d corner(const Item& item, std::size_t k) const {
    return mesh.surface().corner(item.triangle, static_cast<int>(k % 3)) - centre;
  }
  NodeIndex node(const Item& item, std::size_t k) const {
    return mesh.surface().triangle(item.triangle)[k % 3];
  }

  /// Returns an edge from its first to its second end, in the frame.
  Eigen::Vector3d edgeInFrame(const Item& item) const {
    const Eigen::Vector3d edge = mesh.surface().corner(item.triangle, (item.element + 1) % 3) -
                                 mesh.surface().corner(item.triangle, item.element);
    return side == Side::A ? edge : Eigen::Vector3d(frame.rotation * edge);
  }

  /// Returns a point of this body in the other's axes.
  Eigen::Vector3d inOther(const Eigen::Vector3d& point) const {
    return side == Side::A ? frame.pointInB(point) : Eigen::Vector3d(frame.rotation * point + frame.offset);
  }
  /// Returns a direction of the other body in this one's axes.
  Eigen::Vector3d directionFromOther(const Eigen::Vector3d& direction) const {
    return side == Side::A ? Eigen::Vector3d(frame.rotation * direction)
                           : Eigen::Vector3d(frame.rotation.transpose() * direction);
  }

  template <typename Visit>
  void forEachNeighbour(NodeIndex node, const Visit& visit) const {
    concave_distance::forEachNeighbour(mesh.surface(), mesh.topology(), mesh.shellContacts().hidden, node,
                                       visit);
  }

  /// Visits the third corner of each visible triangle at an edge.
  template <typename Visit>
  void forEachApex(NodeIndex from, NodeIndex to, const Visit& visit) const {
    for (const TriangleIndex triangle : mesh.topology().triangles_of_vertex.row(from.value)) {
      if (mesh.shellContacts().isHidden(triangle)) continue;
      const TriangleNodes& nodes = mesh.surface().triangle(triangle);
      if (std::find(nodes.begin(), nodes.end(), to) == nodes.end()) continue;
      for (const NodeIndex node : nodes) {
        if (node != from && node != to) visit(node);
      }
    }
  }

  /// Returns how far, at most, a neighbour of the vertex rises along `displacement`, per length of its edge.
  /// Rises within rounding do not count.
  double rise(NodeIndex node, const Eigen::Vector3d& displacement, double slack) const {
    const Eigen::Vector3d here = vertex(node);
    const double reach = displacement.norm();
    double most = 0.0;
    forEachNeighbour(node, [&](NodeIndex neighbour) {
      const Eigen::Vector3d edge = vertex(neighbour) - here;
      const double length = edge.norm();
      most = std::max(most, (displacement.dot(edge) - 2.0 * slack * std::max(length, reach)) / length);
    });
    return most;
  }

  Side side;
  const BodyMesh& mesh;
  const Eigen::Vector3d& centre;
  const PairFrame& frame;
};

}  // namespace concave_distance::detail
