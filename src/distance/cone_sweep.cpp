#include "concave_distance/distance/cone_sweep.h"

#include "minima_candidates.h"

namespace concave_distance {

std::uint64_t ConeSweep::advance(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                 NormalSides sides, double cutoff, std::size_t budget,
                                 std::vector<MinimumSeed>& found) {
  LocalMinimaCost cost;
  detail::collectConeSeeds(detail::MinimaScene(a, b, a_from_b), sides, cutoff, budget, open_, found, cost);
  return cost.feature_pairs;
}

}  // namespace concave_distance
