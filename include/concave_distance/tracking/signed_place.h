#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "concave_distance/base/not_computed.h"

namespace concave_distance {

/// Says whether a niche has a signed value, or why not.
enum class SignedState : std::uint8_t {
  NotAsked,       ///< TrackerParameters::signed_values is off, or the level is `nodes`
  Known,          ///< the value is there
  OpenSurface,    ///< the surfaces that meet there bound no solid: there is no depth
  CrossedShells,  ///< shells or parts of one body meet one another, some of the surface may be no boundary
  NoClosedForm,   ///< of a round solid: a cylinder in a mesh, or one that is deeper than its core or centre
  Unfinished      ///< a limit was reached first
};

/// One value for a place through contact: the distance of the bare surfaces while they are apart, minus the
/// greatest depth of the region of overlap that the niche has become. It changes by no more than the bodies
/// move but where regions of overlap merge or split. What is not known is NaN.
struct SignedPlace {
  SignedState state = SignedState::NotAsked;
  double value = kNotComputed;  ///< metres, margins not taken off
  /// It is attained between these: in an overlap one lies inside the other body, and the other is the closest
  /// point of that body's surface.
  Eigen::Vector3d point_a_in_a = Eigen::Vector3d::Constant(kNotComputed);
  Eigen::Vector3d point_b_in_a = Eigen::Vector3d::Constant(kNotComputed);
  /// The point that the gradient is of: d value / dt = gradient . (velocity of B less that of A, there).
  Eigen::Vector3d pivot_in_a = Eigen::Vector3d::Constant(kNotComputed);
  /// Unit, from A to B, except where the deepest point is held between several walls: then shorter, and 0 in
  /// the middle of a plate. Where several places are as deep it is that of one of them.
  Eigen::Vector3d gradient_in_a = Eigen::Vector3d::Constant(kNotComputed);
  /// Age begins here: the first of the pair's cycles since which no cycle has changed the value by more than
  /// B moved. Regions that merge or split, births, and cycles without a value begin it anew.
  std::uint64_t since_cycle = 0;
};

}  // namespace concave_distance
