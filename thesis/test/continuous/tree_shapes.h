#pragma once

#include <Eigen/Core>
#include <string>

#include "thesis/src/continuous/constraint_tree.h"

/// Trees by hand. Metres.
namespace concave_distance::test {

inline constexpr double kTreeTolerance = 1e-12;

inline PieceDescription boxPiece(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  PieceDescription piece;
  for (int axis = 0; axis < 3; ++axis) {
    piece.constraints.push_back({Eigen::Vector3d::Unit(axis), -low[axis]});
    piece.constraints.push_back({-Eigen::Vector3d::Unit(axis), high[axis]});
  }
  return piece;
}

inline ConstraintTree boxTree(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return ConstraintTree(boxPiece(low, high), {low, high}, kTreeTolerance, "box");
}

/// The cube [0, 4]^3 with a pit of the square [1, 3]^2 from the top down to z = 1, in which a post of the
/// square [1.5, 2.5]^2 stands up to z = 2. The pit's mouth in the cube's top is no constraint of the pit.
inline ConstraintTree pitWithPost() {
  PieceDescription cube = boxPiece({0, 0, 0}, {4, 4, 4});
  PieceDescription pit = boxPiece({1, 1, 1}, {3, 3, 4});
  pit.constraints.pop_back();
  pit.children.push_back(boxPiece({1.5, 1.5, 1}, {2.5, 2.5, 2}));
  cube.children.push_back(pit);
  return ConstraintTree(cube, {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 4, 4)}, kTreeTolerance, "pit");
}

inline bool insidePitWithPost(const Eigen::Vector3d& p) {
  const auto within = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  };
  const bool in_pit = p.x() > 1 && p.x() < 3 && p.y() > 1 && p.y() < 3 && p.z() > 1;
  return within({0, 0, 0}, {4, 4, 4}) && (!in_pit || within({1.5, 1.5, 1}, {2.5, 2.5, 2}));
}

}  // namespace concave_distance::test
