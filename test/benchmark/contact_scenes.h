#pragma once

#include <functional>
#include <string>
#include <vector>

#include "benchmark/support/contact_report.h"

namespace concave_distance::benchmark {

/// A scene of contact with a closed form or a bound; reports one row for each figure.
struct ContactScene {
  std::string name;
  std::string about;
  std::function<void(SceneReport&)> run;
};
using ContactScenes = std::vector<ContactScene>;

ContactScenes overlapScenes();    ///< press fits and pegs: depth, normal and force of regions that bend
ContactScenes impactScenes();     ///< thin walls, bounces
ContactScenes restScenes();       ///< corners, stacks, heavy on light
ContactScenes frictionScenes();   ///< spinning, twisting, a swinging load
ContactScenes rollingScenes();    ///< round bodies
ContactScenes elasticScenes();    ///< balls without loss at three scales, friction on and off
ContactScenes balanceScenes();    ///< momentum, order of convergence, works
ContactScenes untouchedScenes();  ///< a pair that asks for no effects
ContactScenes speedScenes();      ///< scenes of config/, regions of large meshes

}  // namespace concave_distance::benchmark
