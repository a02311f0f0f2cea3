#include "dissolve_flat_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

#include "base/pair_key.h"

namespace concave_distance::detail {
namespace {

/// Largest number of splits per flat triangle, because hostile files can cause ever more of them.
constexpr std::size_t kSplitsPerFlat = 16;

bool hasTwoEqualCorners(const TriangleNodes& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// The triangles at an edge, including removed ones.
struct Users {
  std::vector<std::uint32_t> triangles;
  std::size_t left = 0;
};

/// A flat triangle whose corner lies on its longest edge.
struct Flat {
  double squared_length;  ///< of the longest edge
  std::uint32_t triangle;
  std::size_t corner;  ///< opposite to the longest edge
  bool operator<(const Flat& other) const {
    if (squared_length != other.squared_length) return squared_length < other.squared_length;
    return triangle > other.triangle;
  }
};

class Dissolving {
 public:
  Dissolving(const std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles)
      : vertices_(vertices), triangles_(triangles) {}

  DissolvedTriangles run() {
    DissolvedTriangles done;
    gone_.assign(triangles_.size(), false);
    std::vector<std::uint32_t> flats;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (look(t)) flats.push_back(t);
    }
    done.flat = flats_.size() + without_edges_;
    if (!flats_.empty()) linkEdges(flats);
    const std::size_t most = kSplitsPerFlat * flats_.size();
    while (!flats_.empty()) {
      const Flat flat = flats_.top();
      flats_.pop();
      if (gone_[flat.triangle]) continue;
      dissolve(flat, most, done.split);
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (!gone_[t]) triangles_[kept++] = triangles_[t];
    }
    triangles_.resize(kept);
    return done;
  }

 private:
  const Eigen::Vector3d& at(NodeIndex node) const { return vertices_[node.value]; }
  static std::uint64_t keyOf(NodeIndex a, NodeIndex b) { return pairKey(std::min(a, b), std::max(a, b)); }

  /// Whether a triangle is flat; if so, queues it.
  bool look(std::uint32_t t) {
    const TriangleNodes& nodes = triangles_[t];
    if (hasTwoEqualCorners(nodes)) {
      gone_[t] = true;
      ++without_edges_;
      return false;
    }
    Flat flat{0.0, t, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = (at(nodes[(k + 2) % 3]) - at(nodes[(k + 1) % 3])).squaredNorm();
      if (length <= flat.squared_length) continue;
      flat.squared_length = length;
      flat.corner = k;
    }
    const Eigen::Vector3d ab = at(nodes[1]) - at(nodes[0]);
    const Eigen::Vector3d ac = at(nodes[2]) - at(nodes[0]);
    constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
    if (ab.cross(ac).norm() > kRounding * flat.squared_length) return false;
    flats_.push(flat);
    return true;
  }

  // Only edges between corners of flat triangles are looked up.
  void linkEdges(const std::vector<std::uint32_t>& flats) {
    on_flat_.assign(vertices_.size(), false);
    for (const std::uint32_t t : flats) {
      for (const NodeIndex node : triangles_[t]) on_flat_[node.value] = true;
    }
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!gone_[t]) link(t);
    }
  }

  template <typename Visit>
  void forEachLinkedEdge(const TriangleNodes& nodes, const Visit& visit) {
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeIndex start = nodes[k];
      const NodeIndex end = nodes[(k + 1) % 3];
      if (on_flat_[start.value] && on_flat_[end.value]) visit(at_edge_[keyOf(start, end)]);
    }
  }

  void link(std::uint32_t t) {
    forEachLinkedEdge(triangles_[t], [t](Users& users) {
      users.triangles.push_back(t);
      ++users.left;
    });
  }

  void remove(std::uint32_t t) {
    forEachLinkedEdge(triangles_[t], [](Users& users) { --users.left; });
    gone_[t] = true;
  }

  void add(const TriangleNodes& nodes) {
    if (hasTwoEqualCorners(nodes)) return;
    const auto t = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(nodes);
    gone_.push_back(false);
    link(t);
    look(t);
  }

  void dissolve(const Flat& flat, std::size_t most, std::size_t& splits) {
    const NodeIndex middle = triangles_[flat.triangle][flat.corner];
    const NodeIndex a = triangles_[flat.triangle][(flat.corner + 1) % 3];
    const NodeIndex b = triangles_[flat.triangle][(flat.corner + 2) % 3];
    remove(flat.triangle);
    const bool fills_a_gap = at_edge_[keyOf(a, middle)].left > 0 || at_edge_[keyOf(middle, b)].left > 0;
    if (!fills_a_gap) return;
    const std::vector<std::uint32_t> across = std::move(at_edge_[keyOf(a, b)].triangles);
    for (const std::uint32_t t : across) {
      if (gone_[t]) continue;
      if (splits == most) return;
      const TriangleNodes nodes = triangles_[t];
      std::size_t k = 0;
      while (nodes[k] == a || nodes[k] == b) ++k;
      remove(t);
      add({nodes[k], nodes[(k + 1) % 3], middle});
      add({nodes[k], middle, nodes[(k + 2) % 3]});
      ++splits;
    }
  }

  const std::vector<Eigen::Vector3d>& vertices_;
  std::vector<TriangleNodes>& triangles_;
  std::vector<bool> gone_;
  std::priority_queue<Flat> flats_;  ///< longest first, so that splitting rarely meets another one
  std::size_t without_edges_ = 0;
  std::vector<bool> on_flat_;  ///< by vertex: corner of a flat triangle
  std::unordered_map<std::uint64_t, Users> at_edge_;
};

}  // namespace

DissolvedTriangles dissolveFlatTriangles(const std::vector<Eigen::Vector3d>& vertices,
                                         std::vector<TriangleNodes>& triangles) {
  return Dissolving(vertices, triangles).run();
}

}  // namespace concave_distance::detail
