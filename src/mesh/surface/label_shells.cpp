#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/union_find.h"
#include "resolve_shells.h"

namespace concave_distance::detail {
namespace {

constexpr std::uint32_t kOpenClass = 0;
constexpr std::uint32_t kNone = 0xffffffffU;

bool isSegment(const TriangleNodes& nodes) {
  return nodes[0] == nodes[1] || nodes[1] == nodes[2] || nodes[2] == nodes[0];
}

/// Classes that separate triangles sharing an edge: kOpenClass for sheets, else a number for each unit that
/// they bound. One class for all if no edge has more than two triangles.
std::vector<std::uint32_t> classesOf(const std::vector<Eigen::Vector3d>& vertices,
                                     const std::vector<TriangleNodes>& triangles, const EdgeTable& edges) {
  bool is_manifold = true;
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    is_manifold = is_manifold && edges.first[e + 1] - edges.first[e] <= 2;
  }
  if (is_manifold) return std::vector<std::uint32_t>(triangles.size(), kOpenClass + 1);
  std::vector<std::uint32_t> classes(triangles.size(), kOpenClass);
  const ResolvedShells resolved = resolveShells(vertices, triangles);
  for (std::uint32_t f = 0; f < resolved.table.faces.size(); ++f) {
    if (resolved.decisions[f].role != FaceRole::Skin) continue;
    const Face& face = resolved.table.faces[f];
    for (std::uint32_t i = face.first; i < face.first + face.copies(); ++i) {
      classes[resolved.table.triangles[i]] = kOpenClass + 1 + resolved.units.unit_of_face[f];
    }
  }
  return classes;
}

/// Whether the triangles of each set lie in one plane, up to rounding: the two sides of a sheet with
/// different triangles bound nothing. A set is named by one of its triangles.
std::vector<bool> findFlatSets(const std::vector<Eigen::Vector3d>& vertices,
                               const std::vector<TriangleNodes>& triangles, UnionFind& sets) {
  constexpr double kRounding = 0x1.0p-45;
  struct Plane {
    Eigen::Vector3d point;
    Eigen::Vector3d along = Eigen::Vector3d::Zero();   ///< to the point farthest from `point`
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< the longest of the cross products with `along`
    bool is_flat = true;
  };
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : vertices) box.extend(vertex);
  const double size = box.sizes().maxCoeff();  // squares of lengths may leave the range of exponents
  std::vector<Plane> planes(triangles.size());
  const auto for_each_corner = [&](auto visit) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const std::uint32_t set = sets.find(t);
      for (const NodeIndex node : triangles[t]) visit(planes[set], (vertices[node.value] - box.min()) / size);
    }
  };
  for_each_corner([](Plane& plane, const Eigen::Vector3d& corner) { plane.point = corner; });
  for_each_corner([](Plane& plane, const Eigen::Vector3d& corner) {
    const Eigen::Vector3d along = corner - plane.point;
    if (along.squaredNorm() > plane.along.squaredNorm()) plane.along = along;
  });
  for_each_corner([](Plane& plane, const Eigen::Vector3d& corner) {
    const Eigen::Vector3d normal = plane.along.cross(corner - plane.point);
    if (normal.squaredNorm() > plane.normal.squaredNorm()) plane.normal = normal;
  });
  for (Plane& plane : planes) plane.normal.stableNormalize();
  for_each_corner([](Plane& plane, const Eigen::Vector3d& corner) {
    const double height = std::abs(plane.normal.dot(corner - plane.point));
    plane.is_flat = plane.is_flat && height <= kRounding * plane.along.norm();
  });
  std::vector<bool> is_flat(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) is_flat[t] = planes[t].is_flat;
  return is_flat;
}

class Labeller {
 public:
  Labeller(const std::vector<Eigen::Vector3d>& vertices, const std::vector<TriangleNodes>& triangles,
           const EdgeTable& edges)
      : vertices_(vertices),
        triangles_(triangles),
        edges_(edges),
        classes_(classesOf(vertices, triangles, edges_)),
        sets_(triangles.size()),
        is_open_(triangles.size()) {}

  ShellLabels label() {
    joinOverEdges();
    findOpenOnes();
    joinOverCorners();
    return number();
  }

 private:
  /// Calls visit(first, last) for the half-edges of each class along each edge.
  template <typename Visit>
  void forEachGroup(Visit visit) const {
    std::vector<HalfEdge> around;
    const auto class_of = [&](HalfEdge h) { return classes_[h / 3]; };
    for (std::size_t e = 0; e < edges_.edgeCount(); ++e) {
      around.clear();
      for (std::uint32_t i = edges_.first[e]; i < edges_.first[e + 1]; ++i) {
        if (!isSegment(triangles_[edges_.half_edges[i] / 3])) around.push_back(edges_.half_edges[i]);
      }
      std::sort(around.begin(), around.end(), [&](HalfEdge l, HalfEdge r) {
        return class_of(l) != class_of(r) ? class_of(l) < class_of(r) : l < r;
      });
      for (auto first = around.begin(); first != around.end();) {
        auto last = first;
        while (last != around.end() && class_of(*last) == class_of(*first)) ++last;
        visit(first, last);
        first = last;
      }
    }
  }

  void joinOverEdges() {
    forEachGroup([&](auto first, auto last) {
      for (auto h = first; h != last; ++h) sets_.unite(*first / 3, *h / 3);
    });
  }

  void findOpenOnes() {
    std::vector<bool> set_is_open = findFlatSets(vertices_, triangles_, sets_);
    forEachGroup([&](auto first, auto last) {
      int balance = 0;
      for (auto h = first; h != last; ++h)
        balance += startOf(triangles_, *h) < endOf(triangles_, *h) ? 1 : -1;
      if (balance != 0) set_is_open[sets_.find(*first / 3)] = true;
    });
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      is_open_[t] = classes_[t] == kOpenClass || set_is_open[sets_.find(t)] || isSegment(triangles_[t]);
    }
  }

  /// Joins sheets that meet in a corner; a triangle degenerated to a segment joins all at its corners.
  void joinOverCorners() {
    std::vector<std::uint32_t> open_at(vertices_.size(), kNone);
    std::vector<std::uint32_t> any_at(vertices_.size(), kNone);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (isSegment(triangles_[t])) continue;
      for (const NodeIndex node : triangles_[t]) {
        any_at[node.value] = t;
        if (!is_open_[t]) continue;
        if (open_at[node.value] != kNone) sets_.unite(open_at[node.value], t);
        open_at[node.value] = t;
      }
    }
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!isSegment(triangles_[t])) continue;
      for (const NodeIndex node : triangles_[t]) {
        if (any_at[node.value] == kNone) {
          any_at[node.value] = t;
        } else {
          is_open_[t] = is_open_[any_at[node.value]];
          sets_.unite(any_at[node.value], t);
          break;
        }
      }
    }
  }

  ShellLabels number() {
    ShellLabels labels;
    labels.shell_of_triangle.resize(triangles_.size());
    std::vector<std::uint32_t> shell_of_set(triangles_.size(), kNone);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      std::uint32_t& shell = shell_of_set[sets_.find(t)];
      if (shell == kNone) {
        shell = static_cast<std::uint32_t>(labels.triangle_of_shell.size());
        labels.triangle_of_shell.emplace_back(t);
        labels.shell_is_closed.push_back(true);
      }
      labels.shell_of_triangle[t] = shell;
      if (is_open_[t]) labels.shell_is_closed[shell] = false;
    }
    return labels;
  }

  const std::vector<Eigen::Vector3d>& vertices_;
  const std::vector<TriangleNodes>& triangles_;
  const EdgeTable& edges_;
  std::vector<std::uint32_t> classes_;
  UnionFind sets_;
  std::vector<bool> is_open_;
};

}  // namespace

ShellLabels labelShells(const std::vector<Eigen::Vector3d>& vertices,
                        const std::vector<TriangleNodes>& triangles, const EdgeTable& edges) {
  return Labeller(vertices, triangles, edges).label();
}

}  // namespace concave_distance::detail
