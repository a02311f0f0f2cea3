#include "round_corners.h"

#include <algorithm>
#include <cmath>

#include "distance/bound/closest_point.h"
#include "distance/kernels/witness_refinement.h"
#include "mesh/surface/round_geometry.h"

namespace concave_distance {
namespace {

using Eigen::Vector3d;

constexpr int kRounds = 4;           // a plane's normal is found in the first, its point in the second
constexpr double kAlongSide = 0.5;   // of the axis in the normal: below it the side is near, above it an end
constexpr double kAtRim = 0.9;       // of the radius: a corner farther out is one of the disc's rim
constexpr double kSamePlace = 1e-9;  // of the bodies

/// The solid and the mesh in the solid's axes.
class RoundPlaces {
 public:
  RoundPlaces(const RoundShape& shape, const BodyMesh& mesh, TriangleIndex hint,
              const Eigen::Isometry3d& shape_from_mesh)
      : shape_(shape), mesh_(mesh), hint_(hint), shape_from_mesh_(shape_from_mesh) {}

  /// Moves a corner of the inscribed mesh to the solid. @param normal from the solid to the mesh
  void settle(const Vector3d& corner, Vector3d normal, Vector3d& on_shape, Vector3d& on_mesh) const {
    const Eigen::Isometry3d mesh_from_shape = shape_from_mesh_.inverse();
    const bool is_end = std::abs(normal.z()) > kAlongSide && detail::hasFlatEnds(shape_);
    for (int round = 0; round < kRounds; ++round) {
      on_shape = is_end ? onEnd(corner, normal) : onSide(corner, normal);
      on_mesh = shape_from_mesh_ * closestPoint(mesh_, mesh_from_shape * on_shape, hint_).point;
      if (is_end || !((on_mesh - on_shape).norm() > 0.0)) return;
      normal = (on_mesh - on_shape).normalized();
    }
  }

  /// Leads the closest points to where each is the closest to the other. @param normal as settle()
  void settleClosest(Vector3d normal, Vector3d& on_shape, Vector3d& on_mesh) const {
    const Eigen::Isometry3d mesh_from_shape = shape_from_mesh_.inverse();
    for (int round = 0; round < kRounds; ++round) {
      on_shape = detail::supportPoint(shape_, normal);
      on_mesh = shape_from_mesh_ * closestPoint(mesh_, mesh_from_shape * on_shape, hint_).point;
      if (!((on_mesh - on_shape).norm() > 0.0)) return;
      normal = (on_mesh - on_shape).normalized();
    }
  }

 private:
  Vector3d onEnd(const Vector3d& corner, const Vector3d& normal) const {
    const double radius = corner.head<2>().norm();
    const double scale = radius > kAtRim * shape_.radius ? shape_.radius / radius : 1.0;
    return {scale * corner.x(), scale * corner.y(), std::copysign(shape_.half_length, normal.z())};
  }
  Vector3d onSide(const Vector3d& corner, const Vector3d& normal) const {
    const Vector3d core(0.0, 0.0, std::clamp(corner.z(), -shape_.half_length, shape_.half_length));
    const Vector3d out = detail::hasFlatEnds(shape_) ? Vector3d(normal.x(), normal.y(), 0.0) : normal;
    return core + shape_.radius * out.normalized();
  }

  const RoundShape& shape_;
  const BodyMesh& mesh_;
  TriangleIndex hint_;  ///< of the mesh, near its points
  const Eigen::Isometry3d& shape_from_mesh_;
};

}  // namespace

std::size_t findRoundCorners(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                             const WitnessPair& witness, double tolerance, double least_length,
                             std::size_t pair_limit, std::size_t ring_limit, CornerWorkspace& workspace,
                             CornerPairs& corners) {
  const bool a_is_round = a.shape() != nullptr;
  if (a_is_round == (b.shape() != nullptr)) return 0;
  const RoundShape& shape = a_is_round ? *a.shape() : *b.shape();
  if (!detail::hasSide(shape)) return 0;
  const WitnessPair of_meshes =
      refineWitness(a, b, a_from_b, witness.triangle_a, witness.triangle_b, workspace.extent.ring).witness;
  const std::size_t found = findCorners(a, b, a_from_b, of_meshes, tolerance, least_length, pair_limit,
                                        ring_limit, workspace, corners);
  const Eigen::Isometry3d a_from_shape =
      a_is_round ? shape.body_from_shape : a_from_b * shape.body_from_shape;
  const Eigen::Isometry3d shape_from_a = a_from_shape.inverse();
  const Eigen::Isometry3d shape_from_mesh =
      a_is_round ? Eigen::Isometry3d(shape_from_a * a_from_b) : shape_from_a;
  const RoundPlaces places(shape, a_is_round ? b : a, a_is_round ? witness.triangle_b : witness.triangle_a,
                           shape_from_mesh);
  const Vector3d from_a = shape_from_a.linear() * (witness.point_b_in_a - witness.point_a_in_a).normalized();
  const double same = kSamePlace * (a.diameter() + b.diameter());
  const Vector3d outwards = a_is_round ? from_a : Vector3d(-from_a);
  std::size_t count = 0;
  const auto add = [&](const Vector3d& on_shape, const Vector3d& on_mesh) {
    const Vector3d in_a = a_from_shape * on_shape;
    const Vector3d mesh_in_a = a_from_shape * on_mesh;
    const CornerPair settled{a_is_round ? in_a : mesh_in_a, a_is_round ? mesh_in_a : in_a,
                             (on_mesh - on_shape).norm()};
    const bool is_known = std::any_of(
        corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(count),
        [&](const CornerPair& other) { return (other.point_a_in_a - settled.point_a_in_a).norm() <= same; });
    if (!is_known) corners[count++] = settled;
  };
  Vector3d on_shape;
  Vector3d on_mesh;
  for (std::size_t i = 0; i < found; ++i) {
    places.settle(shape_from_a * (a_is_round ? corners[i].point_a_in_a : corners[i].point_b_in_a), outwards,
                  on_shape, on_mesh);
    add(on_shape, on_mesh);
  }
  if (found == 0) return 0;
  places.settleClosest(outwards, on_shape, on_mesh);
  const double distance = (on_mesh - on_shape).norm();
  const auto end = corners.begin() + static_cast<std::ptrdiff_t>(count);
  const bool is_nearest =
      std::all_of(corners.begin(), end, [&](const CornerPair& corner) { return distance < corner.distance; });
  if (is_nearest && distance <= std::sqrt(witness.squared_distance) + same) add(on_shape, on_mesh);
  return count;
}

}  // namespace concave_distance
