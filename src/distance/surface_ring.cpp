#include "surface_ring.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "local_frames.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

bool isListed(const std::vector<TriangleIndex>& list, std::size_t count, TriangleIndex t) {
  const auto last = list.begin() + static_cast<std::ptrdiff_t>(count);
  return std::find(list.begin(), last, t) != last;
}

void addAround(const MeshTopology& topology, NodeIndex vertex, RefinementWorkspace& workspace) {
  const std::size_t known = workspace.ring.size();  // a row names no triangle twice
  for (const TriangleIndex t : topology.triangles_of_vertex.row(vertex.value)) {
    if (!isListed(workspace.ring, known, t)) workspace.ring.push_back(t);
  }
}

/// Every triangle at the edge, however many there are.
void addAcross(const SurfaceMesh& mesh, const MeshTopology& topology, NodeIndex from, NodeIndex to,
               RefinementWorkspace& workspace) {
  for (const TriangleIndex t : topology.triangles_of_vertex.row(from.value)) {
    const TriangleNodes& nodes = mesh.triangle(t);
    if (std::find(nodes.begin(), nodes.end(), to) == nodes.end()) continue;
    if (!isListed(workspace.ring, workspace.ring.size(), t)) workspace.ring.push_back(t);
  }
}

/// Which corners and edges of a triangle a point lies on, by its feature code or within the tolerance.
struct Contact {
  std::array<bool, 3> corner{};
  std::array<bool, 3> edge{};
};

Contact contactOf(const TrianglePoints& corners, const Vector3d& point, double tolerance) {
  Contact contact;
  const double squared = tolerance * tolerance;
  const std::array<Vector3d, 3> from_point = {corners[0] - point, corners[1] - point, corners[2] - point};
  for (std::size_t k = 0; k < 3; ++k) {
    contact.corner[k] = from_point[k].squaredNorm() <= squared;
    const Vector3d edge = corners[(k + 1) % 3] - corners[k];
    contact.edge[k] = from_point[k].cross(edge).squaredNorm() <= squared * edge.squaredNorm();
  }
  return contact;
}

}  // namespace

void collectRing(const LocalTriangle& own, const LocalWitness& witness, double on_feature,
                 RefinementWorkspace& workspace) {
  workspace.ring.clear();
  workspace.ring_vertices.clear();
  workspace.ring.push_back(own.triangle);
  const auto is_done = [&](NodeIndex vertex) {
    const std::vector<NodeIndex>& done = workspace.ring_vertices;
    return std::find(done.begin(), done.end(), vertex) != done.end();
  };
  for (std::size_t i = 0; i < workspace.ring.size(); ++i) {
    const TriangleNodes& nodes = own.mesh.triangle(workspace.ring[i]);
    Contact contact =
        contactOf(localCorners(own.mesh, workspace.ring[i], own.centre), witness.point, on_feature);
    if (i == 0) {
      const auto code = static_cast<std::size_t>(witness.feature);
      if (code < 3) contact.corner[code] = true;
      if (code >= 3 && code < 6) contact.edge[code - 3] = true;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (!contact.corner[k] || is_done(nodes[k])) continue;
      workspace.ring_vertices.push_back(nodes[k]);
      addAround(own.topology, nodes[k], workspace);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeIndex to = nodes[(k + 1) % 3];
      if (!contact.edge[k] || is_done(nodes[k]) || is_done(to)) continue;  // those are all listed already
      addAcross(own.mesh, own.topology, nodes[k], to, workspace);
    }
  }
}

RingLook lookAround(const LocalTriangle& own, const LocalWitness& witness, const RingTolerances& tolerances,
                    RefinementWorkspace& workspace) {
  collectRing(own, witness, tolerances.on_feature, workspace);
  RingLook look{own.triangle, static_cast<std::uint32_t>(workspace.ring.size())};
  const Vector3d other = witness.point + witness.to_other;
  double least = witness.to_other.squaredNorm();
  for (std::size_t i = 1; i < workspace.ring.size(); ++i) {
    const TrianglePoints corners = localCorners(own.mesh, workspace.ring[i], own.centre);
    const bool reaches_beyond = std::any_of(corners.begin(), corners.end(), [&](const Vector3d& corner) {
      return witness.to_other.dot(corner - witness.point) > tolerances.first_order;
    });
    if (!reaches_beyond) continue;
    const double squared_distance = pointTriangleDistance(other, corners).squared_distance;
    if (squared_distance < least) {
      least = squared_distance;
      look.triangle = workspace.ring[i];
    }
  }
  return look;
}

}  // namespace concave_distance::detail
