#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace concave_distance {

/// A convex polyhedron: one piece of a partitioned body. Body frame, metres.
struct ConvexPiece {
  std::vector<Eigen::Vector3d> vertices;  ///< its corners
  /// Corners of each facet, counter-clockwise seen from outside, each at least three.
  std::vector<std::vector<std::uint32_t>> facets;
  /// One half-space a facet, A p + b >= 0 inside, rows of A of unit length pointing inwards (Carretero, eq.
  /// (2.1), (6.4b) with b's sign as in (2.1)). b is the least that no corner violates.
  Eigen::Matrix<double, Eigen::Dynamic, 3> normals;
  Eigen::VectorXd offsets;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< mean of the corners
  double radius = 0.0;                               ///< of the sphere around `centre` that holds the piece
};

/// Derives the half-spaces, centre and radius from corners and facets.
/// @throws Error (naming `where`) when there are fewer than four corners or facets, an index is out of range,
///   a facet is bent, or a corner lies outside of a facet by more than `tolerance` of the piece's radius
ConvexPiece makeConvexPiece(std::vector<Eigen::Vector3d> vertices,
                            std::vector<std::vector<std::uint32_t>> facets, const std::string& where,
                            double tolerance = 1e-7);

/// The same from facets whose outward directions are known better than rounded corners can say (slivers).
/// Nothing is checked but the indices. @param outward one direction a facet, of any length but zero
ConvexPiece makeConvexPiece(std::vector<Eigen::Vector3d> vertices,
                            std::vector<std::vector<std::uint32_t>> facets,
                            const std::vector<Eigen::Vector3d>& outward, const std::string& where);

/// Metres^3, from the facets. O(corners).
double volume(const ConvexPiece& piece);

/// How deep a point (body frame) lies inside: the least of A p + b, metres; negative outside, where it is at
/// most the distance in size.
double depth(const ConvexPiece& piece, const Eigen::Vector3d& point);

/// How far the piece reaches along a direction (body frame, unit): the largest direction . corner, metres.
double support(const ConvexPiece& piece, const Eigen::Vector3d& direction);

/// A body as the union of convex pieces whose interiors are disjoint.
struct ConvexPartition {
  std::string name;
  std::vector<ConvexPiece> pieces;
};

}  // namespace concave_distance
