#pragma once

#include <Eigen/Core>

#include "concave_distance/search/trial_point.h"
#include "scene_truth.h"

namespace concave_distance::evaluation {

/// Whether a descent over the nodes from this pair, in the scene's first pose, ends in the region of the
/// nearest niche (SurfaceRegions): where an answer is, however far above the optimum.
bool leadsToOptimum(const SceneTruth& scene, const TrialPoint& answer);

/// The same of points anywhere in the bodies, from the nodes nearest to them.
/// @param point_a, point_b each in its body's frame
bool leadsToOptimum(const SceneTruth& scene, const Eigen::Vector3d& point_a, const Eigen::Vector3d& point_b);

}  // namespace concave_distance::evaluation
