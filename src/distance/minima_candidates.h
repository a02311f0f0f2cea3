#pragma once

#include <vector>

#include "concave_distance/distance/local_minima.h"
#include "minima_scene.h"

namespace concave_distance::detail {

/// A triangle pair whose closest points are a local minimum of the distance over both surfaces.
struct MinimumSeed {
  TriangleIndex a;
  TriangleIndex b;
  double distance;
};

/// Buffers that are kept from query to query.
struct CandidateWorkspace {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open;  ///< children of both trees
};

/// At least one triangle pair of every local minimum between 0 and `cutoff`: a dual traversal of the cone
/// trees, where a pair of nodes is left out when it is too far apart, or when no direction from the one to
/// the other lies in the cones of both; each pair of features that is left is tried on the triangles.
void collectConeSeeds(const MinimaScene& scene, NormalSides sides, double cutoff,
                      std::vector<MinimumSeed>& seeds, LocalMinimaCost& cost, CandidateWorkspace& workspace);

/// Every triangle pair that meets, up to rounding.
void collectMeetingPairs(const MinimaScene& scene, std::vector<MinimumSeed>& seeds, LocalMinimaCost& cost);

}  // namespace concave_distance::detail
