#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/distance/cone_sweep.h"
#include "minima_scene.h"

namespace concave_distance::detail {

/// An upper bound of the distance of any two points, metres.
double largestDistance(const MinimaScene& scene);

/// Whether no minimum can be prominent beside the nearest points: no two points are (1 + least prominence)
/// times as far apart as two others. Then each pair of shells has one niche, its nearest points. True from a
/// distance of about 2 / (least prominence) times the bodies' size.
bool isFar(const MinimaScene& scene, double least_prominence);

/// The number of the pair of shells of two triangles.
inline std::uint64_t shellPairOf(const MinimaScene& scene, TriangleIndex a, TriangleIndex b) {
  const std::uint64_t shell_a = scene.a.topology().shell_of_triangle[a.value];
  return (shell_a << 32U) | scene.b.topology().shell_of_triangle[b.value];
}

/// Triangles of a body by shell. Buffers of one thread.
struct TrianglesOfShells {
  std::vector<std::uint32_t> first;  ///< of every shell, and the end
  std::vector<TriangleIndex> triangles;
};

/// Whether a local minimum is proven to be the nearest place of its two shells: the direction between its
/// points separates them by its distance. O(triangles).
bool isNearestOfItsShells(const MinimaScene& scene, const WitnessPair& minimum);

struct FarShellBuffers {
  TrianglesOfShells a;
  TrianglesOfShells b;
  RefinementWorkspace refinement;
};

/// Finds for every pair of shells the triangles with its nearest points, up to `cutoff`: supporting triangles
/// along the direction between the best points so far, repeated until that direction separates the shells by
/// the distance itself. O(triangles) for each pair of shells and step; a few steps if isFar() holds.
/// @return false when a pair of shells does not converge or the limit is reached; `seeds` are then unchanged
bool collectFarSeeds(const MinimaScene& scene, double cutoff, FarShellBuffers& buffers,
                     std::vector<MinimumSeed>& seeds, WorkLimit& limit);

}  // namespace concave_distance::detail
