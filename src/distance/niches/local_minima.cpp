#include "local_minima.h"

#include <algorithm>
#include <cmath>

#include "base/refill.h"
#include "candidate_collector.h"
#include "niche_decider.h"
#include "niche_describer.h"

namespace concave_distance {
namespace detail {
namespace {

constexpr std::size_t kNoOwner = LocalMinima::kNoOwner;
constexpr std::size_t kUndecided = LocalMinima::kUndecided;
/// A suspended search gets this share of the time where the other niches go on beside it.
constexpr double kShareOfSuspended = 0.3;

}  // namespace

/// Buffers and stages of a call.
struct LocalMinimaParts {
  struct Described {
    LocalMinimum niche;
    std::size_t judged;  ///< index in decider.judged()
  };

  /// Decides which candidates are niches and describes these.
  /// @return false when one is left undecided
  bool decide(const PairFrame& frame, const LocalMinimaRequest& request, WorkLimit& limit);
  /// Returns the niche, as NicheDecider::locate() does, that one of the asked pairs belongs to.
  std::uint32_t ownerOf(const PairFrame& frame, const LocalMinimaRequest& request, std::size_t asked,
                        const NicheDecider::Request& wanted, WorkLimit& limit);
  /// Describes what has been judged a niche and is not described yet.
  void describeNiches(const PairFrame& frame, const LocalMinimaRequest& request, WorkLimit& limit);
  void list(const LocalMinimaRequest& request, LocalMinima& result);
  /// Describes the niche that is known to be the only one and gives it all that is asked for.
  void listKnown(const PairFrame& frame, const LocalMinimaRequest& request, LocalMinima& result,
                 WorkLimit& limit);
  /// Measures the prominences of the listed niches.
  void measure(const PairFrame& frame, const LocalMinimaRequest& request, LocalMinima& result,
               WorkLimit& limit);

  CandidateCollector collector;
  NicheDecider decider;
  NicheDescriber describer;
  std::vector<MinimumCandidate> candidates;
  std::vector<Described> described;
  std::vector<char>
      is_looked_at;  ///< for each judged: 1 when it is a niche and there was time to describe it
  std::vector<std::size_t> places;    ///< for each judged: its place in the list, or kNoOwner
  std::vector<std::size_t> owners;    ///< for each asked pair: index in decider.judged(), or no owner
  std::vector<std::size_t> proposed;  ///< for each proposal: the same
};

NicheDecider::Request deciderRequest(const PairFrame& frame, const LocalMinimaRequest& request,
                                     const OverlapParts& overlap) {
  NicheDecider::Request wanted;
  if (!overlap.parts().empty()) wanted.overlap = &overlap;
  wanted.cutoff = request.cutoff + frame.rounding;
  wanted.rule = request.rule;
  wanted.through_material = request.through_material;
  wanted.is_tracked = request.is_tracked;
  wanted.certain_distance = request.certain_distance;
  // One more tells that the list is cut.
  wanted.most_niches = std::max(request.largest_count, request.largest_count + 1);
  if (!request.hidden) {
    // A set of minima is seen where its middle is.
    wanted.is_wanted = [&frame](const MinimumCandidate& candidate, Occluder& occluder) {
      return !candidate.is_point || candidate.distance == 0.0 ||
             isVisible(frame.a, frame.b, frame.a_from_b, frame.witnessOf(candidate), occluder);
    };
  }
  return wanted;
}

bool LocalMinimaParts::decide(const PairFrame& frame, const LocalMinimaRequest& request, WorkLimit& limit) {
  const NicheDecider::Request wanted = deciderRequest(frame, request, collector.overlap());
  is_looked_at.clear();
  decider.begin(frame, candidates, wanted, limit);
  do {
    decider.judgeByMemory(frame, wanted, limit);
    describeNiches(frame, request, limit);
    limit.allowShare(request.time_shares.searches);
    decider.judgeBySearches(frame, wanted, limit);
    limit.allowShare(request.time_shares.all);
    describeNiches(frame, request, limit);
  } while (!decider.hasJudgedAll() && described.size() <= request.largest_count && !limit.isOver());
  const auto place = [](std::uint32_t judged) {
    if (judged == NicheDecider::kUndecided) return kUndecided;
    return judged == NicheDecider::kNone ? kNoOwner : std::size_t{judged};
  };
  for (std::size_t i = 0; i < request.asked_pairs.size(); ++i) {
    owners.push_back(place(ownerOf(frame, request, i, wanted, limit)));
  }
  for (const MinimumCandidate& proposal : request.proposals) {
    const bool is_candidate = isCandidate(frame, request, proposal);
    proposed.push_back(is_candidate ? place(decider.locate(frame, {proposal.a, proposal.b}, wanted, limit))
                                    : kNoOwner);
  }
  describeNiches(frame, request, limit);
  for (std::vector<std::size_t>* of : {&owners, &proposed}) {
    for (std::size_t& owner : *of) {
      if (owner == kNoOwner || owner == kUndecided) continue;
      if (is_looked_at[owner] == 0) owner = kUndecided;
    }
  }
  return std::none_of(decider.judged().begin(), decider.judged().end(), [](const auto& judged) {
    return judged.decision == NicheDecider::Decision::Undecided;
  });
}

std::uint32_t LocalMinimaParts::ownerOf(const PairFrame& frame, const LocalMinimaRequest& request,
                                        std::size_t asked, const NicheDecider::Request& wanted,
                                        WorkLimit& limit) {
  const auto& [a, b] = request.asked_pairs[asked];
  const std::uint64_t basin = asked < request.asked_basins.size() ? request.asked_basins[asked] : 0;
  const OverlapParts& overlap = collector.overlap();
  const bool was_part = OverlapParts::isPartId(basin);
  const std::uint32_t heir = was_part ? overlap.heirOf(basin) : OverlapParts::kNone;
  if (heir != OverlapParts::kNone) return decider.nicheOfPart(heir);
  std::uint32_t owner = was_part ? NicheDecider::kNone : decider.nicheWith(basin);
  if (owner == NicheDecider::kNone) owner = decider.locate(frame, {a, b}, wanted, limit);
  if (!was_part || owner != NicheDecider::kNone) return owner;
  // Where one of its curves has gone, another may still be near.
  overlap.forSomePairsOf(basin, [&](const TrianglePair& pair) {
    owner = decider.locate(frame, pair, wanted, limit);
    return owner != NicheDecider::kNone;
  });
  return owner;
}

void LocalMinimaParts::describeNiches(const PairFrame& frame, const LocalMinimaRequest& request,
                                      WorkLimit& limit) {
  const std::vector<NicheDecider::Judged>& judged = decider.judged();
  is_looked_at.resize(judged.size(), 0);
  for (std::size_t i = 0; i < judged.size(); ++i) {
    if (judged[i].decision != NicheDecider::Decision::Niche || is_looked_at[i] != 0) continue;
    if (limit.isOver()) return;
    is_looked_at[i] = 1;
    const MinimumCandidate& candidate = judged[i].candidate;
    LocalMinimum niche;
    niche.searched = request.rule.levelOf(candidate.distance);
    niche.basin = judged[i].basin;
    const bool is_seen = !request.hidden && candidate.is_point;
    if (describer.describe(frame, request, candidate, judged[i].was_found, is_seen, niche, limit)) {
      described.push_back({niche, i});
    }
  }
}

void LocalMinimaParts::measure(const PairFrame& frame, const LocalMinimaRequest& request, LocalMinima& result,
                               WorkLimit& limit) {
  const NicheDecider::Request wanted = deciderRequest(frame, request, collector.overlap());
  for (std::size_t k = 0; k < result.niches.size(); ++k) {
    const auto niche = static_cast<std::uint32_t>(described[k].judged);
    const double distance = decider.judged()[niche].candidate.distance;
    if (request.rule.isAtZero(distance)) continue;
    const double highest = request.rule.measuredLevelOf(distance, request.cutoff);
    const double pass = decider.passOf(frame, niche, highest, wanted, limit);
    if (std::isnan(pass)) return;
    result.niches[k].prominence = request.rule.prominenceOf(distance, pass);
    result.niches[k].searched = highest;
  }
}

void LocalMinimaParts::list(const LocalMinimaRequest& request, LocalMinima& result) {
  std::sort(described.begin(), described.end(), [&](const Described& l, const Described& r) {
    if (l.niche.distance != r.niche.distance) return l.niche.distance < r.niche.distance;
    const MinimumCandidate& of_l = decider.judged()[l.judged].candidate;
    const MinimumCandidate& of_r = decider.judged()[r.judged].candidate;
    return of_l.a != of_r.a ? of_l.a < of_r.a : of_l.b < of_r.b;
  });
  result.cut = described.size() > request.largest_count;
  if (result.cut) described.resize(request.largest_count);
  refill(places, decider.judged().size(), kNoOwner);
  for (const Described& entry : described) {
    places[entry.judged] = result.niches.size();
    result.niches.push_back(entry.niche);
    result.cost.met_by_search += decider.judged()[entry.judged].was_found ? 1 : 0;
  }
  for (const std::size_t owner : owners) {
    result.owners.push_back(owner == kNoOwner || owner == kUndecided ? owner : places[owner]);
  }
  for (std::size_t i = proposed.size(); i-- > 0;) {
    if (proposed[i] != kNoOwner && proposed[i] != kUndecided && places[proposed[i]] != kNoOwner) {
      result.niches[places[proposed[i]]].proposal = i;
    }
  }
}

void LocalMinimaParts::listKnown(const PairFrame& frame, const LocalMinimaRequest& request,
                                 LocalMinima& result, WorkLimit& limit) {
  LocalMinimum niche;
  const MinimumCandidate* known = request.known->niche;
  if (known != nullptr && describer.describe(frame, request, *known, false, true, niche, limit)) {
    niche.searched = request.rule.levelOf(niche.distance);
    if (!request.proposals.empty()) niche.proposal = 0;
    result.niches.push_back(niche);
  }
  result.owners.assign(request.asked_pairs.size(), result.niches.empty() ? kNoOwner : 0);
}

}  // namespace detail

LocalMinimaMemory::LocalMinimaMemory() = default;
LocalMinimaMemory::~LocalMinimaMemory() = default;
LocalMinimaMemory::LocalMinimaMemory(LocalMinimaMemory&&) noexcept = default;
LocalMinimaMemory& LocalMinimaMemory::operator=(LocalMinimaMemory&&) noexcept = default;

detail::LocalMinimaParts& LocalMinimaMemory::parts() {
  if (parts_ == nullptr) parts_ = std::make_unique<detail::LocalMinimaParts>();
  return *parts_;
}

void LocalMinimaMemory::clear() {
  if (parts_ == nullptr) return;
  parts_->collector.clear();
  parts_->decider.clear();
}

void findLocalMinima(const detail::PairFrame& frame, const LocalMinimaRequest& request,
                     LocalMinimaMemory& memory, LocalMinima& result) {
  detail::LocalMinimaParts& parts = memory.parts();
  WorkLimit none;
  WorkLimit& limit = request.limit != nullptr ? *request.limit : none;
  const bool refused_before = limit.hasRefusedPairs();
  result.niches.clear();
  result.owners.clear();
  result.cost = {};
  parts.describer.begin(frame, request);
  if (request.known) {
    parts.listKnown(frame, request, result, limit);
    result.cut = false;
    result.finished = !limit.isOver();
    return;
  }
  parts.described.clear();
  parts.owners.clear();
  parts.proposed.clear();
  limit.allowShare(request.finishes_searches ? request.time_shares.all : detail::kShareOfSuspended);
  const bool has_finished = parts.decider.goOn(limit);
  if (!has_finished && request.finishes_searches) {
    result.owners.assign(request.asked_pairs.size(), LocalMinima::kUndecided);
    result.cut = result.finished = false;
    return;
  }
  const auto start = WorkLimit::Clock::now();
  limit.allowShare(request.time_shares.search);
  const bool all = parts.collector.collect(frame, request, parts.candidates, result.cost, limit);
  result.cost.sweep_seconds = std::chrono::duration<double>(WorkLimit::Clock::now() - start).count();
  result.cost.minima = parts.candidates.size();
  limit.allowShare(request.time_shares.all);
  // Proposals count while not everything has been looked at.
  if (!all) detail::appendCandidates(frame, request, request.proposals, parts.candidates);
  const bool decided = parts.decide(frame, request, limit);
  parts.list(request, result);
  if (request.rule.measuresProminences() && !detail::isFar(frame, request.rule)) {
    parts.measure(frame, request, result, limit);
  }
  result.cost.searched_pairs = parts.decider.counts().visited_pairs;
  if ((!all || !decided) && !limit.hasRefusedPairs()) parts.decider.endCut();
  result.finished = all && decided && !limit.isOver() && limit.hasRefusedPairs() == refused_before;
  if (result.finished) parts.collector.renew(frame, request, result.cost, limit);
}

void attributeProposals(const detail::PairFrame& frame, const LocalMinimaRequest& request,
                        LocalMinimaMemory& memory, LocalMinima& result) {
  detail::LocalMinimaParts& parts = memory.parts();
  const detail::NicheDecider::Request wanted =
      detail::deciderRequest(frame, request, parts.collector.overlap());
  WorkLimit none;
  WorkLimit& limit = request.limit != nullptr ? *request.limit : none;
  for (std::size_t i = request.proposals.size(); i-- > 0;) {
    const MinimumCandidate& proposal = request.proposals[i];
    if (!detail::isCandidate(frame, request, proposal)) continue;
    const std::uint32_t judged = parts.decider.locate(frame, {proposal.a, proposal.b}, wanted, limit);
    // A place that locate() was the first to meet is not in the list.
    if (judged >= parts.places.size()) continue;
    const std::size_t place = parts.places[judged];
    if (place != LocalMinima::kNoOwner) result.niches[place].proposal = i;
  }
}

LocalMinima findLocalMinima(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                            const LocalMinimaRequest& request) {
  LocalMinimaMemory once;
  LocalMinima result;
  findLocalMinima(detail::PairFrame::withFacets(a, b, a_from_b), request, once, result);
  return result;
}

}  // namespace concave_distance
