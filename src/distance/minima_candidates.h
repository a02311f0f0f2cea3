#pragma once

#include <vector>

#include "cone_sweep.h"
#include "local_minima.h"
#include "minima_scene.h"

namespace concave_distance::detail {

/// Children of both trees that are still to be compared.
using OpenCones = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// At least one triangle pair of every local minimum between 0 and `cutoff`: a dual traversal of the cone
/// trees, where a pair of nodes is left out when it is too far apart, or when no direction from the one to
/// the other lies in the cones of both; each pair of features that is left is tried on the triangles.
/// @param budget groups of cones compared, at most
/// @param open where to go on, empty: everywhere; what was not come to is left there
/// @param limit ends it early; without memory the open pairs are given up
void collectConeSeeds(const MinimaScene& scene, NormalSides sides, double cutoff, std::size_t budget,
                      OpenCones& open, std::vector<MinimumSeed>& seeds, LocalMinimaCost& cost,
                      WorkLimit& limit);

}  // namespace concave_distance::detail
