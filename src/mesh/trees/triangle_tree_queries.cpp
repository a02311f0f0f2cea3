#include "triangle_tree.h"

#include <array>

#include "base/exact_orientation.h"
#include "mesh/surface/mesh_topology.h"
#include "ray_crossing.h"

namespace concave_distance {
namespace {

using detail::orientationSign;
using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

/// Exact orientation of a plane triangle, of points whose coordinate along `axis` is 0.
int planeOrientation(const Vector3d& p, const Vector3d& q, const Vector3d& r, Eigen::Index axis) {
  return orientationSign(p, q, r, p + Vector3d::Unit(axis));
}

bool segmentsCross(const Vector3d& p, const Vector3d& q, const Vector3d& a, const Vector3d& b,
                   Eigen::Index axis) {
  if ((p.cwiseMax(q).array() < a.cwiseMin(b).array()).any()) return false;
  if ((a.cwiseMax(b).array() < p.cwiseMin(q).array()).any()) return false;
  return planeOrientation(p, a, b, axis) * planeOrientation(q, a, b, axis) <= 0 &&
         planeOrientation(a, p, q, axis) * planeOrientation(b, p, q, axis) <= 0;
}

/// A segment in the plane of the triangle: it meets the triangle when an end is inside or it crosses an edge.
bool coplanarMeets(const Vector3d& a, const Vector3d& b, const Corners& t, Eigen::Index dropped_axis) {
  const auto flat = [&](Vector3d v) {
    v[dropped_axis] = 0.0;
    return v;
  };
  const Vector3d p = flat(a);
  const Vector3d q = flat(b);
  const Corners c = {flat(t[0]), flat(t[1]), flat(t[2])};
  const int s0 = planeOrientation(p, c[0], c[1], dropped_axis);
  const int s1 = planeOrientation(p, c[1], c[2], dropped_axis);
  const int s2 = planeOrientation(p, c[2], c[0], dropped_axis);
  if ((s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0)) return true;
  return segmentsCross(p, q, c[0], c[1], dropped_axis) || segmentsCross(p, q, c[1], c[2], dropped_axis) ||
         segmentsCross(p, q, c[2], c[0], dropped_axis);
}

/// Exact: a segment that runs in the plane of a triangle far away shows only zeros and roundings to sums of
/// doubles. A triangle without area is met by nothing.
bool segmentMeets(const Vector3d& a, const Vector3d& b, const Corners& t) {
  const int side_a = orientationSign(t[0], t[1], t[2], a);
  const int side_b = orientationSign(t[0], t[1], t[2], b);
  if (side_a * side_b > 0) return false;
  if (side_a == 0 && side_b == 0) {
    Eigen::Index axis = 0;
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    normal.cwiseAbs().maxCoeff(&axis);
    return normal[axis] != 0.0 && coplanarMeets(a, b, t, axis);
  }
  const int w0 = orientationSign(a, b, t[1], t[2]);
  const int w1 = orientationSign(a, b, t[2], t[0]);
  const int w2 = orientationSign(a, b, t[0], t[1]);
  return (w0 >= 0 && w1 >= 0 && w2 >= 0) || (w0 <= 0 && w1 <= 0 && w2 <= 0);
}

}  // namespace

bool segmentHits(const TriangleTree& tree, const SurfaceMesh& mesh, const Eigen::Vector3d& a,
                 const Eigen::Vector3d& b, double margin) {
  return findHit(tree, mesh, a, b, margin, kNoTriangle) != kNoTriangle;
}

TriangleIndex findHit(const TriangleTree& tree, const SurfaceMesh& mesh, const Eigen::Vector3d& a,
                      const Eigen::Vector3d& b, double margin, TriangleIndex first) {
  const double length = (b - a).norm();
  if (!(length > 2.0 * margin)) return kNoTriangle;
  const Eigen::Vector3d offset = (b - a) * (margin / length);
  const Eigen::Vector3d from = a + offset;
  const Eigen::Vector3d to = b - offset;
  if (first != kNoTriangle && segmentMeets(from, to, detail::cornersOf(mesh, first))) return first;
  TriangleIndex found = kNoTriangle;
  detail::visitLeaves(tree, detail::SlabTest(from, to - from, 1.0), [&](TriangleIndex t) {
    if (!segmentMeets(from, to, detail::cornersOf(mesh, t))) return false;
    found = t;
    return true;
  });
  return found;
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
    const detail::ShearedRay ray(point, direction);
    int crossings = 0;
    detail::visitLeaves(tree, detail::SlabTest(point, direction, longest), [&](TriangleIndex t) {
      if (shell_is_closed[shell_of_triangle[t.value]]) crossings += ray.crossing(detail::cornersOf(mesh, t));
      return false;
    });
    inside += crossings > 0 ? 1 : 0;
  }
  return inside >= 2;
}

}  // namespace concave_distance
