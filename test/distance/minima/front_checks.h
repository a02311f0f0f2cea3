#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "distance/kernels/witness_refinement.h"
#include "distance/minima/cone_comparison.h"
#include "distance/minima/minima_candidates.h"
#include "distance/minima/minima_tracker.h"

namespace concave_distance::test {

inline std::vector<WitnessPair> placesOf(const std::shared_ptr<const BodyMesh>& a,
                                         const std::shared_ptr<const BodyMesh>& b,
                                         const Eigen::Isometry3d& pose,
                                         const std::vector<MinimumCandidate>& candidates) {
  RefinementWorkspace workspace;
  std::vector<WitnessPair> places;
  for (const MinimumCandidate& candidate : candidates) {
    places.push_back(refineWitness(*a, *b, pose, candidate.a, candidate.b, workspace).witness);
  }
  return places;
}

/// A place is known where the other list has one with the same distance whose points are near: two pairs of
/// features of one plateau hold the same minimum.
inline bool isKnown(const WitnessPair& place, const std::vector<WitnessPair>& others) {
  return std::any_of(others.begin(), others.end(), [&](const WitnessPair& other) {
    return std::abs(std::sqrt(place.squared_distance) - std::sqrt(other.squared_distance)) < 1e-12 &&
           (place.point_a_in_a - other.point_a_in_a).norm() +
                   (place.point_b_in_a - other.point_b_in_a).norm() <
               1e-9;
  });
}

/// The front at a pose against all cones from the roots.
inline void expectWhatTheRootsFind(const std::shared_ptr<const BodyMesh>& a,
                                   const std::shared_ptr<const BodyMesh>& b, const Eigen::Isometry3d& pose,
                                   NormalSides sides, double cutoff, detail::MinimaTracker& front) {
  WorkLimit none;
  const detail::PairFrame frame = detail::PairFrame::withFacets(*a, *b, pose);
  std::vector<MinimumCandidate> from_roots;
  LocalMinimaCost cost;
  detail::collectConeCandidates(frame, sides, cutoff, from_roots, cost, none);
  std::vector<MinimumCandidate> from_front;
  ASSERT_TRUE(front.collect(frame, sides, cutoff, from_front, none));
  const auto of_front = placesOf(a, b, pose, from_front);
  for (const WitnessPair& place : placesOf(a, b, pose, from_roots)) {
    EXPECT_TRUE(isKnown(place, of_front)) << "distance " << std::sqrt(place.squared_distance);
  }
  // It was a minimum at an earlier pose and is only measured at this one.
  std::vector<WitnessPair> candidates;
  for (const MinimumCandidate& candidate : from_roots) candidates.push_back(frame.witnessOf(candidate));
  for (const MinimumCandidate& candidate : from_front) {
    EXPECT_TRUE(isKnown(frame.witnessOf(candidate), candidates)) << "distance " << candidate.distance;
  }
}

/// Numbers of the items below every slot.
inline std::vector<std::vector<std::uint32_t>> itemsBelow(const NormalConeTree& tree) {
  using Tree = NormalConeTree;
  std::vector<std::vector<std::uint32_t>> below(tree.groups().size());
  const auto collect = [&](const auto& self, Tree::Slot slot) -> const std::vector<std::uint32_t>& {
    const std::uint32_t child = tree.child(slot);
    if (child == Tree::kNoChild) return below[slot];
    if (detail::ConeComparison::isItem(child)) return below[slot] = {child & ~Tree::kItemFlag};
    for (std::uint32_t part = child; part < child + Tree::kWidth; ++part) {
      const std::vector<std::uint32_t>& of_part = self(self, part);
      below[slot].insert(below[slot].end(), of_part.begin(), of_part.end());
    }
    return below[slot];
  };
  collect(collect, Tree::kRoot);
  return below;
}

/// Every pair of features that can hold a minimum has exactly one ancestor that is kept, or is live.
inline void expectOneAncestor(const BodyMesh& a, const BodyMesh& b, const detail::MinimaTracker& front) {
  const NormalConeTree& cones_a = a.normalCones(NormalSides::Outside);
  const NormalConeTree& cones_b = b.normalCones(NormalSides::Outside);
  const auto below_a = itemsBelow(cones_a);
  const auto below_b = itemsBelow(cones_b);
  const std::size_t width = cones_b.items().size();
  std::vector<std::uint8_t> counts(cones_a.items().size() * width);
  front.forEachPair([&](NormalConeTree::Slot slot_a, NormalConeTree::Slot slot_b) {
    for (const std::uint32_t i : below_a[slot_a]) {
      for (const std::uint32_t j : below_b[slot_b]) ++counts[i * width + j];
    }
  });
  for (std::size_t i = 0; i < cones_a.items().size(); ++i) {
    for (std::size_t j = 0; j < width; ++j) {
      if (!detail::FeaturePairs::isWanted(cones_a.items()[i].kind, cones_b.items()[j].kind)) continue;
      ASSERT_EQ(counts[i * width + j], 1) << "items " << i << " and " << j;
    }
  }
}

}  // namespace concave_distance::test
