#include "merge_flat_triangles.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <set>
#include <utility>

#include "mesh/surface/ear_clipping.h"
#include "mesh/surface/edge_table.h"
#include "mesh/surface/flat_patches.h"
#include "mesh/surface/plane_geometry.h"
#include "mesh/surface/vertex_fans.h"
#include "straight_chains.h"

namespace concave_distance {
namespace {

using namespace detail;

/// A patch may be this share of the tolerance to either side of its plane, and a node this far from the
/// segment that replaces it: the old and the new surface then lie within half of the tolerance of each other
/// across the plane, and within half along it (both ends of a segment that a node stays on may be off).
constexpr double kShare = 0.25;

/// Triangles within this fraction of the body's size of one plane are in it.
constexpr double kRounding = 1e-13;

class FlatMerger {
 public:
  FlatMerger(const SurfaceMesh& mesh, const FlatPatches& patches, double tolerance)
      : mesh_(mesh),
        patches_(patches),
        patched_(mesh, patches.patch_of_triangle),
        is_straight_(findStraightNodes(mesh, patched_, kShare * tolerance)),
        least_height_(1e3 * std::numeric_limits<double>::epsilon() * mesh.diameter()) {}

  SurfaceMesh run() {
    for (std::size_t node = 0; node < patched_.nodeCount(); ++node) {
      enqueue(NodeIndex{node});
    }
    while (!queue_.empty()) {
      const auto [degree, number] = queue_.top();
      queue_.pop();
      const NodeIndex node{number};
      if (degree > 0 && degree == patched_.degree(node)) tryToRemove(node);
    }
    return patched_.compacted(mesh_.vertices());
  }

 private:
  using Entry = std::pair<std::size_t, std::uint32_t>;
  using Edge = std::pair<NodeIndex, NodeIndex>;

  /// Holds what takes the place of the triangles around a node.
  struct Replacement {
    std::vector<std::pair<TriangleNodes, std::uint32_t>> triangles;  ///< with their patches
    std::set<Edge> edges;
  };

  void enqueue(NodeIndex node) { queue_.emplace(patched_.degree(node), node.value); }

  static Edge edgeOf(NodeIndex a, NodeIndex b) { return {std::min(a, b), std::max(a, b)}; }

  bool mayJoin(NodeIndex a, NodeIndex b, const Replacement& replacement) const {
    return patched_.trianglesAt(a, b) == 0 && replacement.edges.count(edgeOf(a, b)) == 0;
  }

  /// A fan of one triangle has both ends joined already: it is a sliver on the border that goes with its
  /// node, and the triangle behind it gets the new border.
  bool mayJoinEnds(NodeIndex a, NodeIndex b, const std::vector<VertexFan>& fans) const {
    const auto slivers = std::count_if(fans.begin(), fans.end(), isOneTriangle);
    return patched_.trianglesAt(a, b) == 2 * static_cast<std::size_t>(slivers);
  }

  static bool isOneTriangle(const VertexFan& fan) { return fan.triangles.size() == 1; }

  void tryToRemove(NodeIndex node) {
    const std::vector<VertexFan> fans = patched_.fansOf(node);
    const bool is_within = fans.size() == 1 && fans.front().is_closed;
    Replacement replacement;
    if (!is_within) {
      const auto [a, b] = commonEnds(node, fans);
      if (!is_straight_[node.value] || a == b || !mayJoinEnds(a, b, fans)) return;
    }
    for (const VertexFan& fan : fans) {
      if (!isFlat(node, fan) || !fill(fan, replacement)) return;
    }
    for (const VertexFan& fan : fans) {
      for (const std::uint32_t t : fan.triangles) patched_.remove(t);
    }
    for (const auto& [nodes, patch] : replacement.triangles) patched_.add(nodes, patch);
    for (const VertexFan& fan : fans) {
      for (const NodeIndex neighbour : fan.rim) enqueue(neighbour);
    }
  }

  Eigen::Vector2d project(std::uint32_t patch, NodeIndex node) const {
    return patches_.frames[patch].project(mesh_.vertex(node));
  }

  /// Whether the fan's triangles have an area and lie side by side, and the ends of an open one leave all of
  /// it on one side.
  bool isFlat(NodeIndex node, const VertexFan& fan) const {
    const Eigen::Vector2d centre = project(fan.patch, node);
    const Eigen::Vector2d first = project(fan.patch, fan.rim.front());
    const Eigen::Vector2d last = project(fan.patch, fan.rim.back());
    double angle = 0.0;
    for (std::size_t i = 0; i < fan.triangles.size(); ++i) {
      const Eigen::Vector2d a = project(fan.patch, fan.rim[i]) - centre;
      const Eigen::Vector2d b = project(fan.patch, fan.rim[(i + 1) % fan.rim.size()]) - centre;
      const double area = cross(a, b);
      if (!(area > least_height_ * std::max({a.norm(), b.norm(), (b - a).norm()}))) return false;
      angle += std::atan2(area, a.dot(b));
    }
    constexpr double kFullTurn = 6.3;  // radians, and no more than rounding
    if (fan.is_closed) return angle < kFullTurn;
    return std::all_of(fan.rim.begin() + 1, fan.rim.end() - 1, [&](NodeIndex between) {
      const Eigen::Vector2d along = (first - last).normalized();
      return cross(along, project(fan.patch, between) - last) > least_height_;
    });
  }

  /// Cuts the polygon that a fan leaves into triangles.
  bool fill(const VertexFan& fan, Replacement& replacement) const {
    const std::vector<NodeIndex>& rim = fan.rim;
    if (isOneTriangle(fan)) return true;
    if (rim.size() < 3) return false;
    std::vector<Eigen::Vector2d> polygon;
    for (const NodeIndex node : rim) {
      polygon.push_back(project(fan.patch, node));
    }
    const auto ears = clipEars(polygon, least_height_, [&](std::uint32_t i, std::uint32_t k) {
      return mayJoin(rim[i], rim[k], replacement);
    });
    if (ears.empty() || (rim.size() == 3 && patched_.hasTriangle({rim[0], rim[1], rim[2]}))) return false;
    for (const auto& [i, j, k] : ears) {
      replacement.triangles.push_back({{rim[i], rim[j], rim[k]}, fan.patch});
      replacement.edges.insert(edgeOf(rim[i], rim[k]));
    }
    return true;
  }

  const SurfaceMesh& mesh_;
  const FlatPatches& patches_;
  PatchedMesh patched_;
  std::vector<bool> is_straight_;  ///< by node
  double least_height_;
  // Vertices with few neighbours go first: the hole they leave is cut quickly, and then their neighbours have
  // fewer.
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

MergedMesh mergeFlatTriangles(const SurfaceMesh& mesh, double tolerance) {
  const EdgeTable edges = buildEdgeTable(mesh.triangles());
  const double flatness = kShare * tolerance;
  const double rounding = kRounding * mesh.diameter();
  FlatPatches patches = findFlatPatches(mesh, edges, std::min(rounding, flatness));
  if (flatness > rounding) patches = joinFlatPatches(mesh, edges, patches, flatness);
  MergedMesh merged;
  merged.mesh = FlatMerger(mesh, patches, tolerance).run();
  merged.flat_patches = patches.frames.size();
  return merged;
}

}  // namespace concave_distance
