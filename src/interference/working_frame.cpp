#include "working_frame.h"

#include <algorithm>
#include <cmath>

#include "distance/bound/certificate.h"

namespace concave_distance::detail {
namespace {

/// A body's own origin, unless it lies so far off that coordinates from there would lose digits.
Eigen::Vector3d nearOrigin(const SurfaceMesh& surface) {
  const Eigen::Vector3d centre = surface.boundingBox().center();
  return centre.norm() <= surface.diameter() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : centre;
}

}  // namespace

void WorkingFrame::reset(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  body_[0] = &a;
  body_[1] = &b;
  a_from_b_ = a_from_b;
  rotation_ = a_from_b.linear();
  centre_[0] = nearOrigin(a.surface());
  centre_[1] = nearOrigin(b.surface());
  offset_ = rotation_ * centre_[1] + (a_from_b.translation() - centre_[0]);
  int exponent = 0;
  std::frexp(std::max(a.diameter(), b.diameter()), &exponent);
  scale_ = std::ldexp(1.0, std::clamp(1 - exponent, -1000, 1000));
  rounding_bound_ = kProofError * proofScale(a, b, a_from_b);
  if (++stamp_ == 0) {
    for (std::vector<std::uint32_t>& stamps : stamps_) std::fill(stamps.begin(), stamps.end(), 0U);
    stamp_ = 1;
  }
  for (const std::size_t side : {0U, 1U}) {
    const std::size_t count = body_[side]->surface().vertexCount();
    if (points_[side].size() < count) {
      points_[side].resize(count);
      stamps_[side].resize(count, 0U);
    }
  }
}

// Written out: with Eigen's products, how sums are rounded would depend on what it vectorises.
void WorkingFrame::computePoint(std::size_t side, NodeIndex vertex) {
  const Eigen::Vector3d v = body_[side]->surface().vertex(vertex) - centre_[side];
  Eigen::Vector3d& point = points_[side][vertex.value];
  for (int i = 0; i < 3; ++i) {
    const double sum =
        side == 0 ? v[i]
                  : ((rotation_(i, 0) * v[0] + rotation_(i, 1) * v[1]) + rotation_(i, 2) * v[2]) + offset_[i];
    point[i] = sum * scale_;
  }
  stamps_[side][vertex.value] = stamp_;
}

Eigen::Vector3d WorkingFrame::pointInBody(Side side, const Eigen::Vector3d& point) const {
  const Eigen::Vector3d relative = point / scale_;
  if (side == Side::A) return relative + centre_[0];
  return rotation_.transpose() * (relative - offset_) + centre_[1];
}

}  // namespace concave_distance::detail
