#pragma once

#include <cstdint>
#include <vector>

#include "working_frame.h"

namespace concave_distance::detail {

/// Counts how often the closed shells of the other body wind around a point of the body `body` (working
/// frame), exactly and with the same infinitesimal motion as all else: 1 inside, 0 outside for a body whose
/// shells do not overlap. It counts the crossings of a segment that leads out. O(log n) on ordinary meshes.
class Containment {
 public:
  int winding(WorkingFrame& frame, PerturbedPredicates& predicates, Side body, const Eigen::Vector3d& point);

 private:
  std::vector<std::uint32_t> stack_;
};

}  // namespace concave_distance::detail
