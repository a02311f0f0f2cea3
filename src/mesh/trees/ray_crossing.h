#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "triangle_tree.h"

namespace concave_distance::detail {

// The builder keeps the depth below 80; a traversal holds one waiting child per level.
using LeafStack = std::array<std::uint32_t, 96>;

/// Visits the triangles of every leaf whose box passes; stops when `visit` returns true.
template <typename Passes, typename Visit>
bool visitLeaves(const TriangleTree& tree, Passes passes, Visit visit) {
  if (tree.nodes().empty()) return false;
  LeafStack stack;
  std::size_t waiting = 0;
  std::uint32_t index = 0;
  while (true) {
    const TriangleTree::Node& node = tree.nodes()[index];
    if (passes(node.box)) {
      if (node.count == 0) {
        stack[waiting++] = node.first;
        ++index;
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        if (visit(tree.order()[i])) return true;
      }
    }
    if (waiting == 0) return false;
    index = stack[--waiting];
  }
}

/// Returns the orientation of the plane triangle (origin, a, b): 1, -1 or 0. The ends are ordered first, so
/// that a triangle that runs along an edge the other way gets exactly the opposite sign, also where the
/// compiler fuses a multiplication with a subtraction.
inline int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const bool turned = b.x() < a.x() || (b.x() == a.x() && b.y() < a.y());
  const Eigen::Vector2d& l = turned ? b : a;
  const Eigen::Vector2d& r = turned ? a : b;
  const double area = l.x() * r.y() - l.y() * r.x();
  const int sign = (area > 0.0) - (area < 0.0);
  return turned ? -sign : sign;
}

/// Tests the slabs of the box against origin + s * direction, 0 <= s <= longest; the far end is widened by
/// the rounding of three operations (Ize 2013), so that no box is missed.
class SlabTest {
 public:
  SlabTest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double longest)
      : origin_(origin), direction_(direction), inverse_(direction.cwiseInverse()), longest_(longest) {}

  bool operator()(const Eigen::AlignedBox3d& box) const {
    double near = 0.0;
    double far = longest_;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction_[axis] == 0.0) {  // 0 times infinity would not compare
        if (origin_[axis] < box.min()[axis] || origin_[axis] > box.max()[axis]) return false;
        continue;
      }
      const double s0 = (box.min()[axis] - origin_[axis]) * inverse_[axis];
      const double s1 = (box.max()[axis] - origin_[axis]) * inverse_[axis];
      near = std::max(near, std::min(s0, s1));
      far = std::min(far, std::max(s0, s1) * kWiden);
    }
    return near <= far;
  }

 private:
  static constexpr double kWiden = 1.0 + 8.0 * std::numeric_limits<double>::epsilon();
  Eigen::Vector3d origin_;
  Eigen::Vector3d direction_;
  Eigen::Vector3d inverse_;
  double longest_;
};

/// A ray seen along itself: sheared so that it runs along one axis from the origin (Woop, Benthin and Wald
/// 2013). Each vertex projects to the same plane point in every triangle, and a ray through an edge or a
/// vertex is settled by moving it by an infinitesimal (e, e^2): a closed shell is crossed the right number of
/// times, for any rounding.
class ShearedRay {
 public:
  ShearedRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) : origin_(origin) {
    direction.cwiseAbs().maxCoeff(&z_);
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    shear_x_ = direction[x_] / direction[z_];
    shear_y_ = direction[y_] / direction[z_];
    forward_ = direction[z_] > 0.0 ? 1.0 : -1.0;
  }

  /// Says where the ray's line meets a triangle, before or behind the origin.
  struct Meeting {
    int side = 0;         ///< 1: the line leaves through the front, -1: it enters, 0: it misses
    double height = 0.0;  ///< times `weight`: metres along the ray's longest axis; negative behind the origin
    double weight = 0.0;
  };

  Meeting meeting(const std::array<Eigen::Vector3d, 3>& t) const {
    std::array<Eigen::Vector2d, 3> p;
    Eigen::Vector3d height;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d v = t[k] - origin_;
      p[k] = {v[x_] - shear_x_ * v[z_], v[y_] - shear_y_ * v[z_]};
      height[static_cast<int>(k)] = v[z_] * forward_;
    }
    const int side = settledSide(p[0], p[1]);
    if (side == 0 || settledSide(p[1], p[2]) != side || settledSide(p[2], p[0]) != side) return {};
    // Heights of the corners, weighted by the areas opposite to each; all of one sign here.
    const double w0 = std::abs(area(p[1], p[2]));
    const double w1 = std::abs(area(p[2], p[0]));
    const double w2 = std::abs(area(p[0], p[1]));
    return {forward_ > 0.0 ? side : -side, w0 * height[0] + w1 * height[1] + w2 * height[2], w0 + w1 + w2};
  }

  /// Returns 1 where the ray leaves through the triangle's front, -1 where it enters, 0 where it misses.
  int crossing(const std::array<Eigen::Vector3d, 3>& t) const {
    const Meeting met = meeting(t);
    return met.height > 0.0 ? met.side : 0;
  }

 private:
  static double area(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  }
  static int settledSide(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const int side = orientation(a, b);
    if (side != 0) return side;
    if (a.y() != b.y()) return a.y() > b.y() ? 1 : -1;
    return (b.x() > a.x()) - (b.x() < a.x());
  }

  Eigen::Vector3d origin_;
  Eigen::Index x_ = 0;
  Eigen::Index y_ = 1;
  Eigen::Index z_ = 2;
  double shear_x_ = 0.0;
  double shear_y_ = 0.0;
  double forward_ = 1.0;
};

inline std::array<Eigen::Vector3d, 3> cornersOf(const SurfaceMesh& mesh, TriangleIndex t) {
  return {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
}

}  // namespace concave_distance::detail
