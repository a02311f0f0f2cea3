#include "depth_slope.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "distance/kernels/surface_walk.h"
#include "distance/kernels/triangle_distance.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance::detail {
namespace {

// Directions that differ by less are one, and what a wall rises by along a surface is nothing.
constexpr double kSameDirection = 1e-6;
// Walls that are looked at: of more than these only the nearest count.
constexpr std::size_t kMostWalls = 16;

/// Calls visit(triangle, its closest point) for the triangles within `reach` of a point in the body's frame.
template <typename Visit>
void forEachWithin(const BodyMesh& body, const Eigen::Vector3d& point, double reach, const Visit& visit) {
  const TriangleTree& tree = body.tree();
  std::array<std::uint32_t, 96> stack;  // as in closestPoint()
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const std::uint32_t index = stack[--waiting];
    const TriangleTree::Node& node = tree.nodes()[index];
    if (node.box.squaredExteriorDistance(point) > reach * reach) continue;
    if (node.count == 0) {
      stack[waiting++] = node.first;
      stack[waiting++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const TriangleIndex triangle = tree.order()[i];
      const PointTriangleDistance at = pointTriangleDistance(point, trianglePoints(body.surface(), triangle));
      if (at.squared_distance <= reach * reach) visit(triangle, at);
    }
  }
}

double cross(const Eigen::Vector2d& l, const Eigen::Vector2d& r) {
  return l.x() * r.y() - l.y() * r.x();
}

}  // namespace

Eigen::Vector3d DepthSlope::find(const Surface& own, const Surface& other, const Eigen::Vector3d& point,
                                 double depth, double tolerance) {
  collectDirections(other, point, depth + 10.0 * tolerance);
  if (directions_.empty()) return Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 2> along;
  const int ways = findWays(own, point, tolerance, along);
  if (ways == 0) return directions_.front().out;
  for (Direction& direction : directions_) {
    direction.across = along.transpose() * direction.out;
    if (ways == 1) direction.across.y() = 0.0;
    if (direction.across.norm() <= kSameDirection) return direction.out;
  }
  return ways == 1 ? meanOnLine() : meanOnPlane();
}

void DepthSlope::collectDirections(const Surface& other, const Eigen::Vector3d& point, double reach) {
  directions_.clear();
  const Eigen::Vector3d in_body = other.frame_from_body.inverse(Eigen::Isometry) * point;
  const auto add = [&](TriangleIndex triangle, const PointTriangleDistance& at) {
    const double distance = std::sqrt(at.squared_distance);
    const Eigen::Vector3d& normal = other.body.topology().triangle_normals[triangle.value];
    const double height = normal.dot(at.point - in_body);
    // The normal of a face is known better than the way to a point that is near.
    const bool is_face = std::abs(distance - height) <= 1e-12 * distance || !(distance > 0.0);
    const Eigen::Vector3d out = is_face ? normal : Eigen::Vector3d((at.point - in_body) / distance);
    const auto same = std::find_if(directions_.begin(), directions_.end(), [&](const Direction& known) {
      return (known.out - out).norm() <= kSameDirection;
    });
    if (same != directions_.end()) {
      if (distance < same->distance) *same = {distance, out, Eigen::Vector2d::Zero()};
    } else if (directions_.size() < 4 * kMostWalls) {
      directions_.push_back({distance, out, Eigen::Vector2d::Zero()});
    }
  };
  forEachWithin(other.body, in_body, reach, add);
  std::sort(directions_.begin(), directions_.end(),
            [](const Direction& l, const Direction& r) { return l.distance < r.distance; });
  if (directions_.size() > kMostWalls) directions_.resize(kMostWalls);
  for (Direction& direction : directions_) direction.out = other.frame_from_body.linear() * direction.out;
}

int DepthSlope::findWays(const Surface& own, const Eigen::Vector3d& point, double tolerance,
                         Eigen::Matrix<double, 3, 2>& along) const {
  // The normals around the point span what it cannot move along.
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Vector3d edge = Eigen::Vector3d::Zero();
  int rank = 0;
  const auto add = [&](TriangleIndex triangle, const PointTriangleDistance&) {
    const Eigen::Vector3d& normal = own.body.topology().triangle_normals[triangle.value];
    if (normal.isZero()) return;
    if (rank == 0) {
      first = normal;
      rank = 1;
    } else if (rank == 1 && first.cross(normal).norm() > kSameDirection) {
      edge = first.cross(normal).normalized();
      rank = 2;
    } else if (rank == 2 && std::abs(edge.dot(normal)) > kSameDirection) {
      rank = 3;
    }
  };
  forEachWithin(own.body, own.frame_from_body.inverse(Eigen::Isometry) * point, tolerance, add);
  if (rank == 2) along.col(0) = along.col(1) = own.frame_from_body.linear() * edge;
  if (rank == 1) {
    const Eigen::Vector3d normal = own.frame_from_body.linear() * first;
    along.col(0) = normal.unitOrthogonal();
    along.col(1) = normal.cross(along.col(0));
  }
  return 3 - std::max(rank, 1);
}

// Two walls that rise opposite ways along the edge.
Eigen::Vector3d DepthSlope::meanOnLine() const {
  const Direction& nearest = directions_.front();
  for (const Direction& other : directions_) {
    const double between = other.across.x() - nearest.across.x();
    if (other.across.x() * nearest.across.x() >= 0.0) continue;
    return (other.across.x() * nearest.out - nearest.across.x() * other.out) / between;
  }
  return nearest.out;
}

// Two opposite walls, or three that the point is in the midst of.
Eigen::Vector3d DepthSlope::meanOnPlane() const {
  const Direction& nearest = directions_.front();
  for (std::size_t j = 1; j < directions_.size(); ++j) {
    const Direction& second = directions_[j];
    const double length = second.across.norm() + nearest.across.norm();
    if ((second.across / second.across.norm() + nearest.across / nearest.across.norm()).norm() <=
        kSameDirection)
      return (second.across.norm() * nearest.out + nearest.across.norm() * second.out) / length;
  }
  for (std::size_t j = 1; j < directions_.size(); ++j) {
    for (std::size_t k = j + 1; k < directions_.size(); ++k) {
      const Direction& second = directions_[j];
      const Direction& third = directions_[k];
      const Eigen::Vector3d weights(cross(second.across, third.across), cross(third.across, nearest.across),
                                    cross(nearest.across, second.across));
      if (weights.minCoeff() < 0.0 && weights.maxCoeff() > 0.0) continue;
      if (!(std::abs(weights.sum()) > 0.0)) continue;
      return (weights[0] * nearest.out + weights[1] * second.out + weights[2] * third.out) / weights.sum();
    }
  }
  return nearest.out;
}

}  // namespace concave_distance::detail
