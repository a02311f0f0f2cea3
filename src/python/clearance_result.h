#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers.h"
#include "concave_distance/kinematics/clearance.h"

namespace concave_distance::python {

/// A row of Clearance.pairs: PairClearance.
struct ClearanceRow {
  std::int64_t body_a;  ///< in Scene.body_names
  std::int64_t body_b;
  double lower_bound;
  double distance;
  double time;
};

/// Python has this as Clearance.
struct PythonClearance {
  PythonClearance(const Scene& scene, ClearanceResult found);

  ClearanceResult result;
  std::vector<ClearanceRow> pairs;
  std::optional<Answers> solution;
  std::vector<std::string> body_names;  ///< of the scene
};

}  // namespace concave_distance::python
