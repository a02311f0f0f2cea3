#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "pose_arrays.h"
#include "python_scene.h"

namespace concave_distance::python {

/// Joint positions of a scene's robots, and where the robots stand, as Python gives them.
class JointPositions {
 public:
  /// Reads (p,) or (n, p) positions and (r, 4, 4) or (r, 7) roots, or None for roots at the world's origin.
  /// @throws Error naming the argument
  JointPositions(const PythonScene& scene, const pybind11::object& positions, const pybind11::object& roots);

  bool isArray() const { return numbers_.ndim() == 2; }
  std::size_t count() const { return isArray() ? static_cast<std::size_t>(numbers_.shape(0)) : 1; }
  /// Needs no lock of the interpreter, as placeRoots().
  Eigen::Map<const Eigen::VectorXd> row(std::size_t index) const;
  void placeRoots(SceneState& state) const;

 private:
  DoubleArray numbers_;
  std::size_t width_;
  std::vector<Eigen::Isometry3d> world_from_root_;  ///< empty: at the origin
};

}  // namespace concave_distance::python
