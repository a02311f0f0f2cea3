#include "minima_candidates.h"

#include <limits>

#include "cone_comparison.h"

namespace concave_distance::detail {

void collectConeSeeds(const MinimaScene& scene, NormalSides sides, double cutoff, std::size_t budget,
                      OpenCones& open, std::vector<MinimumSeed>& seeds, LocalMinimaCost& cost,
                      WorkLimit& limit) {
  constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();
  constexpr std::uint32_t kWidth = ConeComparison::kWidth;
  const FeaturePairs features(scene, cutoff);
  ConeComparison cones(scene, features, sides);
  if (cones.a.empty() || cones.b.empty()) return;
  if (open.empty()) open.emplace_back(NormalConeTree::kRoot, NormalConeTree::kRoot);
  const std::uint64_t last = budget < kAll ? cost.node_pairs + budget : kAll;
  while (!open.empty() && cost.node_pairs < last) {
    if (limit.isOverNow()) return;
    if (!limit.makeRoom(open, kWidth) || !limit.makeRoom(seeds)) {
      open.clear();
      return;
    }
    const auto [a, b] = open.back();
    open.pop_back();
    const std::uint32_t child_a = cones.a.child(a);
    const std::uint32_t child_b = cones.b.child(b);
    if (ConeComparison::isItem(child_a) && ConeComparison::isItem(child_b)) {
      const NormalConeTree::Item& item_a = ConeComparison::itemOf(cones.a, child_a);
      const NormalConeTree::Item& item_b = ConeComparison::itemOf(cones.b, child_b);
      if (!FeaturePairs::isWanted(item_a.kind, item_b.kind)) continue;
      ++cost.feature_pairs;
      const auto distance = features.findMinimum(item_a, item_b);
      if (!distance) continue;
      ++cost.candidates;
      seeds.push_back({item_a.triangle, item_b.triangle, *distance});
      continue;
    }
    ++cost.node_pairs;
    const bool opens_b = cones.opensB(a, b);
    const std::uint32_t opened = opens_b ? child_b : child_a;
    const ConeLanes excluded =
        (opens_b ? cones.withNodeOfB(a, opened) : cones.withNodeOfA(opened, b)).largest();
    const NormalConeTree::Node& node = (opens_b ? cones.b : cones.a).nodes()[opened];
    for (std::uint32_t lane = 0; lane < kWidth && node.child[lane] != NormalConeTree::kNoChild; ++lane) {
      if (excluded[lane] > 0.0F) continue;
      const std::uint32_t slot = opened * kWidth + lane;
      open.emplace_back(opens_b ? a : slot, opens_b ? slot : b);
    }
  }
}

}  // namespace concave_distance::detail
