#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "distance/niches/local_minima.h"
#include "experiment_scene.h"
#include "thesis/src/continuous/constraint_tree.h"

namespace concave_distance::evaluation {

/// One pose with what answers are held against. Lengths in metres.
struct InstantTruth {
  Eigen::Isometry3d a_from_b;
  double time = 0.0;            ///< seconds
  double exact_distance = 0.0;  ///< of the surfaces, proven
  double node_distance = 0.0;   ///< of the best node pair, by enumeration
  /// A run has found the region of the optimum below this (Carretero, sec. 5.1.1): 1.1 times the best node
  /// pair's distance or that of the second niche of the surfaces, whichever is less.
  double region_limit = 0.0;
  /// The same for points anywhere: 1.1 times the exact distance or the second niche.
  double exact_region_limit = 0.0;
  /// Of the second niche; infinite when there is but one.
  double second_distance = std::numeric_limits<double>::infinity();
  double niche_cutoff = 0.0;  ///< infinite for the thesis's static poses: no niche is left out
  /// Of prominence 1e-2, up to `niche_cutoff`, ascending. Not all are niches (isNiche()); the others are
  /// there since what leads to one of them has found no niche.
  std::vector<LocalMinimum> minima;
  bool hidden_count = true;  ///< niches that a triangle hides are niches
};

/// A scene with what its answers are held against.
struct SceneTruth {
  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
  std::vector<InstantTruth> instants;    ///< one, or those of a motion
  std::optional<ConstraintTree> tree_a;  ///< of the continuous approach, from `trees` beside the meshes
  std::optional<ConstraintTree> tree_b;

  const InstantTruth& first() const { return instants.front(); }
};

/// Whether a minimum of the instant leaves the bodies outwards and is not hidden, where that counts.
bool isNiche(const InstantTruth& truth, const LocalMinimum& minimum);
std::size_t nicheCount(const InstantTruth& truth);

/// Whether a niche of this distance is the nearest of its instant, or as near as that: another corner of the
/// same rim.
bool isNearest(const InstantTruth& truth, double distance);

/// @param folder that holds the thesis's meshes and poses
/// @throws Error when a file is missing or wrong
SceneTruth loadScene(const ExperimentScene& scene, const std::string& folder);

}  // namespace concave_distance::evaluation
