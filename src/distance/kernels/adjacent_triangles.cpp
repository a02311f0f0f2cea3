#include "adjacent_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "pair_frame.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

/// No code of Feature.
constexpr std::size_t kNoFeature = 99;

/// A list without repetitions: searched while it is short, marked by index when it is long.
template <typename Index>
class DistinctList {
 public:
  DistinctList(std::vector<Index>& list, std::vector<bool>& marks, std::size_t index_count)
      : list_(list), marks_(marks), index_count_(index_count) {
    list_.clear();
  }
  ~DistinctList() {
    if (!is_marked_) return;
    for (const Index i : list_) marks_[i.value] = false;
  }
  DistinctList(const DistinctList&) = delete;
  DistinctList& operator=(const DistinctList&) = delete;

  bool holds(Index i) const {
    return is_marked_ ? marks_[i.value] : std::find(list_.begin(), list_.end(), i) != list_.end();
  }

  void add(Index i) {
    if (!is_marked_ && list_.size() == kShort) mark();
    list_.push_back(i);
    if (is_marked_) marks_[i.value] = true;
  }

 private:
  static constexpr std::size_t kShort = 32;

  void mark() {
    if (marks_.size() < index_count_) marks_.resize(index_count_, false);
    for (const Index i : list_) marks_[i.value] = true;
    is_marked_ = true;
  }

  std::vector<Index>& list_;
  std::vector<bool>& marks_;
  std::size_t index_count_;
  bool is_marked_ = false;
};

using Ring = DistinctList<TriangleIndex>;

void addAround(const MeshTopology& topology, NodeIndex vertex, Ring& ring) {
  for (const TriangleIndex t : topology.triangles_of_vertex.row(vertex.value)) {
    if (!ring.holds(t)) ring.add(t);
  }
}

/// Every triangle at the edge, however many there are.
void addAcross(const SurfaceMesh& mesh, const MeshTopology& topology, NodeIndex from, NodeIndex to,
               Ring& ring) {
  for (const TriangleIndex t : topology.triangles_of_vertex.row(from.value)) {
    const TriangleNodes& nodes = mesh.triangle(t);
    if (std::find(nodes.begin(), nodes.end(), to) == nodes.end()) continue;
    if (!ring.holds(t)) ring.add(t);
  }
}

/// Returns whether a point lies on the line through two corners, given relative to it, within the tolerance.
bool isOnLine(const Vector3d& from, const Vector3d& to, double squared_tolerance) {
  const Vector3d edge = to - from;
  return from.cross(edge).squaredNorm() <= squared_tolerance * edge.squaredNorm();
}

}  // namespace

void collectRing(const LocalTriangle& own, const LocalWitness& witness, double on_feature,
                 RefinementWorkspace& workspace, std::size_t largest) {
  Ring ring(workspace.ring, workspace.ring_marks, own.mesh.triangleCount());
  DistinctList<NodeIndex> done(workspace.ring_vertices, workspace.vertex_marks, own.mesh.vertexCount());
  ring.add(own.triangle);
  const double squared_tolerance = on_feature * on_feature;
  std::array<NodeIndex, 2> crossed{};  // the edge crossed last: the triangles at it are all listed
  bool has_crossed = false;
  for (std::size_t i = 0; i < std::min(workspace.ring.size(), largest); ++i) {
    const TriangleNodes& nodes = own.mesh.triangle(workspace.ring[i]);
    const TrianglePoints corners = localCorners(own.mesh, workspace.ring[i], own.centre);
    const TrianglePoints away = {corners[0] - witness.point, corners[1] - witness.point,
                                 corners[2] - witness.point};
    const std::size_t code = i == 0 ? static_cast<std::size_t>(witness.feature) : kNoFeature;
    for (std::size_t k = 0; k < 3; ++k) {
      if ((code == k || away[k].squaredNorm() <= squared_tolerance) && !done.holds(nodes[k])) {
        done.add(nodes[k]);
        addAround(own.topology, nodes[k], ring);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeIndex from = nodes[k];
      const NodeIndex to = nodes[(k + 1) % 3];
      if (done.holds(from) || done.holds(to)) continue;  // its triangles are all listed already
      if (has_crossed && std::minmax(from, to) == std::minmax(crossed[0], crossed[1])) continue;
      if (code == k + 3 || isOnLine(away[k], away[(k + 1) % 3], squared_tolerance)) {
        addAcross(own.mesh, own.topology, from, to, ring);
        crossed = {from, to};
        has_crossed = true;
      }
    }
  }
}

RingLook findCloserNeighbour(const LocalTriangle& own, const LocalWitness& witness,
                             const RingTolerances& tolerances, RefinementWorkspace& workspace) {
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
