#include "candidate_collector.h"

#include <algorithm>
#include <iterator>

#include "distance/minima/minima_candidates.h"

namespace concave_distance::detail {

namespace {

/// Less work than this is always done to renew a front, in comparisons.
constexpr std::size_t kLeastRenewed = 8192;

ConeChoice conesOf(const LocalMinimaRequest& request) {
  return {request.through_material ? NormalSides::Both : NormalSides::Outside,
          request.nearest_beside_dents != nullptr};
}

}  // namespace

bool isCandidate(const PairFrame& frame, const LocalMinimaRequest& request,
                 const MinimumCandidate& candidate) {
  return candidate.distance <= request.cutoff + frame.rounding &&
         frame.areOnSurface(candidate.a, candidate.b);
}

void appendCandidates(const PairFrame& frame, const LocalMinimaRequest& request,
                      const std::vector<MinimumCandidate>& from, std::vector<MinimumCandidate>& candidates) {
  std::copy_if(from.begin(), from.end(), std::back_inserter(candidates),
               [&](const MinimumCandidate& candidate) { return isCandidate(frame, request, candidate); });
}

bool CandidateCollector::collect(const PairFrame& frame, const LocalMinimaRequest& request,
                                 std::vector<MinimumCandidate>& candidates, LocalMinimaCost& cost,
                                 WorkLimit& limit) {
  candidates.clear();
  if (request.given != nullptr) {
    appendCandidates(frame, request, *request.given, candidates);
    const bool is_met = std::any_of(candidates.begin(), candidates.end(), [&](const MinimumCandidate& c) {
      return c.distance <= meetingTolerance(frame);
    });
    if (is_met) return collectOverlap(frame, request, candidates, cost, limit);
    overlap_.findNone();
    return true;
  }
  const bool may_meet = !(request.certain_distance > 4.0 * frame.touchingDistance());
  if (isFar(frame, request.rule) &&
      collectFarCandidates(frame, request.cutoff, distant_components_, candidates, limit)) {
    overlap_.findNone();
    return true;
  }
  if (!may_meet) overlap_.findNone();
  const bool has_overlap = !may_meet || collectOverlap(frame, request, candidates, cost, limit);
  return collectMinima(frame, request, candidates, cost, limit) && has_overlap;
}

bool CandidateCollector::collectOverlap(const PairFrame& frame, const LocalMinimaRequest& request,
                                        std::vector<MinimumCandidate>& candidates, LocalMinimaCost& cost,
                                        WorkLimit& limit) {
  const bool all = overlap_.find(frame, request.is_tracked, cost, limit);
  const std::vector<OverlapParts::Part>& parts = overlap_.parts();
  for (std::uint32_t k = 0; k < parts.size(); ++k) {
    candidates.push_back(candidateOn(parts[k].triangles.a, parts[k].triangles.b, parts[k].distance));
    candidates.back().part = k;
  }
  return all;
}

bool CandidateCollector::collectMinima(const PairFrame& frame, const LocalMinimaRequest& request,
                                       std::vector<MinimumCandidate>& candidates, LocalMinimaCost& cost,
                                       WorkLimit& limit) {
  switch (shell_pairs_.collect(frame, request, candidates, limit)) {
    case ConvexShellPairs::Outcome::Complete:
      return true;
    case ConvexShellPairs::Outcome::LimitReached:
      return false;
    case ConvexShellPairs::Outcome::Unknown:
      break;
  }
  const ConeChoice cones = conesOf(request);
  if (request.nearest_beside_dents != nullptr) candidates.push_back(*request.nearest_beside_dents);
  if (request.is_tracked) {
    const bool done = front_.collect(frame, cones, request.cutoff, candidates, limit);
    cost.node_pairs += front_.counts().groups;
    cost.feature_pairs += front_.counts().features;
    return done;
  }
  collectConeCandidates(frame, cones, request.cutoff, candidates, cost, limit);
  return !limit.isOver();
}

void CandidateCollector::renew(const PairFrame& frame, const LocalMinimaRequest& request,
                               LocalMinimaCost& cost, const WorkLimit& limit) {
  if (!request.is_tracked || !front_.hasOutgrown()) return;
  WorkLimit own = limit;  // what it refuses is no part of the answer
  const std::size_t most = std::max(kLeastRenewed, front_.counts().comparisons());
  next_candidates_.clear();
  const bool is_whole =
      next_front_.collect(frame, conesOf(request), request.cutoff, next_candidates_, own, most);
  cost.node_pairs += next_front_.counts().groups;
  cost.feature_pairs += next_front_.counts().features;
  if (!is_whole) return;
  std::swap(front_, next_front_);
  next_front_.clear();
}

}  // namespace concave_distance::detail
