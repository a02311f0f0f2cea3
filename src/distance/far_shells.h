#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/distance/cone_sweep.h"
#include "minima_scene.h"

namespace concave_distance::detail {

/// The farthest points of both bodies, metres: no two are farther apart.
double largestDistance(const MinimaScene& scene);

/// Whether every path on the surfaces, wherever it leads, stays below the pass that would make a niche of its
/// own prominent: no two points are (1 + least prominence) times as far apart as two others. Then each pair
/// of shells has one niche, its nearest points. True from about 2 / (least prominence) times the bodies' size
/// on.
bool isFar(const MinimaScene& scene, double least_prominence);

/// Number of the pair of shells that two triangles belong to.
inline std::uint64_t shellPairOf(const MinimaScene& scene, TriangleIndex a, TriangleIndex b) {
  const std::uint64_t shell_a = scene.a.topology().shell_of_triangle[a.value];
  return (shell_a << 32U) | scene.b.topology().shell_of_triangle[b.value];
}

/// Triangles of a body by shell. Buffers of one thread.
struct TrianglesOfShells {
  std::vector<std::uint32_t> first;  ///< of every shell, and the end
  std::vector<TriangleIndex> triangles;
};

/// Whether a local minimum is the nearest place of its two shells: proven where the direction between its
/// points parts them by its distance, else not known. O(triangles).
bool isNearestOfItsShells(const MinimaScene& scene, const WitnessPair& minimum);

struct FarShellBuffers {
  TrianglesOfShells a;
  TrianglesOfShells b;
  RefinementWorkspace refinement;
};

/// Of every pair of shells the triangles that hold its nearest points, up to `cutoff`: supporting triangles
/// along the direction between the best points known, refined until that direction parts the two shells by
/// the distance itself. O(triangles) for each pair of shells and step; a few steps where isFar() holds.
/// @return false when a pair of shells resists or the limit strikes; `seeds` are then as before
bool collectFarSeeds(const MinimaScene& scene, double cutoff, FarShellBuffers& buffers,
                     std::vector<MinimumSeed>& seeds, WorkLimit& limit);

}  // namespace concave_distance::detail
