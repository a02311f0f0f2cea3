#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "thesis/src/continuous/constraint_tree.h"

namespace concave_distance::benchmark {

/// Two constraint trees at one pose, and where the region of the global minimum ends.
struct ContinuousScene {
  std::string name;
  ConstraintTree a;
  ConstraintTree b;
  Eigen::Isometry3d a_from_b;
  double minimum;         ///< d*, metres, exact
  double region_ends_at;  ///< 1.1 d* or the second minimum, metres
};

/// The five scenes of meshes/thesis, and `pit`: a rod that hangs in a pit beside a post, walls and post of
/// which attract more than the nearer floor does.
std::vector<std::string> continuousSceneNames();
ContinuousScene loadContinuousScene(const std::string& name);

/// Two bodies at random poses around each other, not in contact.
struct HeldOutPair {
  std::string name;
  double size;  ///< mean diameter, metres
  std::vector<ContinuousScene> scenes;
};
std::vector<HeldOutPair> heldOutPairs(std::uint32_t poses);

}  // namespace concave_distance::benchmark
