#include "pair_cycle.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "distance/kernels/pair_motion.h"
#include "padded_solution.h"
#include "pair_answer.h"
#include "rigid_pose.h"

namespace concave_distance {
namespace {

constexpr double kShareOfProof = 0.4;  // of a time budget, where niches come after it

double seconds(WorkLimit::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

double secondsSince(WorkLimit::Clock::time_point start) {
  return seconds(WorkLimit::Clock::now() - start);
}

}  // namespace

PairCycle::PairCycle(std::string name, std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
                     const TrackerParameters& parameters, std::uint64_t largest_used_id, double pose_error)
    : stages_(std::move(name), std::move(a), std::move(b), parameters, pose_error),
      largest_used_id_(largest_used_id) {
  stages_.beginIdsAfter(largest_used_id);
}

void PairCycle::update(const Eigen::Isometry3d& pose, double time, PairSolution& solution, bool is_tracked) {
  const auto start = WorkLimit::Clock::now();
  limit_ = WorkLimit(start, stages_.parameters().time_budget, stages_.parameters().facet_pair_limit,
                     stages_.parameters().stop);
  stages_.cycle().ends_first = false;
  if (begin(pose, time, solution, is_tracked)) {
    if (proves()) {
      limit_.allowShare(wantsNiches() ? kShareOfProof : 1.0);
      prove(solution);
    }
    if (wantsNiches()) stages_.findNiches(solution, limit_);
    report(solution);
    end(solution);
  }
  solution.solve_seconds = secondsSince(start);
}

bool PairCycle::prove(const Eigen::Isometry3d& pose, double time, PairSolution& solution,
                      WorkLimit::Clock::time_point cycle_end) {
  const auto start = WorkLimit::Clock::now();
  const double own = (wantsNiches() ? kShareOfProof : 1.0) * stages_.parameters().time_budget;
  const double left = seconds(cycle_end - start);
  stages_.cycle().ends_first = left < own;
  limit_ =
      WorkLimit(start, std::min(own, left), stages_.parameters().facet_pair_limit, stages_.parameters().stop);
  if (stages_.cycle().ends_first && !was_cut_) limit_.expectEnough();
  bool is_to_go_on = begin(pose, time, solution, true);
  if (is_to_go_on) {
    if (proves()) prove(solution);
    is_proof_cut_ = limit_.hasRefused();
    is_to_go_on = wantsNiches();
    if (proves()) reportAlone(solution);
    if (is_to_go_on) {
      padSolution(stages_.parameters(), solution);
    } else {
      was_cut_ = is_proof_cut_;
      reportCompleteness(solution);
      end(solution);
    }
  }
  solution.solve_seconds = secondsSince(start);
  return is_to_go_on;
}

void PairCycle::prove(PairSolution& solution) {
  stages_.prove(solution, limit_);
  is_proof_made_ = true;
}

bool PairCycle::addNiches(PairSolution& solution, WorkLimit::Clock::time_point cycle_end) {
  const auto start = WorkLimit::Clock::now();
  const double own = stages_.parameters().time_budget - solution.solve_seconds;
  const double left = seconds(cycle_end - start);
  stages_.cycle().ends_first = left < own;
  limit_ = stages_.cycle().ends_first
               ? WorkLimit(start, left, stages_.parameters().facet_pair_limit, stages_.parameters().stop)
               : remainingWork(stages_.parameters(), solution.solve_seconds);
  if (stages_.cycle().ends_first && !was_cut_) limit_.expectEnough();
  beginSecondHalf(solution);
  stages_.findNiches(solution, limit_);
  report(solution);
  end(solution);
  solution.solve_seconds += secondsSince(start);
  was_cut_ = stages_.cycle().ends_first && limit_.hasRefusedTime();
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
  carried_.reserve(stages_.records().capacity());
  for (const NicheRecord& record : stages_.records()) {
    if (!record.reported) continue;
    carried_.push_back(record);
    carryRecord(carried_.back(), stages_.frame());
    carried_.back().niche.origin = NicheOrigin::Inherited;
  }
  std::sort(carried_.begin(), carried_.end(), [](const NicheRecord& l, const NicheRecord& r) {
    if (l.niche.distance != r.niche.distance) return l.niche.distance < r.niche.distance;
    return l.niche.id < r.niche.id;
  });
  listNiches(stages_.parameters(), carried_, solution);
  reportAlone(solution);
  const Moment last_niches = last_niches_;
  end(solution);
  last_niches_ = last_niches;
  solution.solve_seconds += secondsSince(start);
}

void PairCycle::endWithoutMemory(PairSolution& solution) const {
  clearAnswer(stages_.parameters(), stages_.cycle().number, isWarm(), solution);
  if (is_proof_made_) {
    reportAlone(solution);
  } else {
    answerByVertices(stages_.parameters(), stages_.a(), stages_.b(), now_.pose, solution);
  }
  if (solution.status != SolveStatus::Penetrating) solution.status = SolveStatus::MemoryExhausted;
  padSolution(stages_.parameters(), solution);
}

// The answer of the first half is in the frame that A was modelled in, and is given again.
void PairCycle::beginSecondHalf(PairSolution& solution) {
  const StageTimes stages = solution.stages;
  clearAnswer(stages_.parameters(), stages_.cycle().number, isWarm(), solution);
  solution.stages = stages;
  stages_.clock().start();
}

// Takes what both halves of a cycle need. Returns false for a pose that is not rigid.
bool PairCycle::begin(const Eigen::Isometry3d& pose, double time, PairSolution& solution, bool is_tracked) {
  is_proof_made_ = is_proof_cut_ = false;
  clearAnswer(stages_.parameters(), stages_.cycle().number, isWarm(), solution);
  solution.a_from_b = pose;
  const std::optional<Eigen::Isometry3d> rigid = rigidPose(pose);
  if (!rigid) {
    solution.status = SolveStatus::InvalidPose;
    return false;
  }
  now_ = {*rigid, time, true};
  PairStages::Cycle& cycle = stages_.cycle();
  cycle.is_tracked = is_tracked;
  cycle.is_first = !last_cycle_.known;
  cycle.is_warm = isWarm();
  cycle.since_last = passed(last_cycle_, now_);
  cycle.since_niches = passed(last_niches_, now_);
  cycle.last_niches_pose = last_niches_.pose;
  stages_.begin(*rigid);
  return true;
}

void PairCycle::end(PairSolution& solution) {
  stages_.clock().lap(SolveStage::Describe, solution.stages);
  last_cycle_ = now_;
  if (wantsNiches()) last_niches_ = last_cycle_;
  last_distance_ = solution.distance;
  if (stages_.parameters().signed_values && stages_.isExact()) {
    signed_values_.update(stages_.frame(), {stages_.cycle().number, stages_.cycle().since_last.displacement},
                          solution, limit_);
  }
  padSolution(stages_.parameters(), solution);
  ++stages_.cycle().number;
}

PairStages::Passed PairCycle::passed(const Moment& before, const Moment& now) const {
  if (!before.known) return {std::numeric_limits<double>::infinity(), 0.0};
  return {detail::PairMotion(before.pose, now.pose).largestIn(stages_.b().bounds()),
          std::max(0.0, now.time - before.time)};
}

void PairCycle::solve(const Eigen::Isometry3d& pose, PairSolution& solution) {
  restart();
  update(pose, 0.0, solution, false);
  restart();
}

void PairCycle::report(PairSolution& solution) {
  limit_.allowShare(1.0);
  if (!wantsNiches()) {
    reportAlone(solution);
    return reportCompleteness(solution);
  }
  listNiches(stages_.parameters(), stages_.records(), solution);
  if (proves()) {
    stages_.proof().report(solution);
  } else {
    answerByNearest(stages_.frame(), stages_.records(), stages_.nearestProposed(), stages_.isRound(),
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

void PairCycle::reportAlone(PairSolution& solution) const {
  stages_.proof().report(solution);
  if (stages_.proof().isSwallowed() && !stages_.parameters().keep_through_material) return;
  NicheRecord nearest;
  placeRecord(nearest, stages_.frame(), stages_.proof().certificate().witness);
  solution.normal_in_a = nearest.niche.normal_in_a;
  const double elapsed = stages_.cycle().since_last.elapsed;
  if (elapsed > 0.0)
    solution.closing_speed = (stages_.distanceBefore() - stages_.proof().certificate().distance) / elapsed;
}

// Its distance is less than the motion since allows the nearest one to have become.
bool PairCycle::hasMissedNearest(const PairSolution& solution) const {
  const double rounding = kPlateauTolerance * stages_.frame().diameters();
  return solution.distance < last_distance_ - stages_.cycle().since_niches.displacement - rounding;
}

// After the limit the answer is incomplete, even with a finished proof. Where the cycle ended before the
// pair's own budget, a proof that is finished is an answer in time.
void PairCycle::reportCompleteness(PairSolution& solution) const {
  const bool is_cut = is_proof_cut_ || limit_.hasRefused();
  const bool all = stages_.hasAllNiches() && !is_cut;
  solution.niches_complete = proves() && stages_.parameters().niches_wanted && all && !solution.niches_cut;
  if (!limit_.hasRefused() || solution.status == SolveStatus::Penetrating) return;
  if (stages_.cycle().ends_first && proves() && !limit_.hasRefusedPairs()) return;
  solution.status = limit_.hasRefusedTime() ? SolveStatus::BudgetExhausted : SolveStatus::MemoryExhausted;
}

void PairCycle::reset() {
  stages_.reset();
  signed_values_.clear();
  last_cycle_.known = last_niches_.known = false;
  was_cut_ = true;
}

void PairCycle::restart() {
  reset();
  stages_.beginIdsAfter(largest_used_id_);
  stages_.cycle().number = 0;
  limit_ = {};
}

void PairCycle::setParameters(const TrackerParameters& parameters) {
  // Node niches and refined ones are not the same places.
  const bool changes_niches = parameters.accuracy != stages_.parameters().accuracy;
  stages_.setParameters(parameters);
  if (changes_niches || (wantsNiches() && !last_niches_.known)) reset();
  stages_.renew();
}

}  // namespace concave_distance
