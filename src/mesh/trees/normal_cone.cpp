#include "normal_cone.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostCorners = 256;
/// A wider cap is not convex any more, nor would it rule anything out that is worth the trouble.
constexpr double kWidest = 0.4999 * kPi;

double angleOf(const DirectionCap& cap) {
  return std::atan2(cap.sine, cap.cosine);
}

double angleBetween(const Vector3d& l, const Vector3d& r) {
  return std::atan2(l.cross(r).norm(), l.dot(r));
}

}  // namespace

double normalError(const SurfaceMesh& mesh, TriangleIndex triangle) {
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    longest =
        std::max(longest, (mesh.corner(triangle, (k + 1) % 3) - mesh.corner(triangle, k)).squaredNorm());
  }
  const Vector3d u = mesh.corner(triangle, 1) - mesh.corner(triangle, 0);
  const Vector3d v = mesh.corner(triangle, 2) - mesh.corner(triangle, 0);
  const double area = u.cross(v).norm();
  return area > 0.0 ? 1e-14 * longest / area : std::numeric_limits<double>::infinity();
}

DirectionCap capOfAngle(const Vector3d& axis, double angle) {
  const double widened = angle + kConeSlack;
  if (!(widened < kPi)) return {};
  return {axis, std::cos(widened), std::sin(widened)};
}

DirectionCap capAround(const DirectionCap& l, const DirectionCap& r) {
  if (l.isFull() || r.isFull()) return {};
  const double between = angleBetween(l.axis, r.axis);
  const double angle_l = angleOf(l);
  const double angle_r = angleOf(r);
  if (between + angle_r <= angle_l) return l;
  if (between + angle_l <= angle_r) return r;
  const double angle = 0.5 * (between + angle_l + angle_r) + 1e-14;
  if (!(angle < kPi)) return {};
  // On the great circle through both axes, `turn` from l's.
  const double turn = angle - angle_l;
  const Vector3d across = r.axis - l.axis.dot(r.axis) * l.axis;
  const double length = across.norm();
  if (!(length > 1e-12)) return between < 1.0 ? capOfAngle(l.axis, angle + between) : DirectionCap{};
  const Vector3d axis = (std::cos(turn) * l.axis + std::sin(turn) / length * across).normalized();
  return {axis, std::cos(angle), std::sin(angle)};
}

void ConeClipper::reset() {
  for (std::size_t face = 0; face < 6; ++face) {
    const auto axis = static_cast<Eigen::Index>(face / 2);
    const double height = face % 2 == 0 ? 1.0 : -1.0;
    Polygon& polygon = faces_[face];
    polygon.assign(4, Vector3d::Zero());
    for (std::size_t corner = 0; corner < 4; ++corner) {
      polygon[corner][axis] = height;
      polygon[corner][(axis + 1) % 3] = corner == 0 || corner == 3 ? -1.0 : 1.0;
      polygon[corner][(axis + 2) % 3] = corner < 2 ? -1.0 : 1.0;
    }
  }
}

void ConeClipper::clipPolygon(Polygon& polygon, const Vector3d& w, double slack) {
  clipped_.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d& here = polygon[i];
    const Vector3d& next = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double over_here = w.dot(here) - slack;
    const double over_next = w.dot(next) - slack;
    if (over_here <= 0.0) clipped_.push_back(here);
    if ((over_here < 0.0 && over_next > 0.0) || (over_here > 0.0 && over_next < 0.0)) {
      clipped_.push_back(here + over_here / (over_here - over_next) * (next - here));
    }
  }
  polygon.swap(clipped_);
}

void ConeClipper::clip(const Vector3d& w, double slack) {
  // The faces' points are up to sqrt(3) long: for unit vectors that is a slack of more than half.
  for (Polygon& polygon : faces_) {
    if (!polygon.empty() && polygon.size() <= kMostCorners) clipPolygon(polygon, w, 2.0 * slack);
  }
}

std::optional<DirectionCap> ConeClipper::capOnSide(const Vector3d& normal) {
  corners_.clear();
  for (const Polygon& polygon : faces_) {
    if (polygon.empty()) continue;
    side_ = polygon;
    clipPolygon(side_, -normal, 2.0 * kConeSlack);
    for (const Vector3d& corner : side_) corners_.push_back(corner.normalized());
  }
  if (corners_.empty()) return std::nullopt;
  Vector3d axis = Vector3d::Zero();
  for (const Vector3d& corner : corners_) axis += corner;
  if (!(axis.norm() > 1e-3 * static_cast<double>(corners_.size()))) return DirectionCap{};
  axis.normalize();
  double widest = 0.0;
  for (const Vector3d& corner : corners_) widest = std::max(widest, angleBetween(axis, corner));
  if (widest > kWidest) return DirectionCap{};
  return capOfAngle(axis, widest);
}

}  // namespace concave_distance::detail
