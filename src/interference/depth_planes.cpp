#include "depth_planes.h"

#include <algorithm>
#include <limits>

#include "mesh/surface/mesh_topology.h"

namespace concave_distance {
namespace {

// Planes whose normals differ by less are one, radians squared.
constexpr double kSameDirection = 1e-28;
// A point this near to an edge, as a share of the edge, lies on it.
constexpr double kOnEdge = 1e-9;

bool isConvex(const BodyMesh& body, TriangleIndex triangle, TriangleIndex across) {
  const auto middle = [&](TriangleIndex of) {
    const SurfaceMesh& surface = body.surface();
    return Eigen::Vector3d(surface.corner(of, 0) + surface.corner(of, 1) + surface.corner(of, 2));
  };
  const Eigen::Vector3d& normal = body.topology().triangle_normals[triangle.value];
  return normal.dot(middle(across) - middle(triangle)) < 0.0;
}

}  // namespace

void DepthPlanes::begin(const BodyMesh& other, const Eigen::Isometry3d& a_from_other, bool facet_is_of_b) {
  other_ = &other;
  a_from_other_ = a_from_other;
  exit_sign_ = facet_is_of_b ? 1.0 : -1.0;
  planes_.clear();
}

void DepthPlanes::add(TriangleIndex triangle) {
  DepthPlane plane;
  plane.out = a_from_other_.linear() * other_->topology().triangle_normals[triangle.value];
  plane.exit = exit_sign_ * plane.out;
  plane.offset = plane.out.dot(a_from_other_ * other_->surface().corner(triangle, 0));
  plane.triangle = triangle;
  const auto same = [&](const DepthPlane& known) {
    return (known.out - plane.out).squaredNorm() < kSameDirection && known.offset == plane.offset;
  };
  if (std::none_of(planes_.begin(), planes_.end(), same)) planes_.push_back(plane);
}

void DepthPlanes::addAround(TriangleIndex triangle, const Eigen::Vector3d& closest) {
  add(triangle);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& from = other_->surface().corner(triangle, k);
    const Eigen::Vector3d edge = other_->surface().corner(triangle, (k + 1) % 3) - from;
    if ((closest - from).cross(edge).norm() > kOnEdge * edge.squaredNorm()) continue;
    const TriangleIndex across =
        other_->topology().triangle_across_edge[triangle.value][static_cast<std::size_t>(k)];
    if (across != kNoTriangle && isConvex(*other_, triangle, across)) add(across);
  }
}

double DepthPlanes::leastDepth(const Eigen::Vector3d& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (const DepthPlane& plane : planes_) least = std::min(least, plane.depth(point));
  return std::max(0.0, least);
}

void DepthPlanes::keepBelow(const DepthPlane& plane, const std::array<Eigen::Vector3d, 3>& triangle) {
  polygon_.assign(triangle.begin(), triangle.end());
  for (const DepthPlane& other : planes_) {
    if (&other != &plane) cutOff(plane, other);
  }
}

// Cuts off where `other` is lower; where both are equal the first one keeps it.
void DepthPlanes::cutOff(const DepthPlane& plane, const DepthPlane& other) {
  clipped_.clear();
  const auto height = [&](const Eigen::Vector3d& p) { return other.depth(p) - plane.depth(p); };
  for (std::size_t k = 0; k < polygon_.size(); ++k) {
    const Eigen::Vector3d& from = polygon_[k];
    const Eigen::Vector3d& to = polygon_[(k + 1) % polygon_.size()];
    const double at_from = height(from);
    const double at_to = height(to);
    if (at_from >= 0.0) clipped_.push_back(from);
    if ((at_from > 0.0 && at_to < 0.0) || (at_from < 0.0 && at_to > 0.0)) {
      clipped_.push_back(from + at_from / (at_from - at_to) * (to - from));
    }
  }
  polygon_.swap(clipped_);
}

}  // namespace concave_distance
