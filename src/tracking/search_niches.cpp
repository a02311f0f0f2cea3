#include <algorithm>

#include "concave_distance/base/random_engine.h"
#include "concave_distance/search/genetic_search.h"
#include "concave_distance/tracking/projection.h"
#include "concave_distance/tracking/warm_start.h"
#include "tracker_state.h"

namespace concave_distance {
namespace {

// Candidates that a warm cycle refines at the most, best first; a cold one takes them all.
constexpr std::size_t kWarmCandidateLimit = 64;
// Rounds of projections in a cold cycle: each asks what the last one brought.
constexpr int kColdProjectionRounds = 4;
// A cold cycle projects this many times the immigrants of a warm one.
constexpr std::uint32_t kColdProjectionFactor = 16;
// Tells the stream of the projections from that of the evolution.
constexpr std::uint64_t kProjectionStream = 0x70726f6a656374ULL;
// Ripples of the nearest niche that a cycle walks on from.
constexpr int kWarmRippleSteps = 5;
// Cycles of walking on over ripples from one and the same pose.
constexpr std::uint32_t kRestWalks = 16;
constexpr int kColdRippleSteps = 64;
// How much farther than the nearest niche a place to walk on from may be, in least prominences.
constexpr double kRippleReach = 5.0;

}  // namespace

bool TrackerState::searchIsDue(double displacement) {
  moved_since_search += displacement;
  ++cycles_since_search;
  const double edge = std::min(geometry.a->maxEdgeLength(), geometry.b->maxEdgeLength());
  if (warm && !archive.records().empty() && cycles_since_search < parameters.search_interval &&
      moved_since_search < parameters.search_motion * edge) {
    return false;
  }
  moved_since_search = 0.0;
  cycles_since_search = 0;
  return true;
}

void TrackerState::evolve(const PairObjective& objective, PairSolution& solution) {
  RandomEngine engine(streamSeed(parameters.seed, name, cycle));
  inherited.clear();
  GeneticParameters genetic = warm ? parameters.warm : parameters.cold;
  if (warm) {
    known.clear();
    for (const NicheRecord& record : archive.records()) {
      known.push_back(record.niche.node_pair);
    }
    const double softening = std::min(geometry.a->maxEdgeLength(), geometry.b->maxEdgeLength());
    inherit(known, {parameters.inherited_per_niche, parameters.inherited_limit}, softening, inherited,
            scratch);
    const auto wanted = static_cast<std::uint32_t>(inherited.size()) + parameters.immigrants;
    genetic.population_size = std::max(genetic.population_size, wanted + wanted % 2);
  }
  const GeneticResult result =
      geneticSearch(objective, genetic, warm ? warm_radii : cold_radii, inherited, engine, search);
  solution.cost.evaluations += result.cost.evaluations;
  solution.cost.descents += result.cost.descents;
  solution.cost.descents_joined += result.cost.descents_joined;
  solution.cost.descent_steps += result.cost.descent_steps;
  if (!genetic.local_optimization) {
    search.basins.addMinimum(result.best);
  }
}

void TrackerState::collectCandidates(std::size_t known_minima) {
  // Node pairs are cheap to compare: the best come first where a warm cycle has to choose.
  known.assign(search.basins.minima().begin() + static_cast<std::ptrdiff_t>(known_minima),
               search.basins.minima().end());
  std::sort(known.begin(), known.end());
  if (warm && known.size() > kWarmCandidateLimit) {
    known.resize(kWarmCandidateLimit);
  }
  for (const TrialPoint& pair : known) {
    if (parameters.accuracy == AccuracyLevel::Nodes) {
      candidates.push_back({geometry.nodeWitness(pair), pair, true, 0});
      continue;
    }
    const WitnessRefinement refined =
        geometry.refine(geometry.a->originalTriangle(pair.node_a), geometry.b->originalTriangle(pair.node_b));
    candidates.push_back({refined.witness, pair, refined.proven, 0});
  }
}

void TrackerState::projectNiches(PairSolution& solution) {
  if (parameters.accuracy == AccuracyLevel::Nodes) {
    return;
  }
  RandomEngine engine(streamSeed(parameters.seed ^ kProjectionStream, name, cycle));
  const std::uint32_t factor = warm ? 1 : kColdProjectionFactor;
  const std::uint32_t immigrants = searching ? factor * parameters.projected_immigrants : 0;
  candidates.clear();
  for (std::uint32_t k = 0; k < immigrants; ++k) {
    const Side side = k % 2 == 0 ? Side::A : Side::B;
    const NodeGraph& graph = (side == Side::A ? geometry.a : geometry.b)->graph();
    projectNode(geometry, side,
                NodeIndex{uniformIndex(engine, static_cast<std::uint32_t>(graph.nodeCount()))}, candidates);
  }
  settleCandidates(solution);

  // A warm cycle asks the nearest niche and the next ones in turn; a cold one all, and again what that
  // brought.
  std::uint64_t newest = 0;
  for (int round = 0; round < (warm ? 1 : kColdProjectionRounds); ++round) {
    const std::size_t count = archive.records().size();
    const std::size_t wanted =
        warm ? std::min<std::size_t>(searching ? parameters.projected_niches : 1, count) : count;
    for (std::size_t k = 0; k < wanted; ++k) {
      next_projection = warm && k > 0 ? (next_projection + 1) % count : next_projection;
      const NicheRecord& record = archive.records()[warm && k > 0 ? next_projection : k];
      if (warm || record.niche.id > newest) {
        projectWitness(geometry, record, candidates);
      }
    }
    for (const NicheRecord& record : archive.records()) {
      newest = std::max(newest, record.niche.id);
    }
    if (candidates.empty()) {
      break;
    }
    settleCandidates(solution);
  }
  walkRipples(solution);
}

void TrackerState::walkRipples(PairSolution& solution) {
  if (parameters.projected_niches == 0 || archive.records().empty() || cycles_at_rest > kRestWalks) {
    return;
  }
  // The global minimum of a tessellated valley is often the next ripple, or one a few ripples on. Those known
  // are followed; from the deepest and from the ones least recently left the walk goes on.
  const auto belongs = [&](const Ripple& ripple) {
    return ripple.owner == archive.records().front().niche.id;
  };
  ripples.follow(archive.records().front().niche.id, archive.records().front().niche.witness, geometry);
  for (Ripple& ripple : ripples.ripples()) {
    const bool deeper =
        ripple.witness.squared_distance < archive.records().front().niche.witness.squared_distance;
    if (belongs(ripple) && (deeper || ripple.judged + kRippleJudgement <= cycle)) {
      candidates.push_back({ripple.witness, geometry.nodePairNear(ripple.witness), true, 0});
    }
  }
  settleRipples(solution);
  const std::array<FeatureKey, 2> here = featuresOf(geometry, archive.records().front().niche.witness);
  const std::vector<NicheRecord>& records = archive.records();
  const bool smooth =
      std::none_of(ripples.ripples().begin(), ripples.ripples().end(), belongs) &&
      std::none_of(records.begin() + 1, records.end(), [&](const NicheRecord& r) { return isBeside(r); });
  if (!searching && smooth && here == last_features) {
    return;
  }
  last_features = here;
  std::array<FeatureKey, 2> walked_from{};
  for (int step = 0; step < (warm ? kWarmRippleSteps : kColdRippleSteps); ++step) {
    const WitnessPair deepest = archive.records().front().niche.witness;
    const std::array<FeatureKey, 2> features = featuresOf(geometry, deepest);
    if (!(features == walked_from)) {
      walked_from = features;
      stepOverRipples(geometry, deepest, candidates);
    } else {
      const std::optional<WitnessPair> next = nextToWalkFrom();
      if (!next) {
        break;
      }
      stepOverRipples(geometry, *next, candidates);
    }
    settleRipples(solution);
  }
}

// A niche between which and the nearest one the grid has no nodes: a ripple but for its prominence.
bool TrackerState::isBeside(const NicheRecord& record) const {
  const NicheRecord& nearest = archive.records().front();
  const double within = (1.0 + kRippleReach * parameters.least_prominence) * nearest.niche.distance;
  const double gap = (record.niche.point_a_in_a - nearest.niche.point_a_in_a).norm() +
                     (record.point_b_in_b - nearest.point_b_in_b).norm();
  return record.niche.distance <= within && gap <= geometry.a->maxEdgeLength() + geometry.b->maxEdgeLength();
}

// Of the ripples of the nearest niche and the niches beside it, the one longest not walked from.
std::optional<WitnessPair> TrackerState::nextToWalkFrom() {
  const TrackedNiche& nearest = archive.records().front().niche;
  const double within = (1.0 + kRippleReach * parameters.least_prominence) * nearest.distance;
  std::uint64_t* longest = nullptr;
  const WitnessPair* next = nullptr;
  const auto consider = [&](const WitnessPair& witness, std::uint64_t& walked) {
    if (walked <= cycle && witness.squared_distance <= within * within &&
        (longest == nullptr || walked < *longest)) {
      longest = &walked;
      next = &witness;
    }
  };
  for (Ripple& ripple : ripples.ripples()) {
    if (ripple.owner == nearest.id) {
      consider(ripple.witness, ripple.walked);
    }
  }
  for (std::size_t i = 1; i < archive.records().size(); ++i) {
    if (isBeside(archive.records()[i])) {
      consider(archive.records()[i].niche.witness, archive.records()[i].walked);
    }
  }
  if (next == nullptr) {
    return std::nullopt;
  }
  *longest = cycle + 1;
  return *next;
}

void TrackerState::settleRipples(PairSolution& solution) {
  const std::uint64_t id = archive.records().front().niche.id;
  const WitnessPair before = archive.records().front().niche.witness;
  settleCandidates(solution);
  const TrackedNiche& now = archive.records().front().niche;
  if (now.id == id && now.witness.squared_distance < before.squared_distance) {
    ripples.remember(geometry, before, id, cycle);
  }
}

}  // namespace concave_distance
