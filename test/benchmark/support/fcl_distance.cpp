#include "benchmark/support/fcl_distance.h"

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

}  // namespace concave_distance::benchmark
