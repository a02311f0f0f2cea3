#pragma once

#include <cstdint>

#include "distance/kernels/pair_frame.h"
#include "niche_rule.h"

namespace concave_distance::detail {

/// How many niches two nearly convex solids have, where that is known without looking for them.
enum class ConvexNiches : std::uint8_t {
  Unknown,
  None,
  OnlyTheNearest,
  TheNearestAndDents  ///< every other one has an end beside a dent (BodyMesh::dentedGroups())
};

/// Counts the niches that can be seen, by how far the surfaces lie below their convex hulls (doc/proofs.md,
/// "Nearly convex bodies have one niche"): beside every path between the hulls that only comes nearer there
/// is one of the surfaces that rises by no more than both gaps. The frame's facets are open.
/// @param certain_distance metres, no two points are closer; 0 where the surfaces meet
/// @param is_contained the surfaces do not meet, and one solid holds the other
/// @param nearest the closest points of the frame's bodies; nullptr: not known
ConvexNiches countConvexNiches(const PairFrame& frame, const NicheRule& rule, double certain_distance,
                               bool is_contained, const WitnessPair* nearest);

/// Returns whether two bodies are so nearly convex that no proven pose leaves their niches Unknown, but for
/// those that are hidden or through material.
bool areConvex(const BodyMesh& a, const BodyMesh& b);

}  // namespace concave_distance::detail
