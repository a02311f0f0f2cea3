#include "local_minima.h"

#include <algorithm>
#include <cmath>

#include "base/refill.h"
#include "candidate_collector.h"
#include "distance/kernels/pair_frame.h"
#include "minima_flood.h"
#include "niche_decider.h"
#include "niche_describer.h"

namespace concave_distance {
namespace detail {
namespace {

constexpr std::size_t kNoOwner = LocalMinima::kNoOwner;
constexpr std::size_t kUndecided = LocalMinima::kUndecided;

}  // namespace

/// Buffers and stages of a call.
struct LocalMinimaParts {
  struct Described {
    LocalMinimum niche;
    std::size_t minimum;  ///< of `minima`
  };

  /// Verdicts alone; no pass is measured.
  bool decide(const PairFrame& frame, const LocalMinimaRequest& request, LocalMinimaCost& cost,
              WorkLimit& limit);
  bool measure(const PairFrame& frame, const LocalMinimaRequest& request, LocalMinimaCost& cost,
               WorkLimit& limit);
  /// What has been judged a niche and is not described yet.
  void describeNiches(const PairFrame& frame, const LocalMinimaRequest& request, WorkLimit& limit);
  /// The last of `minima`.
  void describe(const PairFrame& frame, const LocalMinimaRequest& request, bool is_seen, WorkLimit& limit);
  void list(const LocalMinimaRequest& request, LocalMinima& result);

  std::size_t memoryBytes() const {
    return sizeof(LocalMinimaParts) + collector.memoryBytes() + verdicts.memoryBytes() +
           seeds.capacity() * sizeof(MinimumCandidate) + minima.capacity() * sizeof(FloodedMinimum) +
           described.capacity() * sizeof(Described) +
           (described_as.capacity() + places.capacity() + owners.capacity() + proposed.capacity()) *
               sizeof(std::size_t);
  }

  CandidateCollector collector;
  NicheDecider verdicts;
  NicheDescriber describer;
  RefinementWorkspace refinement;
  std::vector<MinimumCandidate> seeds;
  std::vector<FloodedMinimum> minima;
  std::vector<Described> described;
  std::vector<std::size_t> described_as;  ///< of the judged, in `minima`
  std::vector<std::size_t> places;        ///< of `minima`, in the list
  std::vector<std::size_t> owners;        ///< of each asked for, in `minima`
  std::vector<std::size_t> proposed;      ///< of each proposal, in `minima`
};

NicheDecider::Request verdictsFor(const PairFrame& frame, const LocalMinimaRequest& request) {
  NicheDecider::Request wanted;
  wanted.cutoff = request.cutoff + frame.rounding;
  wanted.least_prominence = request.least_prominence;
  wanted.through_material = request.through_material;
  wanted.is_tracked = request.is_tracked;
  // One more tells that the list is cut.
  wanted.most_niches = std::max(request.largest_count, request.largest_count + 1);
  if (!request.hidden) {
    // A set of minima is seen where its middle is.
    wanted.is_wanted = [&frame](const MinimumCandidate& seed, Occluder& occluder) {
      return !seed.is_point || seed.distance == 0.0 ||
             isVisible(frame.a, frame.b, frame.a_from_b, frame.witnessOf(seed), occluder);
    };
  }
  return wanted;
}

bool LocalMinimaParts::decide(const PairFrame& frame, const LocalMinimaRequest& request,
                              LocalMinimaCost& cost, WorkLimit& limit) {
  const NicheDecider::Request wanted = verdictsFor(frame, request);
  described_as.clear();
  verdicts.begin(frame, seeds, wanted, limit);
  do {
    verdicts.judgeByMemory(frame, wanted, limit);
    describeNiches(frame, request, limit);
    limit.allowShare(request.time_shares.floods);
    verdicts.judgeByFloods(frame, wanted, limit);
    limit.allowShare(request.time_shares.all);
    describeNiches(frame, request, limit);
  } while (!verdicts.hasJudgedAll() && described.size() <= request.largest_count && !limit.isOver());
  const auto place = [](std::uint32_t judged) {
    if (judged == NicheDecider::kUndecided) return kUndecided;
    return judged == NicheDecider::kNone ? kNoOwner : std::size_t{judged};
  };
  for (std::size_t i = 0; i < request.asked_pairs.size(); ++i) {
    const auto& [a, b] = request.asked_pairs[i];
    std::uint32_t owner = NicheDecider::kNone;
    if (i < request.asked_regions.size()) owner = verdicts.nicheWith(request.asked_regions[i]);
    if (owner == NicheDecider::kNone) owner = verdicts.locate(frame, {a, b}, wanted, limit);
    owners.push_back(place(owner));
  }
  for (const MinimumCandidate& proposal : request.proposals) {
    const bool is_candidate = isCandidate(frame, request, proposal);
    proposed.push_back(is_candidate ? place(verdicts.locate(frame, {proposal.a, proposal.b}, wanted, limit))
                                    : kNoOwner);
  }
  describeNiches(frame, request, limit);
  cost.flooded_pairs += verdicts.counts().flooded_cells;
  for (std::vector<std::size_t>* of : {&owners, &proposed}) {
    for (std::size_t& owner : *of) {
      if (owner == kNoOwner || owner == kUndecided) continue;
      owner = described_as[owner] != kNoOwner ? described_as[owner]
                                              : kUndecided;  // there was no time to describe it
    }
  }
  return std::none_of(verdicts.judged().begin(), verdicts.judged().end(),
                      [](const auto& judged) { return judged.verdict == NicheDecider::Verdict::Undecided; });
}

void LocalMinimaParts::describeNiches(const PairFrame& frame, const LocalMinimaRequest& request,
                                      WorkLimit& limit) {
  const std::vector<NicheDecider::Judged>& judged = verdicts.judged();
  described_as.resize(judged.size(), kNoOwner);
  for (std::size_t i = 0; i < judged.size(); ++i) {
    if (judged[i].verdict != NicheDecider::Verdict::Niche || described_as[i] != kNoOwner) continue;
    if (limit.isOver()) return;
    const MinimumCandidate& seed = judged[i].seed;
    described_as[i] = minima.size();
    minima.push_back({seed, std::numeric_limits<double>::infinity(),
                      (1.0 + request.least_prominence) * seed.distance, judged[i].was_found,
                      judged[i].region});
    describe(frame, request, !request.hidden && seed.is_point, limit);
  }
}

bool LocalMinimaParts::measure(const PairFrame& frame, const LocalMinimaRequest& request,
                               LocalMinimaCost& cost, WorkLimit& limit) {
  const std::size_t owned = seeds.size();
  // Of each that is asked for and proposed its place among the seeds.
  places.clear();
  const auto start_at = [&](const MinimumCandidate& seed) {
    const bool is_candidate = isCandidate(frame, request, seed);
    places.push_back(is_candidate ? seeds.size() - owned : kNoOwner);
    if (is_candidate) seeds.push_back(seed);
  };
  for (const auto& [a, b] : request.asked_pairs) {
    start_at(frame.candidateOf(refineWitness(frame.a, frame.b, frame.a_from_b, a, b, refinement).witness));
  }
  for (const MinimumCandidate& proposal : request.proposals) start_at(proposal);
  FloodResult flood = floodMinima(frame, request, seeds, owned, cost, limit);
  for (const FloodedMinimum& minimum : flood.minima) {
    if (limit.isOver()) break;
    minima.push_back(minimum);
    describe(frame, request, false, limit);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::vector<std::size_t>& of = i < request.asked_pairs.size() ? owners : proposed;
    of.push_back(places[i] == kNoOwner ? kNoOwner : flood.owners[places[i]]);
  }
  for (std::vector<std::size_t>* of : {&owners, &proposed}) {
    for (std::size_t& owner : *of) {
      if (owner >= minima.size() && (flood.cut || owner != kNoOwner)) owner = kUndecided;
    }
  }
  return !flood.cut;
}

void LocalMinimaParts::describe(const PairFrame& frame, const LocalMinimaRequest& request, bool is_seen,
                                WorkLimit& limit) {
  const FloodedMinimum& minimum = minima.back();
  LocalMinimum niche;
  niche.prominence = minimum.seed.distance > 0.0 ? minimum.pass / minimum.seed.distance - 1.0
                                                 : std::numeric_limits<double>::infinity();
  niche.flooded = minimum.flooded;
  niche.region = minimum.region;
  if (describer.describe(frame, request, minimum.seed, minimum.met_by_flood, is_seen, niche, limit)) {
    described.push_back({niche, minima.size() - 1});
  }
}

void LocalMinimaParts::list(const LocalMinimaRequest& request, LocalMinima& result) {
  std::sort(described.begin(), described.end(), [&](const Described& l, const Described& r) {
    if (l.niche.distance != r.niche.distance) return l.niche.distance < r.niche.distance;
    const MinimumCandidate& of_l = minima[l.minimum].seed;
    const MinimumCandidate& of_r = minima[r.minimum].seed;
    return of_l.a != of_r.a ? of_l.a < of_r.a : of_l.b < of_r.b;
  });
  result.cut = described.size() > request.largest_count;
  if (result.cut) described.resize(request.largest_count);
  refill(places, minima.size(), kNoOwner);
  for (const Described& entry : described) {
    places[entry.minimum] = result.niches.size();
    result.niches.push_back(entry.niche);
    result.cost.met_by_flood += minima[entry.minimum].met_by_flood ? 1 : 0;
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
  parts_->verdicts.clear();
}

std::size_t LocalMinimaMemory::memoryBytes() const {
  return parts_ != nullptr ? parts_->memoryBytes() : 0;
}

void findLocalMinima(const detail::PairFrame& frame, const LocalMinimaRequest& request,
                     LocalMinimaMemory& memory, LocalMinima& result) {
  detail::LocalMinimaParts& parts = memory.parts();
  WorkLimit none;
  WorkLimit& limit = request.limit != nullptr ? *request.limit : none;
  const bool refused_before = limit.hasRefusedMemory();
  result.niches.clear();
  result.owners.clear();
  result.cost = {};
  parts.describer.begin(frame, request);
  parts.minima.clear();
  parts.described.clear();
  parts.owners.clear();
  parts.proposed.clear();
  const auto start = WorkLimit::Clock::now();
  limit.allowShare(request.time_shares.search);
  const bool all = parts.collector.collect(frame, request, parts.seeds, result.cost, limit);
  result.cost.sweep_seconds = std::chrono::duration<double>(WorkLimit::Clock::now() - start).count();
  result.cost.minima = parts.seeds.size();
  limit.allowShare(request.time_shares.all);
  // What is proposed counts while not everything has been looked at.
  if (!all) detail::appendCandidates(frame, request, request.proposals, parts.seeds);
  const bool measures =
      request.prominence_limit > request.least_prominence && !detail::isFar(frame, request.least_prominence);
  const bool decided = measures ? parts.measure(frame, request, result.cost, limit)
                                : parts.decide(frame, request, result.cost, limit);
  result.finished = all && decided && !limit.isOver() && limit.hasRefusedMemory() == refused_before;
  parts.list(request, result);
}

void attributeProposals(const detail::PairFrame& frame, const LocalMinimaRequest& request,
                        LocalMinimaMemory& memory, LocalMinima& result) {
  detail::LocalMinimaParts& parts = memory.parts();
  const detail::NicheDecider::Request wanted = detail::verdictsFor(frame, request);
  WorkLimit none;
  WorkLimit& limit = request.limit != nullptr ? *request.limit : none;
  for (std::size_t i = request.proposals.size(); i-- > 0;) {
    const MinimumCandidate& proposal = request.proposals[i];
    if (!detail::isCandidate(frame, request, proposal)) continue;
    const std::uint32_t judged = parts.verdicts.locate(frame, {proposal.a, proposal.b}, wanted, limit);
    // A place that locate() was the first to meet is not in the list.
    if (judged >= parts.described_as.size() || parts.described_as[judged] >= parts.places.size()) continue;
    const std::size_t place = parts.places[parts.described_as[judged]];
    if (place != LocalMinima::kNoOwner) result.niches[place].proposal = i;
  }
}

LocalMinima findLocalMinima(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                            const LocalMinimaRequest& request) {
  LocalMinimaMemory once;
  LocalMinima result;
  WorkLimit none;
  const MemoryScope memory(request.limit != nullptr ? *request.limit : none);
  findLocalMinima(detail::PairFrame::withFacets(a, b, a_from_b), request, once, result);
  return result;
}

}  // namespace concave_distance
