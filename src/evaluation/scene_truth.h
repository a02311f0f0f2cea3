#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <optional>

#include "concave_distance/continuous/constraint_tree.h"
#include "concave_distance/distance/local_minima.h"
#include "concave_distance/mesh/body_mesh.h"
#include "experiment.h"

namespace concave_distance::evaluation {

/// A scene with what its answers are held against.
struct SceneTruth {
  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
  Eigen::Isometry3d a_from_b;
  double exact_distance = 0.0;  ///< of the surfaces, proven; metres
  double node_distance = 0.0;   ///< of the best node pair, by enumeration; metres
  /// A run has found the region of the optimum below this (Carretero, sec. 5.1.1): 1.1 times the best node
  /// pair's distance or that of the second niche of the surfaces, whichever is less. Metres.
  double region_limit = 0.0;
  /// The same for points anywhere: 1.1 times the exact distance or the second niche.
  double exact_region_limit = 0.0;
  /// Of the second niche, metres; infinite when there is but one.
  double second_distance = std::numeric_limits<double>::infinity();
  std::optional<ConstraintTree> tree_a;  ///< of the continuous approach, from `trees` beside the meshes
  std::optional<ConstraintTree> tree_b;
  LocalMinima niches;  ///< outward, of prominence 1e-2, up to `niche_cutoff`
  double niche_cutoff = 0.0;
};

/// @param folder that holds the thesis's meshes and poses
/// @throws Error when a file is missing or wrong
SceneTruth loadScene(const ExperimentScene& scene, const std::string& folder);

}  // namespace concave_distance::evaluation
