#include "triangle_tree.h"

#include <array>

#include "mesh/surface/mesh_topology.h"
#include "ray_crossing.h"

namespace concave_distance {
namespace {

using detail::orientation;

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
