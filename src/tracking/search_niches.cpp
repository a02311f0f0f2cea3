#include <algorithm>
#include <limits>

#include "base/random_engine.h"
#include "mesh/trees/normal_cone_tree.h"
#include "projection.h"
#include "search/genetic_search.h"
#include "tracker_state.h"
#include "warm_start.h"

namespace concave_distance {
namespace {

// Candidates that a warm cycle refines, at most, best first; a cold one takes them all.
constexpr std::size_t kWarmCandidateLimit = 64;
// Rounds of projections in a cold cycle: each asks what the last one brought.
constexpr int kColdProjectionRounds = 4;
// A cold cycle projects this many times the immigrants of a warm one.
constexpr std::uint32_t kColdProjectionFactor = 16;
// Tells the stream of the projections from that of the evolution.
constexpr std::uint64_t kProjectionStream = 0x70726f6a656374ULL;

}  // namespace

bool TrackerState::searchIsDue(double displacement) {
  moved_since_search += displacement;
  ++cycles_since_search;
  const double edge = std::min(geometry.a->maxEdgeLength(), geometry.b->maxEdgeLength());
  const double least_share = 1.0 / parameters.search_interval;
  due_share = warm && displacement < parameters.search_motion * edge
                  ? std::max(least_share, displacement / (parameters.search_motion * edge))
                  : 1.0;
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
  const bool as_warm = warm || (parameters.accuracy != AccuracyLevel::Nodes && sweepsCones());
  GeneticParameters genetic = as_warm ? parameters.warm : parameters.cold;
  if (warm) {
    known.clear();
    for (const NicheRecord& record : archive.records()) {
      known.push_back(record.niche.node_pair);
    }
    const double softening = std::min(geometry.a->maxEdgeLength(), geometry.b->maxEdgeLength());
    inherit(known, {parameters.inherited_per_niche, parameters.inherited_limit}, softening, inherited,
            scratch);
    const auto wanted = static_cast<std::uint32_t>(inherited.size()) + parameters.random_starts;
    genetic.population_size = std::max(genetic.population_size, wanted + wanted % 2);
  }
  const GeneticResult result = geneticSearch(objective, genetic, as_warm ? warm_radii : cold_radii, inherited,
                                             engine, search, {}, &limit);
  solution.cost.evaluations += result.cost.evaluations;
  solution.cost.descents += result.cost.descents;
  solution.cost.descents_joined += result.cost.descents_joined;
  solution.cost.descent_steps += result.cost.descent_steps;
  if (genetic.local_optimization == LocalOptimization::None) {
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
    if (!candidates.empty() && limit.isOver()) return;
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
  const std::uint32_t node_count = searching ? factor * parameters.projected_nodes : 0;
  candidates.clear();
  for (std::uint32_t k = 0; k < node_count && !limit.isOver(); ++k) {
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
    for (std::size_t k = 0; k < wanted && !limit.isOver(); ++k) {
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
}

// What no search looks for but a look at all normal cones finds: a part of them in a warm cycle, where the
// last one has ended; all in a cold one.
void TrackerState::sweepCones(PairSolution& solution) {
  if (cycles_at_rest == 0) swept_at_rest = false;
  if (!sweepsCones() || swept_at_rest) {
    return;
  }
  if (cycles_at_rest == 1) sweep.restart();
  const std::size_t budget = warm ? static_cast<std::size_t>(due_share * parameters.swept_cones)
                                  : std::numeric_limits<std::size_t>::max();
  double cutoff = parameters.cutoff;
  if (archive.records().size() > parameters.largest_niche_count) {
    cutoff = std::min(cutoff, archive.records()[parameters.largest_niche_count].niche.distance);
  }
  if (limit.isOver()) return;
  // If the time ran out, pairs are left from the last sweep.
  if (swept.empty()) {
    solution.cost.evaluations +=
        sweep.advance(*geometry.a, *geometry.b, geometry.a_from_b,
                      parameters.keep_through_material ? NormalSides::Both : NormalSides::Outside, cutoff,
                      budget, swept, parameters.least_prominence, &limit);
  }
  swept_at_rest = cycles_at_rest > 0 && sweep.finished();
  auto taken = swept.begin();
  for (; taken != swept.end() && !limit.isOver() && limit.makeRoom(candidates); ++taken) {
    const MinimumSeed& pair = *taken;
    const WitnessRefinement refined = geometry.refine(pair.a, pair.b);
    candidates.push_back({refined.witness, geometry.nodePairNear(refined.witness), refined.proven, 0});
  }
  swept.erase(swept.begin(), taken);
  settleCandidates(solution);
}

}  // namespace concave_distance
