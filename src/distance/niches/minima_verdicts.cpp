#include "minima_verdicts.h"

#include <algorithm>

#include "far_pieces.h"
#include "verdict_stage.h"

namespace concave_distance::detail {

void MinimaVerdicts::clear() {
  memory_.clear();
  turn_ = 0;
  floods_are_long_ = false;
}

void MinimaVerdicts::begin(const MinimaScene& scene, std::vector<MinimumSeed>& seeds, const Request& request,
                           WorkLimit& limit) {
  memory_.beginCycle(request.is_tracked);
  counts_ = {};
  judged_.clear();
  deepest_.clear();
  std::sort(seeds.begin(), seeds.end(), [](const MinimumSeed& l, const MinimumSeed& r) {
    if (l.distance != r.distance) return l.distance < r.distance;
    return l.a != r.a ? l.a < r.a : l.b < r.b;
  });
  Stage stage(*this, scene, request, limit);
  stage.enter(seeds);
  is_far_ = isFar(scene, request.least_prominence);
  next_ = end_ = 0;
  if (!is_far_) return;
  stage.decideFar();
  next_ = end_ = seed_count_;
}

void MinimaVerdicts::judgeByMemory(const MinimaScene& scene, const Request& request, WorkLimit& limit) {
  Stage stage(*this, scene, request, limit);
  stage.resume();
  stage.decideByMemory();
}

void MinimaVerdicts::judgeByFloods(const MinimaScene& scene, const Request& request, WorkLimit& limit) {
  Stage stage(*this, scene, request, limit);
  stage.resume();
  stage.decideByFloods();
}

void MinimaVerdicts::judge(const MinimaScene& scene, std::vector<MinimumSeed>& seeds, const Request& request,
                           WorkLimit& limit) {
  begin(scene, seeds, request, limit);
  judgeByMemory(scene, request, limit);
  judgeByFloods(scene, request, limit);
}

std::uint32_t MinimaVerdicts::locate(const MinimaScene& scene, const TrianglePair& around,
                                     const Request& request, WorkLimit& limit) {
  Stage stage(*this, scene, request, limit);
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

std::uint32_t MinimaVerdicts::nicheWith(std::uint64_t region) const {
  const std::uint32_t index = memory_.regionWith(region);
  return index != kNone && memory_.region(index).confirmed ? nicheOf(memory_.region(index).first) : kNone;
}

std::uint32_t MinimaVerdicts::endOf(std::uint32_t index) const {
  while (index != kNone && judged_[index].verdict == Verdict::Ripple) index = judged_[index].into;
  return index;
}

std::uint32_t MinimaVerdicts::nicheOf(std::uint32_t of) const {
  const std::uint32_t index = endOf(of);
  return index != kNone && judged_[index].verdict == Verdict::Niche ? index : kNone;
}

std::size_t MinimaVerdicts::memoryBytes() const {
  return memory_.memoryBytes() + judged_.capacity() * sizeof(Judged) + flood_.memoryBytes() +
         path_.memoryBytes();
}

}  // namespace concave_distance::detail
