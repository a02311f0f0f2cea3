#include "surface_ring.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "local_frames.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

/// No code of Feature.
constexpr std::size_t kNoFeature = 99;

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

/// Whether a point lies on the line through two corners, given relative to it, within the tolerance.
bool isOnLine(const Vector3d& from, const Vector3d& to, double squared_tolerance) {
  const Vector3d edge = to - from;
  return from.cross(edge).squaredNorm() <= squared_tolerance * edge.squaredNorm();
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
  const double squared_tolerance = on_feature * on_feature;
  std::array<NodeIndex, 2> crossed{};  // the edge crossed last: the triangles at it are all listed
  bool has_crossed = false;
  for (std::size_t i = 0; i < workspace.ring.size(); ++i) {
    const TriangleNodes& nodes = own.mesh.triangle(workspace.ring[i]);
    const TrianglePoints corners = localCorners(own.mesh, workspace.ring[i], own.centre);
    const TrianglePoints away = {corners[0] - witness.point, corners[1] - witness.point,
                                 corners[2] - witness.point};
    const std::size_t code = i == 0 ? static_cast<std::size_t>(witness.feature) : kNoFeature;
    for (std::size_t k = 0; k < 3; ++k) {
      if ((code == k || away[k].squaredNorm() <= squared_tolerance) && !is_done(nodes[k])) {
        workspace.ring_vertices.push_back(nodes[k]);
        addAround(own.topology, nodes[k], workspace);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeIndex from = nodes[k];
      const NodeIndex to = nodes[(k + 1) % 3];
      if (is_done(from) || is_done(to)) continue;  // its triangles are all listed already
      if (has_crossed && std::minmax(from, to) == std::minmax(crossed[0], crossed[1])) continue;
      if (code == k + 3 || isOnLine(away[k], away[(k + 1) % 3], squared_tolerance)) {
        addAcross(own.mesh, own.topology, from, to, workspace);
        crossed = {from, to};
        has_crossed = true;
      }
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
