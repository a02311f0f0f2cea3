#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "concave_distance/contact/friction.h"
#include "contact/contact_patch.h"
#include "contact/turning_friction.h"

namespace concave_distance {

/// Holds what is kept of a region from cycle to cycle.
struct RegionMemory {
  std::uint64_t id = 0;
  Eigen::Vector3d point_in_a = Eigen::Vector3d::Zero();
  double reach = 0.0;                                     ///< metres: how wide the region was
  Eigen::Vector3d normal_in_a = Eigen::Vector3d::Zero();  ///< zero: not known yet
  BristleState bristles;                                  ///< of a lumped force
  TurningBristles turning;
  PatchMemory patch;  ///< of a pressure
};

}  // namespace concave_distance
