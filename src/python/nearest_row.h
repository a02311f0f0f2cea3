#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "arrays.h"
#include "concave_distance/scene/cycle_counts.h"
#include "concave_distance/scene/scene_tracker.h"

namespace concave_distance::python {

/// A row of what SceneTracker.nearest() returns. Metres, world frame.
struct NearestRow {
  double distance = kNotComputed;  ///< of the nearest pair that has one
  double lower_bound = kNotComputed;
  bool is_minimum = false;   ///< no pair can be nearer
  std::uint8_t status = 0;   ///< SolveStatus of the pair
  std::int64_t body_a = -1;  ///< in Scene.body_names
  std::int64_t body_b = -1;
  Triple point_a = kUnknownPoint;
  Triple point_b = kUnknownPoint;
  Triple normal = kUnknownPoint;
};

/// Finds the nearest of all pairs of a cycle.
NearestRow nearestOf(const SceneTracker& tracker,
                     const std::vector<std::optional<Eigen::Isometry3d>>& world_from_body);

}  // namespace concave_distance::python
