#pragma once

#include <memory>
#include <utility>

#include "concave_distance/kinematics/scene_kinematics.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance::python {

/// Python has this as Scene; immutable.
struct PythonScene {
  explicit PythonScene(Scene loaded)
      : scene(std::move(loaded)), joints(std::make_shared<const SceneKinematics>(scene)) {}

  const Scene scene;
  const std::shared_ptr<const SceneKinematics> joints;
};
using ScenePointer = std::shared_ptr<PythonScene>;

}  // namespace concave_distance::python
