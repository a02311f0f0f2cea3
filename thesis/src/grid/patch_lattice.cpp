#include "patch_lattice.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "mesh/surface/plane_geometry.h"

namespace concave_distance::detail {
namespace {

/// Lattice edges as a fraction of the longest edge allowed, and distance kept from the border as a fraction
/// of a lattice edge: found by trial on the thesis's six bodies. Below, nodes are wasted; above, the edges
/// between lattice and border grow too long and are split again.
constexpr double kFill = 0.94;
constexpr double kBorderDistance = 0.7;

/// Border edges of a patch in cells as wide as the longest of them, so that what is near a point is in the
/// nine cells around it.
class BorderEdges {
 public:
  explicit BorderEdges(double cell) : cell_(cell) {}
  void add(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const auto edge = static_cast<std::uint32_t>(edges_.size());
    edges_.push_back({a, b});
    cells_[key(a, 0, 0)].push_back(edge);
    cells_[key(b, 0, 0)].push_back(edge);
  }
  bool isWithin(const Eigen::Vector2d& point, double distance) const {
    for (int i = 0; i < 9; ++i) {
      const auto found = cells_.find(key(point, i % 3 - 1, i / 3 - 1));
      if (found == cells_.end()) {
        continue;
      }
      for (const std::uint32_t edge : found->second) {
        if (distanceToSegment(point, edges_[edge][0], edges_[edge][1]) < distance) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  std::uint64_t key(const Eigen::Vector2d& p, int right, int up) const {
    const auto x = static_cast<std::int64_t>(std::floor(p.x() / cell_)) + right;
    const auto y = static_cast<std::int64_t>(std::floor(p.y() / cell_)) + up;
    return (static_cast<std::uint64_t>(x) << 32U) ^ (static_cast<std::uint64_t>(y) & 0xffffffffU);
  }
  double cell_;
  std::vector<std::array<Eigen::Vector2d, 2>> edges_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// The part of a row (a line of constant y) in a triangle, as an interval of x; empty (left > right) beside
/// it.
std::pair<double, double> rowInterval(const PlaneTriangle& corners, double y) {
  double left = std::numeric_limits<double>::infinity();
  double right = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector2d& a = corners[k];
    const Eigen::Vector2d& b = corners[(k + 1) % 3];
    if (std::min(a.y(), b.y()) <= y && y <= std::max(a.y(), b.y())) {
      const double s = a.y() == b.y() ? 0.0 : (y - a.y()) / (b.y() - a.y());
      const double x = a.x() + s * (b.x() - a.x());
      left = std::min({left, x, a.y() == b.y() ? b.x() : x});
      right = std::max({right, x, a.y() == b.y() ? b.x() : x});
    }
  }
  return {left, right};
}

}  // namespace

void findLatticePoints(const EditableMesh& mesh, const PatchTriangulation& triangulation,
                       const std::vector<std::uint32_t>& triangles, const PatchFrame& frame,
                       double max_edge_length, std::vector<LatticePoint>& points) {
  points.clear();
  const auto place = [&](NodeIndex node) { return frame.project(mesh.vertices()[node.value]); };
  const auto corners_of = [&](std::uint32_t t) -> PlaneTriangle {
    const TriangleNodes& nodes = mesh.triangles()[t];
    return {place(nodes[0]), place(nodes[1]), place(nodes[2])};
  };
  Eigen::AlignedBox2d box;
  for (const std::uint32_t t : triangles) {
    for (const Eigen::Vector2d& corner : corners_of(t)) {
      box.extend(corner);
    }
  }
  // Rows along the longest border edge, fitted into the patch's height, points fitted into its width.
  const double wanted = kFill * max_edge_length;
  const double row = box.sizes().y() / std::ceil(box.sizes().y() / (std::sqrt(0.75) * wanted));
  const double step = box.sizes().x() / std::ceil(box.sizes().x() / wanted);
  for (const std::uint32_t t : triangles) {
    const PlaneTriangle corners = corners_of(t);
    const auto [low, high] = std::minmax({corners[0].y(), corners[1].y(), corners[2].y()});
    for (double j = std::ceil((low - box.min().y()) / row); box.min().y() + j * row <= high; j += 1.0) {
      const double y = box.min().y() + j * row;
      const auto [left, right] = rowInterval(corners, y);
      const double shift = box.min().x() + (std::fmod(j, 2.0) == 0.0 ? 0.0 : 0.5 * step);
      for (double k = std::ceil((left - shift) / step); shift + k * step <= right; k += 1.0) {
        points.push_back({t, {shift + k * step, y}});
      }
    }
  }
  if (points.empty()) {
    return;
  }
  BorderEdges border(max_edge_length * (1.0 + 1e-6));
  for (const std::uint32_t t : triangles) {
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
      if (!triangulation.isInterior(mesh.edgeOf(h))) {
        border.add(place(startOf(mesh.triangles(), h)), place(endOf(mesh.triangles(), h)));
      }
    }
  }
  const auto end = std::remove_if(points.begin(), points.end(), [&](const LatticePoint& point) {
    return border.isWithin(point.place, kBorderDistance * wanted);
  });
  points.erase(end, points.end());
}

}  // namespace concave_distance::detail
