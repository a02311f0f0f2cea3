#pragma once

#include <vector>

#include "support/exact_triangle_distance.h"

/// The connected parts of the overlap of two bodies in long double: each triangle is cut by the planes of
/// those that it meets, and the pieces inside the other body that touch each other are one part. What is
/// inside is told by solid angles. Shares no code with the package.
namespace concave_distance::test {

/// Triangles in one frame with the other body's.
struct WideSurface {
  std::vector<ExactTriangle<long double>> triangles;
  std::vector<bool> is_closed;  ///< of each, whether its shell bounds a solid
};

/// For each pair of triangles, i * (triangles of b) + j: the number of the part in which they meet, or -1
/// where they do not. Pairs on one curve, with nothing inside beside it, have numbers of their own.
/// @param tolerance metres: what is no farther apart meets
std::vector<int> overlapPartsOfPairs(const WideSurface& a, const WideSurface& b, long double tolerance);

}  // namespace concave_distance::test
