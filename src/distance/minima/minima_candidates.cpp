#include "minima_candidates.h"

#include "cone_comparison.h"

namespace concave_distance::detail {

void collectConeCandidates(const PairFrame& frame, ConeChoice choice, double cutoff,
                           std::vector<MinimumCandidate>& candidates, LocalMinimaCost& cost,
                           WorkLimit& limit) {
  constexpr std::uint32_t kWidth = ConeComparison::kWidth;
  const FeaturePairs features(frame, cutoff);
  ConeComparison cones(frame, features, choice.sides);
  const DentedPairs dents(frame, choice);
  if (cones.a.empty() || cones.b.empty()) return;
  std::vector<SlotPair> open{{NormalConeTree::kRoot, NormalConeTree::kRoot}};
  while (!open.empty()) {
    if (limit.isOverNow() || !limit.admits(candidates.size() + 1)) return;
    const auto [a, b] = open.back();
    open.pop_back();
    const std::uint32_t child_a = cones.a.child(a);
    const std::uint32_t child_b = cones.b.child(b);
    if (ConeComparison::isItem(child_a) && ConeComparison::isItem(child_b)) {
      const NormalConeTree::Item& item_a = ConeComparison::itemOf(cones.a, child_a);
      const NormalConeTree::Item& item_b = ConeComparison::itemOf(cones.b, child_b);
      if (!FeaturePairs::isWanted(item_a.kind, item_b.kind)) continue;
      ++cost.feature_pairs;
      const auto found = features.findMinimum(item_a, item_b);
      if (!found) continue;
      ++cost.candidates;
      candidates.push_back(*found);
      continue;
    }
    ++cost.node_pairs;
    const bool opens_b = cones.opensB(a, b);
    const std::uint32_t opened = opens_b ? child_b : child_a;
    const ConeLanes excluded =
        (opens_b ? cones.withPartsOfB(a, opened) : cones.withPartsOfA(opened, b)).largest();
    const NormalConeTree& tree = opens_b ? cones.b : cones.a;
    for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
      const std::uint32_t slot = opened + lane;
      if (excluded[lane] > 0.0F || tree.child(slot) == NormalConeTree::kNoChild) continue;
      const SlotPair child{opens_b ? a : slot, opens_b ? slot : b};
      if (!dents.leavesOut(child)) open.push_back(child);
    }
  }
}

}  // namespace concave_distance::detail
