#include "niche_decider.h"

#include <algorithm>

#include "decision_stage.h"
#include "distant_components.h"

namespace concave_distance::detail {

void NicheDecider::clear() {
  memory_.clear();
  turn_ = 0;
  floods_are_long_ = false;
}

void NicheDecider::begin(const PairFrame& frame, std::vector<MinimumCandidate>& seeds, const Request& request,
                         WorkLimit& limit) {
  memory_.beginCycle(request.is_tracked);
  counts_ = {};
  judged_.clear();
  deepest_.clear();
  std::sort(seeds.begin(), seeds.end(), [](const MinimumCandidate& l, const MinimumCandidate& r) {
    if (l.distance != r.distance) return l.distance < r.distance;
    return l.a != r.a ? l.a < r.a : l.b < r.b;
  });
  Stage stage(*this, frame, request, limit);
  stage.enter(seeds);
  is_far_ = isFar(frame, request.least_prominence);
  next_ = end_ = 0;
  if (!is_far_) return;
  stage.decideFar();
  next_ = end_ = seed_count_;
}

void NicheDecider::judgeByMemory(const PairFrame& frame, const Request& request, WorkLimit& limit) {
  Stage stage(*this, frame, request, limit);
  stage.resume();
  stage.decideByMemory();
}

void NicheDecider::judgeByFloods(const PairFrame& frame, const Request& request, WorkLimit& limit) {
  Stage stage(*this, frame, request, limit);
  stage.resume();
  stage.decideByFloods();
}

void NicheDecider::judge(const PairFrame& frame, std::vector<MinimumCandidate>& seeds, const Request& request,
                         WorkLimit& limit) {
  begin(frame, seeds, request, limit);
  judgeByMemory(frame, request, limit);
  judgeByFloods(frame, request, limit);
}

std::uint32_t NicheDecider::locate(const PairFrame& frame, const TrianglePair& around, const Request& request,
                                   WorkLimit& limit) {
  Stage stage(*this, frame, request, limit);
  stage.resume();
  const std::uint32_t place = stage.placeAround(around);
  if (place == kNone || judged_[place].seed.distance > request.cutoff) return kNone;
  if (judged_[place].verdict == Verdict::Open) {
    if (is_far_) {
      stage.decideFar();
    } else {
      stage.decide(place);
    }
  }
  stage.resolve(place);
  const std::uint32_t end = endOf(place);
  if (end != kNone && judged_[end].verdict == Verdict::Undecided) return kUndecided;
  return nicheOf(end);
}

std::uint32_t NicheDecider::nicheWith(std::uint64_t region) const {
  const std::uint32_t index = memory_.regionWith(region);
  return index != kNone && memory_.region(index).confirmed ? nicheOf(memory_.region(index).first) : kNone;
}

std::uint32_t NicheDecider::endOf(std::uint32_t index) const {
  while (index != kNone && judged_[index].verdict == Verdict::Ripple) index = judged_[index].into;
  return index;
}

std::uint32_t NicheDecider::nicheOf(std::uint32_t of) const {
  const std::uint32_t index = endOf(of);
  return index != kNone && judged_[index].verdict == Verdict::Niche ? index : kNone;
}

std::size_t NicheDecider::memoryBytes() const {
  return memory_.memoryBytes() + judged_.capacity() * sizeof(Judged) + flood_.memoryBytes() +
         path_.memoryBytes();
}

}  // namespace concave_distance::detail
