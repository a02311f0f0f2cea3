#include "cone_sweep.h"

#include "far_pieces.h"
#include "minima_candidates.h"

namespace concave_distance {

ConeSweep::ConeSweep() = default;
ConeSweep::~ConeSweep() = default;
ConeSweep::ConeSweep(ConeSweep&&) noexcept = default;
ConeSweep& ConeSweep::operator=(ConeSweep&&) noexcept = default;

std::uint64_t ConeSweep::advance(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                 NormalSides sides, double cutoff, std::size_t budget,
                                 std::vector<MinimumSeed>& found, double least_prominence, WorkLimit* limit) {
  WorkLimit none;
  WorkLimit& work = limit != nullptr ? *limit : none;
  const detail::MinimaScene scene(a, b, a_from_b);
  if (detail::isFar(scene, least_prominence)) {
    if (!far_) far_ = std::make_unique<detail::FarPieceBuffers>();
    if (detail::collectFarSeeds(scene, cutoff, *far_, found, work)) {
      open_.clear();
      return 0;
    }
  }
  LocalMinimaCost cost;
  detail::collectConeSeeds(scene, sides, cutoff, budget, open_, found, cost, work);
  return cost.feature_pairs;
}

}  // namespace concave_distance
