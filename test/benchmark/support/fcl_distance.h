#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>

#include <Eigen/Geometry>
#include <memory>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "distance/kernels/triangle_distance.h"

namespace concave_distance::benchmark {

/// A surface as FCL holds it: the yardstick that everybody can rerun (FCL 0.7, OBBRSS hierarchy, its
/// default).
using FclModel = fcl::BVHModel<fcl::OBBRSS<double>>;
std::shared_ptr<FclModel> makeFclModel(const SurfaceMesh& surface);

struct FclAnswer {
  double distance;  ///< 0 or below when the surfaces meet
  Eigen::Vector3d point_a_in_a;
  Eigen::Vector3d point_b_in_a;
};
FclAnswer fclDistance(const FclModel& a, const FclModel& b, const Eigen::Isometry3d& a_from_b);
/// The same, begun with the distance of one pair of triangles: the only warm start FCL offers between meshes.
FclAnswer fclDistanceSeeded(const FclModel& a, const FclModel& b, const Eigen::Isometry3d& a_from_b,
                            TriangleIndex triangle_a, TriangleIndex triangle_b);
/// Of two triangles, in double precision and as naive as it is fast.
double fclTriangleDistance(const TrianglePoints& a, const TrianglePoints& b);

}  // namespace concave_distance::benchmark
