#include "closest_point.h"

#include <array>
#include <cmath>
#include <limits>

#include "mesh/trees/triangle_tree.h"

namespace concave_distance {
namespace {

struct Waiting {
  std::uint32_t node;
  double squared_distance;
};

/// Bounds the rounding of (e1 x e2) . r and of their squares, relative to |e1| |e2| |r|.
constexpr double kPlaneRounding = 16.0 * std::numeric_limits<double>::epsilon();

/// Proves that no point of the triangle's plane is nearer: the product of the rounded cross product with a
/// vector is off by no more than kPlaneRounding times the lengths.
bool planeIsFarther(const TrianglePoints& triangle, const Eigen::Vector3d& target, double squared_distance) {
  const Eigen::Vector3d first = triangle[1] - triangle[0];
  const Eigen::Vector3d second = triangle[2] - triangle[0];
  const Eigen::Vector3d from = target - triangle[0];
  const Eigen::Vector3d normal = first.cross(second);
  const double squared_lengths = first.squaredNorm() * second.squaredNorm();
  const double height =
      std::abs(normal.dot(from)) - kPlaneRounding * std::sqrt(squared_lengths * from.squaredNorm());
  return height > 0.0 &&
         height * height > squared_distance * (normal.squaredNorm() + 3.0 * kPlaneRounding * squared_lengths);
}

SurfacePoint closestOn(TriangleIndex triangle, const TrianglePoints& points, const Eigen::Vector3d& target) {
  const PointTriangleDistance d = pointTriangleDistance(target, points);
  return {triangle, d.feature, d.point, d.squared_distance};
}

}  // namespace

SurfacePoint closestPoint(const BodyMesh& body, const Eigen::Vector3d& target, TriangleIndex hint) {
  const TriangleTree& tree = body.tree();
  SurfacePoint best = closestOn(hint, trianglePoints(body.surface(), hint), target);
  const auto box_distance = [&](std::uint32_t node) {
    return tree.nodes()[node].box.squaredExteriorDistance(target);
  };
  std::array<Waiting, 96> stack;  // the builder keeps the depth below 80; one waiting child a level
  std::size_t waiting = 0;
  stack[waiting++] = {0, box_distance(0)};
  while (waiting > 0) {
    const Waiting next = stack[--waiting];
    if (next.squared_distance >= best.squared_distance) {
      continue;
    }
    const TriangleTree::Node& node = tree.nodes()[next.node];
    if (node.count == 0) {
      Waiting near{next.node + 1, box_distance(next.node + 1)};
      Waiting far{node.first, box_distance(node.first)};
      if (far.squared_distance < near.squared_distance) {
        std::swap(near, far);
      }
      stack[waiting++] = far;
      stack[waiting++] = near;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const TriangleIndex triangle = tree.order()[i];
      const TrianglePoints points = trianglePoints(body.surface(), triangle);
      if (planeIsFarther(points, target, best.squared_distance)) continue;
      const SurfacePoint candidate = closestOn(triangle, points, target);
      if (candidate.squared_distance < best.squared_distance) {
        best = candidate;
      }
    }
  }
  return best;
}

}  // namespace concave_distance
