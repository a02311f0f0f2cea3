#include "leaf_pair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "distance/kernels/prepared_triangle.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

Lanes along(const Vector3d& direction, const Lanes (&point)[3]) {
  return direction.x() * point[0] + direction.y() * point[1] + direction.z() * point[2];
}

Lanes along(const Lanes (&direction)[3], const Vector3d& point) {
  return direction[0] * point.x() + direction[1] * point.y() + direction[2] * point.z();
}

Lanes along(const Lanes (&direction)[3], const Lanes (&point)[3]) {
  return direction[0] * point[0] + direction[1] * point[1] + direction[2] * point[2];
}

}  // namespace

LeafLanes::LeafLanes(const BoundingVolumeHierarchy::Leaf& leaf, const Eigen::Matrix3d& rotation,
                     const Vector3d& offset) {
  for (int k = 0; k < 3; ++k) {
    const Lanes x = lanes(leaf.corner[k][0]);
    const Lanes y = lanes(leaf.corner[k][1]);
    const Lanes z = lanes(leaf.corner[k][2]);
    for (int c = 0; c < 3; ++c) {
      corner[k][c] = rotation(c, 0) * x + rotation(c, 1) * y + rotation(c, 2) * z + offset[c];
    }
  }
}

void LeafLanes::computeNormals() {
  Lanes u[3];
  Lanes v[3];
  for (int c = 0; c < 3; ++c) {
    u[c] = corner[1][c] - corner[0][c];
    v[c] = corner[2][c] - corner[0][c];
  }
  squared_normal = Lanes::Zero();
  for (int c = 0; c < 3; ++c) {
    const int next = (c + 1) % 3;
    const int last = (c + 2) % 3;
    normal[c] = u[next] * v[last] - u[last] * v[next];
    squared_normal += normal[c].square();
  }
}

TrianglePoints LeafLanes::triangle(std::size_t lane) const {
  TrianglePoints points;
  const auto i = static_cast<Eigen::Index>(lane);
  for (std::size_t k = 0; k < 3; ++k) points[k] = {corner[k][0][i], corner[k][1][i], corner[k][2][i]};
  return points;
}

Vector3d sumOfNormals(const BoundingVolumeHierarchy::Leaf& leaf) {
  Lanes u[3];
  Lanes v[3];
  for (int c = 0; c < 3; ++c) {
    u[c] = lanes(leaf.corner[1][c]) - lanes(leaf.corner[0][c]);
    v[c] = lanes(leaf.corner[2][c]) - lanes(leaf.corner[0][c]);
  }
  return {(u[1] * v[2] - u[2] * v[1]).sum(), (u[2] * v[0] - u[0] * v[2]).sum(),
          (u[0] * v[1] - u[1] * v[0]).sum()};
}

Vector3d sumOfNormals(const LeafLanes& leaf) {
  return {leaf.normal[0].sum(), leaf.normal[1].sum(), leaf.normal[2].sum()};
}

Lanes leastAlong(const LeafLanes& leaf, const Vector3d& direction) {
  return along(direction, leaf.corner[0])
      .min(along(direction, leaf.corner[1]))
      .min(along(direction, leaf.corner[2]));
}

Lanes mostAlong(const BoundingVolumeHierarchy::Leaf& leaf, const Vector3d& direction) {
  return along(direction, leaf.corner[0])
      .max(along(direction, leaf.corner[1]))
      .max(along(direction, leaf.corner[2]));
}

Lanes planeSeparation(const TrianglePoints& a, const LeafLanes& b) {
  // A gap g along a direction of length l separates by g / l; all corners' heights are taken along it, so
  // that it need not be the plane's normal to the last digit.
  const Vector3d normal = (a[1] - a[0]).cross(a[2] - a[0]);
  const double a0 = normal.dot(a[0]);
  const double a1 = normal.dot(a[1]);
  const double a2 = normal.dot(a[2]);
  const Lanes b0 = along(normal, b.corner[0]);
  const Lanes b1 = along(normal, b.corner[1]);
  const Lanes b2 = along(normal, b.corner[2]);
  const Lanes above = b0.min(b1).min(b2) - std::max({a0, a1, a2});
  const Lanes below = std::min({a0, a1, a2}) - b0.max(b1).max(b2);

  const Lanes own0 = along(b.normal, b.corner[0]);
  const Lanes own1 = along(b.normal, b.corner[1]);
  const Lanes own2 = along(b.normal, b.corner[2]);
  const Lanes other0 = along(b.normal, a[0]);
  const Lanes other1 = along(b.normal, a[1]);
  const Lanes other2 = along(b.normal, a[2]);
  const Lanes over = other0.min(other1).min(other2) - own0.max(own1).max(own2);
  const Lanes under = own0.min(own1).min(own2) - other0.max(other1).max(other2);

  // A triangle without area has no plane: its gap is 0 as well.
  constexpr double kLeast = std::numeric_limits<double>::min();
  const Lanes by_a = above.max(below).max(0.0) / std::sqrt(std::max(normal.squaredNorm(), kLeast));
  const Lanes by_b = over.max(under).max(0.0) / b.squared_normal.max(kLeast).sqrt();
  return by_a.max(by_b);
}

double separationAlong(const BoundingVolumeHierarchy::Leaf& leaf_a,
                       const BoundingVolumeHierarchy::Leaf& leaf_b, const Vector3d& direction,
                       const ProofFrame& frame) {
  return direction.dot(frame.offset) - mostAlong(leaf_a, direction).maxCoeff() -
         mostAlong(leaf_b, -(frame.turned * direction)).maxCoeff() - frame.scale.slack;
}

double separationAlongNormals(const BoundingVolumeHierarchy::Leaf& leaf_a, const LeafLanes& b, double slack,
                              double enough, Vector3d& parting) {
  const Vector3d apart = b.triangle(0)[0] - triangleOf(leaf_a, 0)[0];
  for (const Vector3d& sum : {sumOfNormals(leaf_a), sumOfNormals(b)}) {
    if (!(sum.squaredNorm() > kLeastSquare)) continue;
    const Vector3d normal = sum / (sum.dot(apart) < 0.0 ? -sum.norm() : sum.norm());
    const double separation = leastAlong(b, normal).minCoeff() - mostAlong(leaf_a, normal).maxCoeff() - slack;
    if (separation < enough) continue;
    parting = normal;
    return separation;
  }
  return 0.0;
}

TrianglePair nearestByCentres(const BoundingVolumeHierarchy::Leaf& leaf_a,
                              const BoundingVolumeHierarchy::Leaf& leaf_b, const ProofFrame& frame) {
  const LeafLanes b(leaf_b, frame.rotation, frame.offset);
  TrianglePair nearest{};
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < leaf_a.count; ++i) {
    const TrianglePoints a = triangleOf(leaf_a, i);
    const Vector3d sum = a[0] + a[1] + a[2];
    Lanes squared = Lanes::Zero();
    for (int c = 0; c < 3; ++c) {
      squared += (b.corner[0][c] + b.corner[1][c] + b.corner[2][c] - sum[c]).square();
    }
    for (std::uint32_t lane = 0; lane < leaf_b.count; ++lane) {
      if (squared[lane] < least) {
        least = squared[lane];
        nearest = {leaf_a.triangle[i], leaf_b.triangle[lane]};
      }
    }
  }
  return nearest;
}

}  // namespace concave_distance::detail
