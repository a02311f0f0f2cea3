#include "candidate_collector.h"

#include <algorithm>
#include <iterator>

#include "distance/minima/minima_candidates.h"

namespace concave_distance::detail {

bool isCandidate(const PairFrame& frame, const LocalMinimaRequest& request, const MinimumCandidate& seed) {
  return seed.distance <= request.cutoff + frame.rounding && frame.areOnSurface(seed.a, seed.b);
}

void appendCandidates(const PairFrame& frame, const LocalMinimaRequest& request,
                      const std::vector<MinimumCandidate>& from, std::vector<MinimumCandidate>& seeds) {
  std::copy_if(from.begin(), from.end(), std::back_inserter(seeds),
               [&](const MinimumCandidate& seed) { return isCandidate(frame, request, seed); });
}

bool CandidateCollector::collect(const PairFrame& frame, const LocalMinimaRequest& request,
                                 std::vector<MinimumCandidate>& seeds, LocalMinimaCost& cost,
                                 WorkLimit& limit) {
  seeds.clear();
  if (request.given != nullptr) {
    if (!limit.makeRoom(seeds, request.given->size())) return false;
    appendCandidates(frame, request, *request.given, seeds);
    return true;
  }
  if (isFar(frame, request.least_prominence) &&
      collectFarSeeds(frame, request.cutoff, distant_components_, seeds, limit)) {
    return true;
  }
  if (!(request.certain_distance > 16.0 * frame.rounding)) {
    collectMeetingPairs(frame, open_, seeds, cost, limit);
  }
  const NormalSides sides = request.through_material ? NormalSides::Both : NormalSides::Outside;
  if (request.is_tracked) {
    const bool done = front_.collect(frame, sides, request.cutoff, seeds, limit);
    cost.node_pairs += front_.counts().groups;
    cost.feature_pairs += front_.counts().features;
    return done;
  }
  collectConeCandidates(frame, sides, request.cutoff, seeds, cost, limit);
  return !limit.isOver();
}

}  // namespace concave_distance::detail
