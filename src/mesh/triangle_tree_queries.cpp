#include "concave_distance/mesh/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace concave_distance {
namespace {

// The builder keeps the depth below 80; a traversal holds one waiting child per level.
using Stack = std::array<std::uint32_t, 96>;

/// Visits the triangles of every leaf whose box passes; stops when `visit` returns true.
template <typename Passes, typename Visit>
bool visitLeaves(const TriangleTree& tree, Passes passes, Visit visit) {
  if (tree.nodes().empty()) return false;
  Stack stack;
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

/// Orientation of the plane triangle (origin, a, b): 1, -1 or 0. The ends are ordered first, so that a
/// triangle that runs along an edge the other way gets exactly the opposite sign, also where the compiler
/// fuses a multiplication with a subtraction.
int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const bool turned = b.x() < a.x() || (b.x() == a.x() && b.y() < a.y());
  const Eigen::Vector2d& l = turned ? b : a;
  const Eigen::Vector2d& r = turned ? a : b;
  const double area = l.x() * r.y() - l.y() * r.x();
  const int sign = (area > 0.0) - (area < 0.0);
  return turned ? -sign : sign;
}

int orientation(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return orientation(a - p, b - p);
}

bool segmentsCross(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Eigen::Vector2d& a,
                   const Eigen::Vector2d& b) {
  if ((p.cwiseMax(q).array() < a.cwiseMin(b).array()).any()) return false;
  if ((a.cwiseMax(b).array() < p.cwiseMin(q).array()).any()) return false;
  return orientation(p, a, b) * orientation(q, a, b) <= 0 && orientation(a, p, q) * orientation(b, p, q) <= 0;
}

/// A segment in the plane of the triangle: it meets the triangle when an end is inside or it crosses an edge.
bool coplanarMeets(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                   const std::array<Eigen::Vector3d, 3>& t, Eigen::Index dropped_axis) {
  const Eigen::Index x = (dropped_axis + 1) % 3;
  const Eigen::Index y = (dropped_axis + 2) % 3;
  const auto flat = [&](const Eigen::Vector3d& v) { return Eigen::Vector2d(v[x], v[y]); };
  const Eigen::Vector2d p = flat(a);
  const Eigen::Vector2d q = flat(b);
  const std::array<Eigen::Vector2d, 3> c = {flat(t[0]), flat(t[1]), flat(t[2])};
  const int s0 = orientation(p, c[0], c[1]);
  const int s1 = orientation(p, c[1], c[2]);
  const int s2 = orientation(p, c[2], c[0]);
  if ((s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0)) return true;
  return segmentsCross(p, q, c[0], c[1]) || segmentsCross(p, q, c[1], c[2]) ||
         segmentsCross(p, q, c[2], c[0]);
}

bool segmentMeets(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  const std::array<Eigen::Vector3d, 3>& t) {
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double side_a = normal.dot(a - t[0]);
  const double side_b = normal.dot(b - t[0]);
  if ((side_a > 0.0 && side_b > 0.0) || (side_a < 0.0 && side_b < 0.0)) return false;
  if (side_a == 0.0 && side_b == 0.0) {
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    return normal[axis] != 0.0 && coplanarMeets(a, b, t, axis);
  }
  const Eigen::Vector3d d = b - a;
  const Eigen::Vector3d t0 = t[0] - a;
  const Eigen::Vector3d t1 = t[1] - a;
  const Eigen::Vector3d t2 = t[2] - a;
  const double w0 = d.dot(t1.cross(t2));
  const double w1 = d.dot(t2.cross(t0));
  const double w2 = d.dot(t0.cross(t1));
  return (w0 >= 0.0 && w1 >= 0.0 && w2 >= 0.0) || (w0 <= 0.0 && w1 <= 0.0 && w2 <= 0.0);
}

std::array<Eigen::Vector3d, 3> corners(const SurfaceMesh& mesh, TriangleIndex t) {
  return {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
}

/// Slabs of the box against origin + s * direction, 0 <= s <= longest; the far end is widened by the rounding
/// of three operations (Ize 2013), so that no box is missed.
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
/// times, whatever the rounding.
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

  /// 1 where the ray leaves through the triangle's front, -1 where it enters, 0 where it misses.
  int crossing(const std::array<Eigen::Vector3d, 3>& t) const {
    std::array<Eigen::Vector2d, 3> p;
    Eigen::Vector3d height;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d v = t[k] - origin_;
      p[k] = {v[x_] - shear_x_ * v[z_], v[y_] - shear_y_ * v[z_]};
      height[static_cast<int>(k)] = v[z_] * forward_;
    }
    const int side = settledSide(p[0], p[1]);
    if (side == 0 || settledSide(p[1], p[2]) != side || settledSide(p[2], p[0]) != side) return 0;
    // Height of the crossing, weighted by the areas opposite to each corner; all of one sign here.
    const double w0 = std::abs(area(p[1], p[2]));
    const double w1 = std::abs(area(p[2], p[0]));
    const double w2 = std::abs(area(p[0], p[1]));
    if (!(w0 * height[0] + w1 * height[1] + w2 * height[2] > 0.0)) return 0;
    return forward_ > 0.0 ? side : -side;
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

}  // namespace

bool segmentHits(const TriangleTree& tree, const SurfaceMesh& mesh, const Eigen::Vector3d& a,
                 const Eigen::Vector3d& b, double margin) {
  const double length = (b - a).norm();
  if (!(length > 2.0 * margin)) return false;
  const Eigen::Vector3d offset = (b - a) * (margin / length);
  const Eigen::Vector3d from = a + offset;
  const Eigen::Vector3d to = b - offset;
  return visitLeaves(tree, SlabTest(from, to - from, 1.0),
                     [&](TriangleIndex t) { return segmentMeets(from, to, corners(mesh, t)); });
}

bool containsPoint(const TriangleTree& tree, const SurfaceMesh& mesh,
                   const std::vector<bool>& shell_is_closed,
                   const std::vector<std::uint32_t>& shell_of_triangle, const Eigen::Vector3d& point) {
  if (!mesh.boundingBox().contains(point)) return false;
  // Slanted against the axes and their diagonals, where meshes like to have edges and faces.
  static const std::array<Eigen::Vector3d, 3> directions = {Eigen::Vector3d(0.8431, 0.2749, 0.4620),
                                                            Eigen::Vector3d(-0.3573, 0.9011, 0.2459),
                                                            Eigen::Vector3d(0.1867, -0.4403, -0.8782)};
  const double longest = 4.0 * mesh.diameter() + 1e-300;
  int inside = 0;
  for (const Eigen::Vector3d& direction : directions) {
    const ShearedRay ray(point, direction);
    int crossings = 0;
    visitLeaves(tree, SlabTest(point, direction, longest), [&](TriangleIndex t) {
      if (shell_is_closed[shell_of_triangle[t.value]]) crossings += ray.crossing(corners(mesh, t));
      return false;
    });
    inside += crossings > 0 ? 1 : 0;
  }
  return inside >= 2;
}

}  // namespace concave_distance
