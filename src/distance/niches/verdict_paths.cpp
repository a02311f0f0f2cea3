#include "verdict_stage.h"

#include <algorithm>
#include <cmath>

#include "far_pieces.h"

// Ripples: ways from cell to cell down to deeper places (doc/algorithm.md, section 7).

namespace concave_distance::detail {
namespace {

/// Steps of a path that are followed: links of different times may lead in a circle.
constexpr int kLongestPath = 256;

}  // namespace

void MinimaVerdicts::Stage::resolve(std::uint32_t i) {
  while (i != kNone && verdicts_.judged_[i].verdict == Verdict::Ripple) {
    if (verdicts_.judged_[i].into == kNone) descend(i);
    const std::uint32_t into = verdicts_.judged_[i].into;
    if (into != kNone && verdicts_.judged_[into].verdict == Verdict::Open) decide(into);
    i = into;
  }
}

bool MinimaVerdicts::Stage::followsDown(std::uint32_t i, std::uint32_t number) {
  const double distance = verdicts_.judged_[i].seed.distance;
  const double level = levelOf(distance);
  const double below = distance - tolerance_;
  const auto settle = [&](std::uint32_t into, std::uint32_t cell) {
    set(i, Verdict::Ripple, into);
    verdicts_.judged_[i].below = {memory_.cell(cell).a, memory_.cell(cell).b};
    ++verdicts_.counts_.by_path;
    return true;
  };
  for (int step = 0; step < kLongestPath; ++step) {
    const VerdictMemory::Cell& cell = memory_.cell(number);
    const std::uint32_t other = step > 0 ? memory_.seedOf(number) : kNone;
    if (other != kNone && other != i && isEarlier(other, i)) return settle(other, number);
    if (below > 0.0 && cell.low != kNone &&
        (squaredLevelOf(memory_.link(cell.low)) < below * below ||
         (cell.link == kNone && aimLow(number) < below * below))) {
      memory_.use(cell.low);
      return settle(kNone, number);
    }
    if (cell.link == kNone) return false;
    double squared_level = squaredLevelOf(memory_.link(cell.link));
    if (!(squared_level < level * level)) squared_level = aim(cell.link);
    if (!(squared_level < level * level)) return false;
    memory_.use(cell.link);
    number = memory_.link(cell.link).next;
    if (below > 0.0 && squared_level < below * below) return settle(kNone, number);
  }
  return false;
}

double MinimaVerdicts::Stage::aim(std::uint32_t link, const TrianglePairDistance& closest) {
  ++verdicts_.counts_.aimed;
  memory_.aim(link, closest.point_a, scene_.frames.pointInB(closest.point_b));
  return closest.squared_distance;
}

void MinimaVerdicts::Stage::descend(std::uint32_t i) {
  const TrianglePair from = scene_.closestIn(verdicts_.judged_[i].below).first;
  const WitnessPair bottom =
      refineWitness(scene_.a, scene_.b, scene_.a_from_b, from.a, from.b, verdicts_.refinement_).witness;
  const std::uint32_t place = enterPlace(bottom);
  // Strictly down: no way leads in a circle.
  if (place == kNone || verdicts_.judged_[place].seed.distance >= verdicts_.judged_[i].seed.distance) return;
  verdicts_.judged_[i].into = place;
}

bool MinimaVerdicts::Stage::settlesLong(std::uint32_t i) {
  // Where not all seeds are known, what was found may be deeper than all of them.
  const bool is_deepest = i == deepest_ || !isEarlier(deepest_, i);
  const bool settled = is_deepest ? isNearest(i) : hasPathDown(i);
  verdicts_.floods_are_long_ = verdicts_.floods_are_long_ || settled;
  return settled;
}

bool MinimaVerdicts::Stage::isNearest(std::uint32_t i) {
  const MinimumSeed seed = verdicts_.judged_[i].seed;
  const WitnessPair minimum =
      refineWitness(scene_.a, scene_.b, scene_.a_from_b, seed.a, seed.b, verdicts_.refinement_).witness;
  if (!isNearestOfItsPieces(scene_, minimum)) {
    const TrianglePair pair{seed.a, seed.b};
    CertificateRequest certificate;
    certificate.limit = &limit_;
    if (certifyDistance(scene_.a, scene_.b, scene_.a_from_b, &pair, 1, certificate, proof_).lower_bound <
        seed.distance - tolerance_) {
      return false;
    }
  }
  set(i, Verdict::Niche);
  return true;
}

bool MinimaVerdicts::Stage::hasPathDown(std::uint32_t i) {
  std::uint32_t into = kNone;
  const auto has_arrived = [&](TriangleIndex a, TriangleIndex b) {
    into = memory_.seedIn(a, b);
    return into != kNone && into != i && isEarlier(into, i);
  };
  const MinimumSeed& from = verdicts_.judged_[i].seed;
  const MinimumSeed& to = verdicts_.judged_[deepest_].seed;
  for (const int first_moves : {0, 1}) {
    if (LevelPath(scene_, verdicts_.path_, limit_)
            .find(scene_.cellOf(from.a, from.b), scene_.cellOf(to.a, to.b), levelOf(from.distance),
                  first_moves, has_arrived)) {
      set(i, Verdict::Ripple, into != kNone && into != i ? into : deepest_);
      return true;
    }
  }
  return false;
}

void MinimaVerdicts::Stage::keepPath(std::uint32_t start) {
  const std::vector<CellFlood::Cell>& visited = verdicts_.flood_.cells();
  std::uint32_t at = verdicts_.flood_.last();
  std::uint32_t next = memory_.cellOf(visited[at].a, visited[at].b, limit_);
  while (next != kNone && visited[at].parent != CellFlood::kNone) {
    const CellFlood::Cell& here = visited[at];
    const std::uint32_t before =
        here.parent == 0 ? start : memory_.cellOf(visited[here.parent].a, visited[here.parent].b, limit_);
    if (before == kNone ||
        !keepLink(memory_.cell(before).link, closestOver(scene_, here.via), next, here.via))
      return;
    next = before;
    at = here.parent;
  }
}

void MinimaVerdicts::Stage::keepLow(TriangleIndex a, TriangleIndex b) {
  const std::uint32_t number = memory_.cellOf(a, b, limit_);
  if (number == kNone) return;
  keepLink(memory_.cell(number).low, scene_.closestIn({a, b}).second, number, {});
}

bool MinimaVerdicts::Stage::keepLink(std::uint32_t& link, const TrianglePairDistance& closest,
                                     std::uint32_t next, const SharedElement& via) {
  return memory_.keepLink(link, {closest.point_a, scene_.frames.pointInB(closest.point_b), next, via},
                          limit_);
}

}  // namespace concave_distance::detail
