#include "concave_distance/tracking/pair_tracker.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "concave_distance/base/error.h"
#include "mesh/surface/connected_pieces.h"
#include "mesh/surface/triangle_adjacency.h"
#include "mesh/trees/normal_cone_tree.h"
#include "niche_admission.h"
#include "node_niches.h"
#include "relative_motion.h"
#include "tracker_state.h"

namespace concave_distance {
namespace {

// Usual maximum of a warm cycle; buffers grow beyond it.
constexpr std::size_t kUsualMinima = 1024;
constexpr std::size_t kUsualNiches = 256;

// Shares of a time budget: of the niches, and of niches and proof together.
constexpr double kShareOfNiches = 0.5;
constexpr double kShareWithProof = 0.85;

// So many that making a tracker does not count.
constexpr std::size_t kPosesOfOneTracker = 16;

void requireBodies(const std::string& name, const std::shared_ptr<const BodyMesh>& a,
                   const std::shared_ptr<const BodyMesh>& b) {
  if (a && b) return;
  throw Error(name, std::string("body ") + (a ? "B" : "A") + " is null",
              "give a body that was loaded or made");
}

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

struct PairTracker::State : TrackerState {
  using TrackerState::TrackerState;

  std::uint64_t largest_used_id = 0;
};

PairTracker::PairTracker(std::string name, std::shared_ptr<const BodyMesh> a,
                         std::shared_ptr<const BodyMesh> b, const TrackerParameters& parameters,
                         std::uint64_t largest_used_id) {
  requireBodies(name, a, b);
  state_ = std::make_unique<State>(std::move(name), std::move(a), std::move(b), parameters);
  state_->largest_used_id = largest_used_id;
  state_->archive.beginIdsAfter(largest_used_id);
}
PairTracker::~PairTracker() = default;
PairTracker::PairTracker(PairTracker&&) noexcept = default;
PairTracker& PairTracker::operator=(PairTracker&&) noexcept = default;

PairTracker::State& PairTracker::state() const {
  if (state_ == nullptr) throw Error("PairTracker", "it was moved from", "use the one that it was moved to");
  return *state_;
}

void PairTracker::update(const Eigen::Isometry3d& a_from_b, double time, PairSolution& solution) {
  state().update(a_from_b, time, solution);
}

void PairTracker::prepare(const std::vector<Eigen::Isometry3d>& a_from_b) {
  State& tracker = state();
  const TrackerParameters& parameters = tracker.parameters;
  if (!provesDistance(parameters.accuracy) || parameters.niches_wanted) {
    tracker.prepareSearch();
    const NormalSides sides = parameters.keep_through_material ? NormalSides::Both : NormalSides::Outside;
    for (const BodyMesh* body : {tracker.geometry.a.get(), tracker.geometry.b.get()}) {
      body->adjacency();
      body->pieces();
      if (parameters.accuracy != AccuracyLevel::Nodes) body->normalCones(sides);
    }
  }
  PairSolution solution;
  double time = 0.0;
  for (const Eigen::Isometry3d& pose : a_from_b) update(pose, time += 1.0, solution);
  restart();
}

void PairTracker::reset() {
  state().reset();
}

void PairTracker::restart() {
  state().restart(state().largest_used_id);
}

void PairTracker::setParameters(const TrackerParameters& parameters) {
  State& tracker = state();
  parameters.validate(tracker.name);
  const TrackerParameters& before = tracker.parameters;
  const bool proves_alone =
      provesDistance(parameters.accuracy) && parameters.niches_wanted != before.niches_wanted;
  if (parameters.accuracy != before.accuracy || proves_alone) {
    tracker.reset();  // node niches and refined ones are not the same places; a proof alone follows none
  }
  tracker.parameters = parameters;
  tracker.proof.current = tracker.completeness.current = false;
  tracker.search_prepared = false;
  // Up to another cutoff, or for another prominence.
  tracker.sweep.restart();
  tracker.swept.clear();
  tracker.swept_at_rest = false;
}

std::size_t TrackerState::memoryBytes() const {
  return sizeof(TrackerState) + archive.records().capacity() * sizeof(NicheRecord) +
         candidates.capacity() * sizeof(NicheCandidate) +
         (known.capacity() + inherited.capacity()) * sizeof(TrialPoint) +
         proof.workspace.open.capacity() * sizeof(CertificateWorkspace::OpenPair) +
         proof.front.memoryBytes() + completeness.memoryBytes() + search.memoryBytes() +
         judging.verdicts.memoryBytes() + sweep.memoryBytes() + swept.capacity() * sizeof(MinimumSeed);
}

std::size_t PairTracker::memoryBytes() const {
  return state().memoryBytes();
}

const TrackerParameters& PairTracker::parameters() const {
  return state().parameters;
}

PairSolution solveOnce(const std::string& name, const std::shared_ptr<const BodyMesh>& a,
                       const std::shared_ptr<const BodyMesh>& b, const TrackerParameters& parameters,
                       const Eigen::Isometry3d& a_from_b) {
  PairTracker tracker(name, a, b, parameters);
  PairSolution solution;
  tracker.update(a_from_b, 0.0, solution);
  return solution;
}

std::vector<PairSolution> solveEach(const std::string& name, const std::shared_ptr<const BodyMesh>& a,
                                    const std::shared_ptr<const BodyMesh>& b,
                                    const TrackerParameters& parameters,
                                    const std::vector<Eigen::Isometry3d>& a_from_b, std::uint32_t threads) {
  std::vector<PairSolution> solutions(a_from_b.size());
  // What the bodies make on demand is made before threads would wait for it.
  PairTracker(name, a, b, parameters).prepare();
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, a_from_b.size(), kPosesOfOneTracker),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        PairTracker tracker(name, a, b, parameters);
                        for (std::size_t i = range.begin(); i != range.end(); ++i) {
                          tracker.restart();
                          tracker.update(a_from_b[i], 0.0, solutions[i]);
                        }
                      });
  });
  return solutions;
}

}  // namespace concave_distance
