#include "vertex_fans.h"

#include <algorithm>
#include <utility>

namespace concave_distance::detail {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

/// One triangle at a node: the rim goes from `start` to `end`.
struct Blade {
  NodeIndex start;
  NodeIndex end;
  std::uint32_t triangle;
  std::uint32_t patch;
};

/// The triangles at one node, to be followed around it.
class Wheel {
 public:
  void add(const Blade& blade) { blades_.push_back(blade); }

  void sort() {
    for (std::uint32_t i = 0; i < blades_.size(); ++i) {
      by_start_.emplace_back(blades_[i].start.value, i);
      by_end_.emplace_back(blades_[i].end.value, i);
    }
    std::sort(by_start_.begin(), by_start_.end());
    std::sort(by_end_.begin(), by_end_.end());
  }

  std::vector<VertexFan> fans() const {
    std::vector<VertexFan> fans;
    std::vector<bool> is_taken(blades_.size(), false);
    // Open fans begin where nothing comes before; what is left then goes all the way around.
    for (const bool is_closed : {false, true}) {
      for (std::uint32_t i = 0; i < blades_.size(); ++i) {
        if (!is_taken[i] && (is_closed || before(i) == kNone)) fans.push_back(follow(i, is_closed, is_taken));
      }
    }
    return fans;
  }

 private:
  using Rows = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  /// The only blade with this key, or none.
  static std::uint32_t only(const Rows& rows, NodeIndex node) {
    const auto found = std::lower_bound(rows.begin(), rows.end(), std::pair(node.value, 0U));
    if (found == rows.end() || found->first != node.value) return kNone;
    const auto next = found + 1;
    return next != rows.end() && next->first == node.value ? kNone : found->second;
  }

  /// The blade across an edge between the node and one of its neighbours, where the patch goes on.
  std::uint32_t across(std::uint32_t i, NodeIndex neighbour, bool is_forward) const {
    const std::uint32_t ahead = only(by_start_, neighbour);
    const std::uint32_t behind = only(by_end_, neighbour);
    if (ahead == kNone || behind == kNone || blades_[ahead].patch != blades_[behind].patch) return kNone;
    const std::uint32_t other = is_forward ? ahead : behind;
    return other == i ? kNone : other;
  }

  std::uint32_t before(std::uint32_t i) const { return across(i, blades_[i].start, false); }

  VertexFan follow(std::uint32_t first, bool is_closed, std::vector<bool>& is_taken) const {
    VertexFan fan;
    fan.patch = blades_[first].patch;
    fan.is_closed = is_closed;
    fan.rim.push_back(blades_[first].start);
    for (std::uint32_t i = first; i != kNone && !is_taken[i]; i = across(i, blades_[i].end, true)) {
      is_taken[i] = true;
      fan.triangles.push_back(blades_[i].triangle);
      fan.rim.push_back(blades_[i].end);
    }
    if (is_closed) fan.rim.pop_back();
    return fan;
  }

  std::vector<Blade> blades_;
  Rows by_start_;
  Rows by_end_;
};

}  // namespace

PatchedMesh::PatchedMesh(const SurfaceMesh& mesh, std::vector<std::uint32_t> patch_of_triangle)
    : triangles_of_node_(mesh.vertexCount()), degrees_(mesh.vertexCount(), 0) {
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    add(mesh.triangles()[t], patch_of_triangle[t]);
  }
}

std::vector<VertexFan> PatchedMesh::fansOf(NodeIndex node) const {
  Wheel wheel;
  for (const std::uint32_t t : triangles_of_node_[node.value]) {
    if (is_removed_[t]) continue;
    const TriangleNodes& nodes = triangles_[t];
    const std::size_t k = nodes[0] == node ? 0 : nodes[1] == node ? 1 : 2;
    wheel.add({nodes[(k + 1) % 3], nodes[(k + 2) % 3], t, patches_[t]});
  }
  wheel.sort();
  return wheel.fans();
}

std::size_t PatchedMesh::trianglesAt(NodeIndex a, NodeIndex b) const {
  const NodeIndex fewer = degree(a) < degree(b) ? a : b;
  const NodeIndex other = fewer == a ? b : a;
  const std::vector<std::uint32_t>& around = triangles_of_node_[fewer.value];
  return static_cast<std::size_t>(std::count_if(around.begin(), around.end(), [&](std::uint32_t t) {
    return !is_removed_[t] &&
           std::find(triangles_[t].begin(), triangles_[t].end(), other) != triangles_[t].end();
  }));
}

bool PatchedMesh::hasTriangle(const TriangleNodes& nodes) const {
  const std::vector<std::uint32_t>& around = triangles_of_node_[nodes[0].value];
  return std::any_of(around.begin(), around.end(), [&](std::uint32_t t) {
    return !is_removed_[t] && std::is_permutation(nodes.begin(), nodes.end(), triangles_[t].begin());
  });
}

void PatchedMesh::add(const TriangleNodes& nodes, std::uint32_t patch) {
  for (const NodeIndex node : nodes) {
    triangles_of_node_[node.value].push_back(static_cast<std::uint32_t>(triangles_.size()));
    ++degrees_[node.value];
  }
  triangles_.push_back(nodes);
  patches_.push_back(patch);
  is_removed_.push_back(false);
}

void PatchedMesh::remove(std::uint32_t triangle) {
  is_removed_[triangle] = true;
  for (const NodeIndex node : triangles_[triangle]) {
    std::vector<std::uint32_t>& around = triangles_of_node_[node.value];
    if (2 * --degrees_[node.value] >= around.size()) continue;
    const auto gone = [&](std::uint32_t t) { return is_removed_[t]; };
    around.erase(std::remove_if(around.begin(), around.end(), gone), around.end());
  }
}

SurfaceMesh PatchedMesh::compacted(const std::vector<Eigen::Vector3d>& vertices) const {
  std::vector<Eigen::Vector3d> kept;
  std::vector<NodeIndex> number(vertices.size());
  for (std::size_t node = 0; node < vertices.size(); ++node) {
    if (degrees_[node] == 0) continue;
    number[node] = NodeIndex{kept.size()};
    kept.push_back(vertices[node]);
  }
  std::vector<TriangleNodes> triangles;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (is_removed_[t]) continue;
    const TriangleNodes& nodes = triangles_[t];
    triangles.push_back({number[nodes[0].value], number[nodes[1].value], number[nodes[2].value]});
  }
  return SurfaceMesh(std::move(kept), std::move(triangles), "merged mesh");
}

}  // namespace concave_distance::detail
