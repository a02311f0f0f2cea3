#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

#include "convex_piece.h"

namespace concave_distance {

/// Points of two pieces, each in its own body's frame, metres.
struct PiecePoints {
  Eigen::Vector3d on_a;
  Eigen::Vector3d on_b;
};

/// What a solver of one pair of pieces proposes.
struct PieceProposal {
  PiecePoints points;
  std::uint32_t iterations = 0;  ///< of the solver; 0 where it does not count them
  bool failed = false;           ///< the points are no answer, only feasible
};

/// The distance of two convex pieces. lower_bound <= true distance <= distance.
struct PieceDistance {
  double distance;     ///< metres; 0 when they meet
  double lower_bound;  ///< gap of the two pieces' shadows along the line between the points; >= 0
  PiecePoints points;
  std::uint32_t iterations = 0;
  bool finished = false;  ///< the solver's points were not good enough: triangles of the facets said the rest
  bool proven = false;    ///< distance - lower_bound is within kPieceDistanceTolerance of the scale
};

/// What an answer may be off by, relative to the pieces' radii and the distance of their centres together.
inline constexpr double kPieceDistanceTolerance = 1e-10;

/// How far the pieces' shadows are apart along a direction (A's frame, unit, from A to B), metres: a lower
/// bound of their distance, negative when the shadows overlap. O(corners).
double shadowGap(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b,
                 const Eigen::Vector3d& direction_in_a);

/// The scale that the tolerance is relative to, metres.
double pieceScale(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b);

/// Judges a proposal: a solver's own word is not needed, since the shadows along the line between its points
/// bound the distance from below. Where the bound is farther off than the tolerance (facets almost parallel,
/// a solver that failed), the distance of the facets' triangles decides: those at the points first, all if
/// need be. Never throws. Allocates nothing.
PieceDistance judgeProposal(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b,
                            const PieceProposal& proposal);

}  // namespace concave_distance
