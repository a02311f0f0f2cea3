#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "distance/kernels/pair_frame.h"
#include "distance/kernels/witness_refinement.h"
#include "niche_rule.h"

namespace concave_distance::detail {

/// An upper bound of the distance of any two points, metres.
double largestDistance(const PairFrame& frame);

/// True when the bodies are so far apart that no minimum can be prominent beside the nearest points: then
/// each pair of pieces has one niche, its nearest points. So it is from about 2 / (least prominence) times
/// the bodies' size on.
bool isFar(const PairFrame& frame, const NicheRule& rule);

/// Triangles of a body by piece. Buffers of one thread.
struct TrianglesOfPieces {
  std::vector<std::uint32_t> first;  ///< of every piece, and the end
  std::vector<TriangleIndex> triangles;
};

/// Returns whether a local minimum is proven to be the nearest place of its two pieces: the direction between
/// its points separates them by its distance. O(triangles).
bool isNearestOfItsPieces(const PairFrame& frame, const WitnessPair& minimum);

struct DistantComponentBuffers {
  TrianglesOfPieces a;
  TrianglesOfPieces b;
  RefinementWorkspace refinement;
};

/// Finds for every pair of pieces the triangles with its nearest points, up to `cutoff`: supporting triangles
/// along the direction between the best points so far, repeated until that direction separates the pieces by
/// the distance itself. O(triangles) for each pair of pieces and step; a few steps if isFar() holds.
/// @return false when a pair of pieces does not converge or the limit is reached; `candidates` are then
/// unchanged
bool collectFarCandidates(const PairFrame& frame, double cutoff, DistantComponentBuffers& buffers,
                          std::vector<MinimumCandidate>& candidates, WorkLimit& limit);

}  // namespace concave_distance::detail
