#include "tracker_state.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "niche_admission.h"
#include "node_niches.h"
#include "relative_motion.h"

namespace concave_distance {
namespace {

// Usual maximum of a warm cycle; buffers grow beyond it.
constexpr std::size_t kUsualMinima = 1024;
constexpr std::size_t kUsualNiches = 256;

// Shares of a time budget: of the niches, and of niches and proof together.
constexpr double kShareOfNiches = 0.5;
constexpr double kShareWithProof = 0.85;

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

TrackerState::TrackerState(std::string pair_name, std::shared_ptr<const BodyMesh> a,
                           std::shared_ptr<const BodyMesh> b, const TrackerParameters& given)
    : name(std::move(pair_name)),
      geometry(std::move(a), std::move(b)),
      parameters(given),
      search(*geometry.a, *geometry.b) {
  parameters.validate(name);
  proof.workspace.open.reserve(kUsualNiches);
}

// Made only when a search needs it: a proof alone needs no grids and little memory.
void TrackerState::prepareSearch() {
  if (search_prepared) return;
  search_prepared = true;
  // So large that a warm cycle does not have to grow them; a cold one may.
  search.reserve(kUsualMinima);
  known.reserve(kUsualMinima);
  candidates.reserve(kUsualNiches);
  archive.reserve(kUsualNiches);
  ripples.allocate();
  cold_radii = automaticRadii(*geometry.a, *geometry.b, parameters.cold);
  warm_radii = automaticRadii(*geometry.a, *geometry.b, parameters.warm);
}

void TrackerState::clear(PairSolution& solution) const {
  solution.status = SolveStatus::Ok;
  solution.accuracy = parameters.accuracy;
  solution.distance = solution.lower_bound = solution.surface_distance = kNotComputed;
  solution.point_a_in_a.setConstant(kNotComputed);
  solution.point_b_in_a.setConstant(kNotComputed);
  solution.normal_in_a.setConstant(kNotComputed);
  solution.closing_speed = kNotComputed;
  solution.meeting_triangles.reset();
  solution.niches.clear();
  solution.events.clear();
  solution.niches_cut = solution.niches_complete = solution.search_miss = false;
  solution.niches_beyond_cutoff = 0;
  solution.cycle = cycle;
  solution.warm = warm;
  solution.seed = parameters.seed;
  solution.cost = {};
  solution.proof_cost = {};
  solution.stages = {};
}

void TrackerState::reset() {
  archive.clear();
  ripples.clear();
  sweep.restart();
  swept.clear();
  warm = false;
  inward_witness_met = false;
  swallowed = false;
  proof.front.clear();
  proof.seeded = proof.current = false;
  completeness.current = false;
  completeness.memory.clear();
}

void TrackerState::restart(std::uint64_t largest_used_id) {
  reset();
  archive.beginIdsAfter(largest_used_id);
  cycle = 0;
  next_review = next_projection = 0;
  due_reviews = moved_since_search = 0.0;
  due_share = 1.0;
  cycles_since_search = cycles_at_rest = 0;
  searching = true;
  swept_at_rest = false;
  limit = {};
}

void TrackerState::update(const Eigen::Isometry3d& pose, double time, PairSolution& solution) {
  const auto start = std::chrono::steady_clock::now();
  const auto since_start = [start] { return seconds(std::chrono::steady_clock::now() - start); };
  const bool was_cut = limit.hasRefused();
  if (limit.hasRefusedMemory()) judging.verdicts = BasinVerdicts();  // the buffers of a flood too large
  limit = WorkLimit(start, parameters.time_budget, parameters.memory_limit, parameters.stop);
  limit.setTaken(memoryBytes());
  clear(solution);
  solution.a_from_b = pose;
  const std::optional<Eigen::Isometry3d> rigid = rigidPose(pose);
  if (!rigid) {
    solution.status = SolveStatus::InvalidPose;
    solution.solve_seconds = since_start();
    return;
  }
  geometry.setPose(*rigid);
  const double elapsed = warm && time > last_time ? time - last_time : 0.0;
  const double displacement =
      warm ? largestDisplacement(geometry.b->surface().boundingBox(), last_pose, *rigid)
           : std::numeric_limits<double>::infinity();
  const bool proves = provesDistance(parameters.accuracy);
  stage_clock.start();
  if (!proves || parameters.niches_wanted) {
    prepareSearch();
  }
  if (proves && !parameters.niches_wanted) {
    proveAlone(displacement, elapsed, solution);
    stage_clock.lap(SolveStage::Proof, solution.stages);
  } else if (parameters.accuracy == AccuracyLevel::Complete) {
    limit.allowShare(kShareOfNiches);
    completeNiches(displacement, elapsed, solution);
    stage_clock.lap(SolveStage::Sweep, solution.stages);
    listNiches(solution);
    stage_clock.lap(SolveStage::Describe, solution.stages);
    limit.allowShare(1.0);
    proveDistance(displacement);
    reportProven(solution);
    stage_clock.lap(SolveStage::Proof, solution.stages);
  } else {
    limit.allowShare(proves ? kShareOfNiches : kShareWithProof);
    cycles_at_rest = displacement > 0.0 || was_cut ? 0 : cycles_at_rest + 1;
    solveNiches(displacement, elapsed, solution);
    limit.allowShare(kShareWithProof);
    if (proves) {
      proveDistance(displacement);
      admitClosest(solution);
      stage_clock.lap(SolveStage::Proof, solution.stages);
    }
    limit.allowShare(1.0);
    describeNiches(solution);
    listNiches(solution);
    if (proves) {
      reportProven(solution);
    } else {
      reportNearest(displacement, solution);
    }
    stage_clock.lap(SolveStage::Describe, solution.stages);
  }
  if (!solution.niches.empty() && solution.niches.front().distance == solution.distance) {
    solution.normal_in_a = solution.niches.front().normal_in_a;
    solution.closing_speed = solution.niches.front().closing_speed;
  }
  reportLimit(solution);
  if (!warm) {
    search.shrink();
  }
  last_pose = *rigid;
  last_time = time;
  last_elapsed = elapsed;
  last_distance = solution.distance;
  warm = true;
  ++cycle;
  solution.solve_seconds = since_start();
}

// Levels `nodes` and `refined`: the niches at the geometry's pose.
void TrackerState::solveNiches(double displacement, double elapsed, PairSolution& solution) {
  const PairObjective objective(*geometry.a, *geometry.b, geometry.a_from_b);
  candidates.clear();
  inward_witness_met = inward_witness_met && cycles_at_rest > 0;
  search.basins.clear();

  if (warm) {
    if (swallowed) {
      followInwardWitness();
    }
    followNiches(displacement, elapsed, solution.cost, solution.events);
  }
  stage_clock.lap(SolveStage::Follow, solution.stages);
  searching = searchIsDue(displacement);
  if (searching) {
    const std::size_t known_minima = search.basins.minima().size();
    evolve(objective, solution);
    collectCandidates(known_minima);
  }
  settleCandidates(solution);
  stage_clock.lap(SolveStage::Search, solution.stages);
  projectNiches(solution);
  stage_clock.lap(SolveStage::Project, solution.stages);
  if (parameters.accuracy == AccuracyLevel::Nodes) {
    uniteWithinRadius(warm ? warm_radii.niche : cold_radii.niche, search.metric, archive, solution.events);
    improveNodePairs(objective, parameters.largest_niche_count, archive, geometry, solution.cost);
    stage_clock.lap(SolveStage::Search, solution.stages);
  } else {
    uniteSamePlaces(geometry, archive, solution.events);
    sweepCones(solution);
    stage_clock.lap(SolveStage::Sweep, solution.stages);
    reviewRecords(solution);
    stage_clock.lap(SolveStage::Review, solution.stages);
  }
}

std::size_t TrackerState::memoryBytes() const {
  return sizeof(TrackerState) + archive.records().capacity() * sizeof(NicheRecord) +
         candidates.capacity() * sizeof(NicheCandidate) +
         (known.capacity() + inherited.capacity()) * sizeof(TrialPoint) +
         proof.workspace.open.capacity() * sizeof(CertificateWorkspace::OpenPair) +
         proof.front.memoryBytes() + completeness.memoryBytes() + search.memoryBytes() +
         judging.verdicts.memoryBytes() + sweep.memoryBytes() + swept.capacity() * sizeof(MinimumSeed);
}

}  // namespace concave_distance
