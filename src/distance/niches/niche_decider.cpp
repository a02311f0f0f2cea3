#include "niche_decider.h"

#include <algorithm>

#include "decision_stage.h"
#include "distant_components.h"

namespace concave_distance::detail {

void NicheDecider::clear() {
  memory_.clear();
  suspended_.clear();
  turn_ = 0;
  searches_are_long_ = false;
}

void NicheDecider::begin(const PairFrame& frame, std::vector<MinimumCandidate>& candidates,
                         const Request& request, WorkLimit& limit) {
  memory_.beginCycle(request.is_tracked);
  counts_ = {};
  counts_.visited_pairs = suspended_.takeVisited();
  judged_.clear();
  deepest_.clear();
  std::sort(candidates.begin(), candidates.end(), [](const MinimumCandidate& l, const MinimumCandidate& r) {
    if (l.distance != r.distance) return l.distance < r.distance;
    return l.a != r.a ? l.a < r.a : l.b < r.b;
  });
  Stage stage(*this, frame, request, limit);
  stage.enter(candidates);
  is_far_ = isFar(frame, request.rule);
  next_ = end_ = 0;
  if (!is_far_) return;
  stage.decideFar();
  next_ = end_ = candidate_count_;
}

void NicheDecider::judgeByMemory(const PairFrame& frame, const Request& request, WorkLimit& limit) {
  Stage stage(*this, frame, request, limit);
  stage.resume();
  stage.decideByMemory();
}

void NicheDecider::judgeBySearches(const PairFrame& frame, const Request& request, WorkLimit& limit) {
  Stage stage(*this, frame, request, limit);
  stage.resume();
  stage.decideBySearches();
}

void NicheDecider::judge(const PairFrame& frame, std::vector<MinimumCandidate>& candidates,
                         const Request& request, WorkLimit& limit) {
  begin(frame, candidates, request, limit);
  judgeByMemory(frame, request, limit);
  judgeBySearches(frame, request, limit);
}

std::uint32_t NicheDecider::locate(const PairFrame& frame, const TrianglePair& around, const Request& request,
                                   WorkLimit& limit) {
  Stage stage(*this, frame, request, limit);
  stage.resume();
  const std::uint32_t place = stage.placeAround(around);
  if (place == kNone || judged_[place].candidate.distance > request.cutoff) return kNone;
  if (judged_[place].decision == Decision::Open) {
    if (is_far_) {
      stage.decideFar();
    } else {
      stage.decide(place);
    }
  }
  stage.resolve(place);
  const std::uint32_t end = endOf(place);
  if (end != kNone && judged_[end].decision == Decision::Undecided) return kUndecided;
  return nicheOf(end);
}

double NicheDecider::passOf(const PairFrame& frame, std::uint32_t niche, double highest,
                            const Request& request, WorkLimit& limit) {
  Stage stage(*this, frame, request, limit);
  stage.resume();
  return stage.passOf(niche, highest);
}

std::uint32_t NicheDecider::nicheWith(std::uint64_t basin) const {
  const std::uint32_t index = memory_.basinWith(basin);
  return index != kNone && memory_.basin(index).confirmed ? nicheOf(memory_.basin(index).first) : kNone;
}

std::uint32_t NicheDecider::nicheOfPart(std::uint32_t part) const {
  const std::uint32_t end = endOf(part_candidates_[part]);
  return judged_[end].decision == Decision::Undecided ? kUndecided : nicheOf(end);
}

std::uint32_t NicheDecider::endOf(std::uint32_t index) const {
  while (index != kNone && judged_[index].decision == Decision::Ripple) index = judged_[index].into;
  return index;
}

std::uint32_t NicheDecider::nicheOf(std::uint32_t of) const {
  const std::uint32_t index = endOf(of);
  return index != kNone && judged_[index].decision == Decision::Niche ? index : kNone;
}

}  // namespace concave_distance::detail
