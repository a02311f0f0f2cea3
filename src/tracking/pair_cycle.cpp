#include "pair_cycle.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "distance/kernels/pair_motion.h"
#include "distance/niches/niche_properties.h"
#include "mesh/trees/normal_cone_tree.h"
#include "node_niches.h"
#include "padded_solution.h"
#include "pair_answer.h"
#include "rigid_pose.h"
#include "search_stage.h"

namespace concave_distance {
namespace {

using detail::ConvexNiches;

constexpr std::size_t kUsualNiches = 256;

// Shares of a time budget, each of the whole time and with the stages before it.
constexpr double kShareOfProof = 0.4;
constexpr double kShareOfSearch = 0.55;
constexpr double kShareOfNiches = 0.95;

double seconds(WorkLimit::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

double secondsSince(WorkLimit::Clock::time_point start) {
  return seconds(WorkLimit::Clock::now() - start);
}

}  // namespace

PairCycle::PairCycle(std::string name, std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
                     const TrackerParameters& parameters, std::uint64_t largest_used_id, double pose_error)
    : name_(std::move(name)),
      a_(std::move(a)),
      b_(std::move(b)),
      parameters_(parameters),
      largest_used_id_(largest_used_id),
      pose_error_(pose_error),
      meshes_(a_, b_) {
  parameters_.validate(name_);
  meshes_.archive.beginIdsAfter(largest_used_id);
  round_.beginIdsAfter(largest_used_id);
}

void PairCycle::update(const Eigen::Isometry3d& pose, double time, PairSolution& solution, bool is_tracked) {
  const auto start = WorkLimit::Clock::now();
  limit_ = WorkLimit(start, parameters_.time_budget, parameters_.memory_limit, parameters_.stop);
  cycle_ends_first_ = false;
  if (begin(pose, time, solution, is_tracked)) {
    if (proves()) {
      limit_.allowShare(wantsNiches() ? kShareOfProof : 1.0);
      prove(solution);
    }
    if (wantsNiches()) findNiches(solution);
    report(solution);
    end(solution);
  }
  solution.solve_seconds = secondsSince(start);
}

bool PairCycle::prove(const Eigen::Isometry3d& pose, double time, PairSolution& solution,
                      WorkLimit::Clock::time_point cycle_end) {
  const auto start = WorkLimit::Clock::now();
  const double own = (wantsNiches() ? kShareOfProof : 1.0) * parameters_.time_budget;
  const double left = seconds(cycle_end - start);
  cycle_ends_first_ = left < own;
  limit_ = WorkLimit(start, std::min(own, left), parameters_.memory_limit, parameters_.stop);
  if (cycle_ends_first_ && !was_cut_) limit_.expectEnough();
  bool is_to_go_on = begin(pose, time, solution, true);
  if (is_to_go_on) {
    if (proves()) prove(solution);
    is_proof_cut_ = limit_.hasRefused();
    is_to_go_on = wantsNiches();
    if (proves()) reportAlone(solution);
    if (is_to_go_on) {
      padSolution(parameters_, solution);
    } else {
      was_cut_ = is_proof_cut_;
      reportCompleteness(solution);
      end(solution);
    }
  }
  solution.solve_seconds = secondsSince(start);
  return is_to_go_on;
}

bool PairCycle::addNiches(PairSolution& solution, WorkLimit::Clock::time_point cycle_end) {
  const auto start = WorkLimit::Clock::now();
  const double own = parameters_.time_budget - solution.solve_seconds;
  const double left = seconds(cycle_end - start);
  cycle_ends_first_ = left < own;
  limit_ = cycle_ends_first_ ? WorkLimit(start, left, parameters_.memory_limit, parameters_.stop)
                             : remainingWork(parameters_, solution.solve_seconds);
  if (cycle_ends_first_ && !was_cut_) limit_.expectEnough();
  limit_.setTaken(memoryBytes());
  beginSecondHalf(solution);
  findNiches(solution);
  report(solution);
  end(solution);
  solution.solve_seconds += secondsSince(start);
  was_cut_ = cycle_ends_first_ && limit_.hasRefusedTime();
  return !was_cut_;
}

void PairCycle::putOffNiches(PairSolution& solution) {
  const auto start = WorkLimit::Clock::now();
  if (!proves()) {
    addNiches(solution, start);  // its distance is that of the niches
    return;
  }
  beginSecondHalf(solution);
  carried_.clear();
  carried_.reserve(niches().capacity());
  for (const NicheRecord& record : niches()) {
    if (!record.reported) continue;
    carried_.push_back(record);
    carryRecord(carried_.back(), *frame_);
    carried_.back().niche.origin = NicheOrigin::Inherited;
  }
  std::sort(carried_.begin(), carried_.end(), [](const NicheRecord& l, const NicheRecord& r) {
    if (l.niche.distance != r.niche.distance) return l.niche.distance < r.niche.distance;
    return l.niche.id < r.niche.id;
  });
  listNiches(parameters_, carried_, solution);
  reportAlone(solution);
  const Moment last_niches = last_niches_;
  end(solution);
  last_niches_ = last_niches;
  solution.solve_seconds += secondsSince(start);
}

// The answer of the first half is in the frame that A was modelled in, and is given again.
void PairCycle::beginSecondHalf(PairSolution& solution) {
  const StageTimes stages = solution.stages;
  clearAnswer(parameters_, cycle_, isWarm(), solution);
  solution.stages = stages;
  stage_clock_.start();
}

// Takes what both halves of a cycle need. Returns false for a pose that is not rigid.
bool PairCycle::begin(const Eigen::Isometry3d& pose, double time, PairSolution& solution, bool is_tracked) {
  limit_.setTaken(memoryBytes());
  is_tracked_ = is_tracked;
  is_proof_cut_ = false;
  clearAnswer(parameters_, cycle_, isWarm(), solution);
  solution.a_from_b = pose;
  const std::optional<Eigen::Isometry3d> rigid = rigidPose(pose);
  if (!rigid) {
    solution.status = SolveStatus::InvalidPose;
    return false;
  }
  frame_.emplace(*a_, *b_, *rigid);
  stage_clock_.start();
  now_ = {*rigid, time, true};
  since_cycle_ = passed(last_cycle_, now_);
  since_niches_ = passed(last_niches_, now_);
  return true;
}

void PairCycle::end(PairSolution& solution) {
  stage_clock_.lap(SolveStage::Describe, solution.stages);
  last_cycle_ = now_;
  if (wantsNiches()) last_niches_ = last_cycle_;
  last_distance_ = solution.distance;
  padSolution(parameters_, solution);
  ++cycle_;
}

PairCycle::Passed PairCycle::passed(const Moment& before, const Moment& now) const {
  if (!before.known) return {std::numeric_limits<double>::infinity(), 0.0};
  return {detail::PairMotion(before.pose, now.pose).largestIn(b_->bounds()),
          std::max(0.0, now.time - before.time)};
}

void PairCycle::solve(const Eigen::Isometry3d& pose, PairSolution& solution) {
  restart();
  update(pose, 0.0, solution, false);
  restart();
}

void PairCycle::findNiches(PairSolution& solution) {
  if (isRound()) {
    solveRound(since_niches_, solution);
  } else if (isExact()) {
    solveExact(since_niches_, solution);
  } else {
    solveNodes(since_niches_, solution);
  }
}

void PairCycle::prove(PairSolution& solution) {
  std::optional<TrianglePair> nearest;
  if (wantsNiches() && !niches().empty()) {
    const WitnessPair& witness = niches().front().niche.witness;
    nearest = TrianglePair{witness.triangle_a, witness.triangle_b};
  }
  distance_before_ = last_cycle_.known ? proof_.certificate().distance : kNotComputed;
  proof_.prove(*frame_, parameters_, nearest, since_cycle_.displacement, limit_);
  stage_clock_.lap(SolveStage::Prove, solution.stages);
}

void PairCycle::solveNodes(const Passed& passed, PairSolution& solution) {
  limit_.allowShare(kShareOfNiches);
  NicheSearch& search = meshes_.search;
  NicheArchive& archive = meshes_.archive;
  search.begin(*a_, *b_, parameters_);
  followNodePairs(*frame_, search, passed.displacement, passed.elapsed, archive, solution.cost, limit_);
  stage_clock_.lap(SolveStage::Follow, solution.stages);
  known_.clear();
  for (const NicheRecord& record : archive.records()) known_.push_back(record.niche.node_pair);
  const std::vector<TrialPoint>& found = search.propose(
      *frame_, parameters_, known_, {name_, cycle_, isWarm(), false, isWarm()}, solution.cost, limit_);
  stage_clock_.lap(SolveStage::Propose, solution.stages);
  admitNodePairs(*frame_, parameters_, search, found, isWarm(), cycle_, archive, solution);
  stage_clock_.lap(SolveStage::Admit, solution.stages);
}

// A sphere or a capsule apart from the other body has the niches of its core, with the radius as a margin: a
// point or a segment in place of thousands of facets, and no facet is mistaken for the solid.
void PairCycle::chooseBasis() {
  const bool is_apart = proves() && !proof_.isPenetrating() && !proof_.isSwallowed();
  NicheBasis* wanted = &meshes_;
  if (is_apart && isRound() && !parameters_.keep_through_material) {
    if (cores_ == nullptr) {
      cores_ = NicheBasis::ofCores(a_, b_);
      takeCoreParameters();
    }
    if (cores_ != nullptr) wanted = cores_.get();
  }
  if (wanted != &meshes_) core_frame_.emplace(*cores_->a, *cores_->b, cores_->poseOf(now_.pose));
  if (wanted == basis_) return;
  wanted->reset();
  round_.forgetMeshNiches();
  basis_ = wanted;
}

void PairCycle::takeCoreParameters() {
  if (cores_ == nullptr) return;
  core_parameters_ = parameters_;
  core_parameters_.margin_a += cores_->margin_a;
  core_parameters_.margin_b += cores_->margin_b;
}

void PairCycle::solveExact(const Passed& passed, PairSolution& solution) {
  chooseBasis();
  NicheBasis& basis = *basis_;
  if (basis.niches.isUnchanged(passed.displacement)) return basis.archive.keepUnchanged(passed.elapsed);
  PairFrame& frame = basisFrame();
  frame.openFacets();
  frame.pose_error = pose_error_;
  const ConvexNiches convex = countConvexNiches();
  const bool are_counted = convex != ConvexNiches::Unknown;
  if (!basis.is_search_prepared && !are_counted && is_tracked_ && parameters_.search_share > 0.0)
    prepare(basis);
  limit_.allowShare(kShareOfSearch);
  if (!proves()) basis.niches.follow(frame, basis.archive, limit_);
  stage_clock_.lap(SolveStage::Follow, solution.stages);
  if (!are_counted && searchIsDue()) propose(solution.cost);
  if (proves() && (!proof_.isPenetrating() || convex == ConvexNiches::OnlyTheNearest)) {
    basis.niches.proposeProven(frame, provenOnBasis(), proof_.isPenetrating());
  }
  stage_clock_.lap(SolveStage::Propose, solution.stages);
  basis.niches.admit(frame, basisParameters(),
                     {cycle_, basis.poseOf(last_niches_.pose), passed.elapsed, is_tracked_, cutoffOfBasis(),
                      convex, cycle_ends_first_},
                     certainOnBasis(), kShareOfNiches, basis.archive, solution, limit_);
  basis.search.earn(basis.niches.evolved(), basis.niches.work(), parameters_.search_share);
  stage_clock_.lap(SolveStage::Admit, solution.stages);
  solution.stages[SolveStage::Sweep] = basis.niches.cost().sweep_seconds;
  solution.stages[SolveStage::Admit] -= basis.niches.cost().sweep_seconds;
}

// Two round solids are convex: their one niche needs no search.
void PairCycle::solveRound(const Passed& passed, PairSolution& solution) {
  const bool is_unchanged = passed.displacement == 0.0 && !round_.records().empty();
  if (!isPairOfShapes()) solveExact(passed, solution);
  if (is_unchanged && (isPairOfShapes() || basis_->niches.isUnchanged(passed.displacement)))
    return round_.keepUnchanged(passed.elapsed);
  round_.update(*frame_, basis_->archive, {cycle_, isWarm() ? passed.displacement : 0.0, passed.elapsed},
                solution.events);
}

// The certificate's is between the exact surfaces.
WitnessPair PairCycle::provenOnBasis() {
  WitnessPair witness = proof_.certificate().witness;
  if (!isRound()) return witness;
  if (basis_->a != a_) witness.triangle_a = TriangleIndex{0};
  if (basis_->b != b_) witness.triangle_b = TriangleIndex{0};
  return basis_->niches.refine(basisFrame(), witness);
}

double PairCycle::cutoffOfBasis() const {
  const double excess = basis_ == &meshes_ && isRound() ? RoundNiches::meshExcess(*frame_) : 0.0;
  return parameters_.cutoff + basisParameters().margin() + basis_->thickness + excess;
}

double PairCycle::certainOnBasis() const {
  const double certain = certainDistance();
  return certain > 0.0 ? std::max(0.0, certain + basis_->margin() - basis_->thickness) : certain;
}

// Niches that none can see, and those of far sides, are not counted; nor what a proof has not reached.
detail::ConvexNiches PairCycle::countConvexNiches() const {
  const bool is_proven = proves() && (proof_.certificate().status == CertificateStatus::Proven ||
                                      (proof_.isPenetrating() && !isRound()));
  if (!is_proven || parameters_.hidden || parameters_.keep_through_material) return ConvexNiches::Unknown;
  const NicheRule rule{parameters_.least_prominence, parameters_.prominence_limit,
                       basisParameters().margin()};
  return detail::countConvexNiches(
      basisFrame(), rule, certainOnBasis(),
      proof_.certificate().status != CertificateStatus::Penetrating && proof_.isSwallowed());
}

// Whenever a tracked pair has moved. A pose alone has nothing to inherit: there the search is for those that
// may have to end early.
bool PairCycle::searchIsDue() const {
  if (!proves()) return true;
  if (certainOnBasis() > cutoffOfBasis()) return false;  // there is no niche to find
  return parameters_.search_share > 0.0 && (is_tracked_ || limit_.isTimed());
}

void PairCycle::propose(SearchCost& cost) {
  const SearchStage stage{basisFrame(), parameters_, basis_->archive, basis_->search, basis_->niches, known_};
  if (proves()) {
    proposeAsHelper(stage, {name_, cycle_, isWarm(), true, is_tracked_}, cost, limit_);
  } else {
    proposeMinima(stage, {name_, cycle_, isWarm(), false, isWarm()}, cost, limit_);
  }
}

double PairCycle::certainDistance() const {
  if (!proves() || proof_.isPenetrating()) return 0.0;
  return proof_.certificate().lower_bound - proof_.error();
}

void PairCycle::report(PairSolution& solution) {
  limit_.allowShare(1.0);
  if (!wantsNiches()) {
    reportAlone(solution);
    return reportCompleteness(solution);
  }
  listNiches(parameters_, niches(), solution);
  if (proves()) {
    proof_.report(solution);
  } else {
    answerByNearest(*frame_, niches(), isExact() ? basis_->niches.nearestProposed() : nullptr, isRound(),
                    solution, limit_);
  }
  if (isWarm())
    solution.search_miss = proves() ? hasMissedNiche(solution.niches) : hasMissedNearest(solution);
  if (!solution.niches.empty() && solution.niches.front().distance == solution.distance) {
    solution.normal_in_a = solution.niches.front().normal_in_a;
    solution.closing_speed = solution.niches.front().closing_speed;
  }
  reportCompleteness(solution);
}

void PairCycle::reportAlone(PairSolution& solution) {
  proof_.report(solution);
  if (proof_.isSwallowed() && !parameters_.keep_through_material) return;
  NicheRecord nearest;
  placeRecord(nearest, *frame_, proof_.certificate().witness);
  solution.normal_in_a = nearest.niche.normal_in_a;
  const double elapsed = since_cycle_.elapsed;
  if (elapsed > 0.0) solution.closing_speed = (distance_before_ - proof_.certificate().distance) / elapsed;
}

// Its distance is less than the motion since allows the nearest one to have become.
bool PairCycle::hasMissedNearest(const PairSolution& solution) const {
  const double rounding = kPlateauTolerance * frame_->diameters();
  return solution.distance < last_distance_ - since_niches_.displacement - rounding;
}

// After the limit the answer is incomplete, even with a finished proof. Where the cycle ended before the
// pair's own budget, a proof that is finished is an answer in time.
void PairCycle::reportCompleteness(PairSolution& solution) const {
  const bool is_cut = is_proof_cut_ || limit_.hasRefused();
  const bool all = (basis_->niches.isFinished() || isPairOfShapes()) && !is_cut;
  solution.niches_complete = proves() && parameters_.niches_wanted && all && !solution.niches_cut;
  if (!limit_.hasRefused() || solution.status == SolveStatus::Penetrating) return;
  if (cycle_ends_first_ && proves() && !limit_.hasRefusedMemory()) return;
  solution.status = limit_.hasRefusedTime() ? SolveStatus::BudgetExhausted : SolveStatus::MemoryExhausted;
}

void PairCycle::prepare() {
  if (!wantsNiches()) return;
  prepare(meshes_);
  if (cores_ != nullptr) prepare(*cores_);
}

void PairCycle::prepare(NicheBasis& basis) {
  basis.search.prepare(*basis.a, *basis.b, parameters_);
  basis.is_search_prepared = true;
  basis.archive.reserve(kUsualNiches);
  known_.reserve(kUsualNiches);
  const NormalSides sides = parameters_.keep_through_material ? NormalSides::Both : NormalSides::Outside;
  for (const BodyMesh* body : {basis.a.get(), basis.b.get()}) {
    if (isExact()) body->prepareNiches(sides);
  }
}

void PairCycle::reset() {
  meshes_.reset();
  if (cores_ != nullptr) cores_->reset();
  round_.clear();
  proof_.clear();
  last_cycle_.known = last_niches_.known = false;
  was_cut_ = true;
}

void PairCycle::restart() {
  reset();
  meshes_.archive.beginIdsAfter(largest_used_id_);
  round_.beginIdsAfter(largest_used_id_);
  cycle_ = 0;
  limit_ = {};
}

void PairCycle::setParameters(const TrackerParameters& parameters) {
  parameters.validate(name_);
  // Node niches and refined ones are not the same places.
  const bool changes_niches = parameters.accuracy != parameters_.accuracy;
  parameters_ = parameters;
  if (changes_niches || (wantsNiches() && !last_niches_.known)) reset();
  proof_.renew();
  takeCoreParameters();
  for (NicheBasis* basis : {&meshes_, cores_.get()}) {
    if (basis == nullptr) continue;
    basis->niches.renew();
    basis->search.forgetParameters();
  }
}

std::size_t PairCycle::memoryBytes() const {
  return sizeof(PairCycle) + meshes_.memoryBytes() + (cores_ != nullptr ? cores_->memoryBytes() : 0) +
         known_.capacity() * sizeof(TrialPoint) + proof_.memoryBytes() + round_.memoryBytes() +
         carried_.capacity() * sizeof(NicheRecord);
}

}  // namespace concave_distance
