#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/search/trial_point.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance::benchmark {

/// The list that is proven: prominence 1e-2 or more, below 5 times the distance or a quarter of the smaller
/// body, whichever is more.
std::vector<TrackedNiche> provenNiches(const std::string& name, const std::shared_ptr<const BodyMesh>& a,
                                       const std::shared_ptr<const BodyMesh>& b,
                                       const Eigen::Isometry3d& pose);

/// Share of the niches that minima of the grids are refined to: the same distance, and the same point unless
/// the niche has an extent. 1 when there are none.
double shareMet(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& pose,
                const std::vector<TrackedNiche>& niches, const std::vector<TrialPoint>& minima);

}  // namespace concave_distance::benchmark
