#include "waypoint_turns.h"

#include <cmath>

namespace concave_distance::detail {
namespace {

struct Turn {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  double angle = 0.0;
};

/// Returns the smaller turn from one rotation to another, in the axes of the first.
Turn turnBetween(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  Eigen::Quaterniond turn = from.conjugate() * to;
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  const double length = turn.vec().norm();
  if (!(length > 0.0)) return {};
  return {turn.vec() / length, 2.0 * std::atan2(length, turn.w())};
}

}  // namespace

std::array<PathElement, 2> addPoses(const std::vector<Eigen::Vector3d>& positions,
                                    const Quaternions& rotations, const Eigen::Isometry3d& before,
                                    MotionPaths& paths) {
  std::array<PathElement, 2> elements;
  elements[0].kind = PathElement::Kind::Shift;
  elements[0].before = before;
  elements[0].curve = paths.curves.size();
  for (Eigen::Index k = 0; k < 3; ++k) {
    std::vector<double> values;
    for (const Eigen::Vector3d& position : positions) values.push_back(position[k]);
    paths.curves.push_back(MotionCurve::straight(values));
  }
  WaypointTurns turns;
  std::vector<double> angles{0.0};
  for (std::size_t i = 0; i == 0 || i + 1 < rotations.size(); ++i) {
    turns.rotations.push_back(rotations[i].toRotationMatrix());
    const Turn turn = i + 1 < rotations.size() ? turnBetween(rotations[i], rotations[i + 1]) : Turn();
    turns.axes.push_back(turn.axis);
    if (i + 1 < rotations.size()) angles.push_back(angles.back() + turn.angle);
  }
  elements[1].kind = PathElement::Kind::Slerp;
  elements[1].curve = paths.curves.size();
  elements[1].turns = paths.turns.size();
  paths.curves.push_back(MotionCurve::straight(angles));
  paths.turns.push_back(std::move(turns));
  return elements;
}

}  // namespace concave_distance::detail
