#include "benchmark/support/fcl_distance.h"

#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance-inl.h>
#include <fcl/narrowphase/distance-inl.h>

namespace concave_distance::benchmark {

std::shared_ptr<FclModel> makeFclModel(const SurfaceMesh& surface) {
  auto model = std::make_shared<FclModel>();
  model->beginModel(static_cast<int>(surface.triangleCount()), static_cast<int>(surface.vertexCount()));
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(surface.triangleCount());
  for (const TriangleNodes& t : surface.triangles()) {
    triangles.emplace_back(t[0].value, t[1].value, t[2].value);
  }
  model->addSubModel(surface.vertices(), triangles);
  model->endModel();
  return model;
}

FclAnswer fclDistance(const FclModel& a, const FclModel& b, const Eigen::Isometry3d& a_from_b) {
  fcl::DistanceRequest<double> request(true);
  fcl::DistanceResult<double> result;
  fcl::distance(&a, fcl::Transform3<double>(Eigen::Isometry3d::Identity()), &b,
                fcl::Transform3<double>(a_from_b), request, result);
  return {result.min_distance, result.nearest_points[0], result.nearest_points[1]};
}

FclAnswer fclDistanceSeeded(const FclModel& a, const FclModel& b, const Eigen::Isometry3d& a_from_b,
                            TriangleIndex triangle_a, TriangleIndex triangle_b) {
  const fcl::Triangle& ta = a.tri_indices[triangle_a.value];
  const fcl::Triangle& tb = b.tri_indices[triangle_b.value];
  Eigen::Vector3d corners_a[3];
  Eigen::Vector3d corners_b[3];
  for (int k = 0; k < 3; ++k) {
    corners_a[k] = a.vertices[ta[k]];
    corners_b[k] = a_from_b * b.vertices[tb[k]];
  }
  FclAnswer seed{};
  seed.distance = fcl::detail::TriangleDistance<double>::triDistance(corners_a, corners_b, seed.point_a_in_a,
                                                                     seed.point_b_in_a);
  fcl::DistanceRequest<double> request(true);
  fcl::DistanceResult<double> result;
  result.min_distance = seed.distance;
  result.nearest_points[0] = seed.point_a_in_a;
  result.nearest_points[1] = seed.point_b_in_a;
  fcl::distance(&a, fcl::Transform3<double>(Eigen::Isometry3d::Identity()), &b,
                fcl::Transform3<double>(a_from_b), request, result);
  return {result.min_distance, result.nearest_points[0], result.nearest_points[1]};
}

double fclTriangleDistance(const TrianglePoints& a, const TrianglePoints& b) {
  Eigen::Vector3d point_a;
  Eigen::Vector3d point_b;
  return fcl::detail::TriangleDistance<double>::triDistance(a.data(), b.data(), point_a, point_b);
}

}  // namespace concave_distance::benchmark
