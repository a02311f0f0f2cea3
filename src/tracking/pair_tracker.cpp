#include "concave_distance/tracking/pair_tracker.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <optional>
#include <utility>

#include "concave_distance/base/error.h"
#include "pair_cycle.h"
#include "recentred_pair.h"
#include "require_bodies.h"

namespace concave_distance {
namespace {

// So many that making a tracker does not count.
constexpr std::size_t kPosesOfOneTracker = 16;

}  // namespace

struct PairTracker::State {
  State(std::string name, const std::shared_ptr<const BodyMesh>& a, const std::shared_ptr<const BodyMesh>& b,
        const TrackerParameters& parameters, std::uint64_t largest_used_id)
      : bodies(a, b),
        cycle(std::move(name), bodies.a(), bodies.b(), parameters, largest_used_id, bodies.poseError()) {}

  /// Calls solve(pose) with the pose of the bodies as they are solved.
  template <typename Solve>
  void solveRecentred(const Eigen::Isometry3d& a_from_b, PairSolution& solution, const Solve& solve) const {
    const std::optional<Eigen::Isometry3d> pose = bodies.isMoved() ? bodies.poseOf(a_from_b) : std::nullopt;
    solve(pose ? *pose : a_from_b);
    if (pose) bodies.moveBack(a_from_b, solution);
  }

  /// Moves a solution whose pose is known to be rigid.
  void moveBack(PairSolution& solution) const {
    if (bodies.isMoved()) bodies.moveBack(Eigen::Isometry3d(solution.a_from_b), solution);
  }

  RecentredPair bodies;
  PairCycle cycle;
};

// Users build on this signature. NOLINTBEGIN(performance-unnecessary-value-param)
PairTracker::PairTracker(std::string name, std::shared_ptr<const BodyMesh> a,
                         std::shared_ptr<const BodyMesh> b, const TrackerParameters& parameters,
                         std::uint64_t largest_used_id) {
  requireBodies(name, a, b);
  state_ = std::make_unique<State>(std::move(name), a, b, parameters, largest_used_id);
}
// NOLINTEND(performance-unnecessary-value-param)
PairTracker::~PairTracker() = default;
PairTracker::PairTracker(PairTracker&&) noexcept = default;
PairTracker& PairTracker::operator=(PairTracker&&) noexcept = default;

PairTracker::State& PairTracker::state() const {
  if (state_ == nullptr) throw Error("PairTracker", "it was moved from", "use the one that it was moved to");
  return *state_;
}

void PairTracker::update(const Eigen::Isometry3d& a_from_b, double time, PairSolution& solution) {
  State& state = this->state();
  state.solveRecentred(a_from_b, solution,
                       [&](const Eigen::Isometry3d& pose) { state.cycle.update(pose, time, solution); });
}

bool PairTracker::prove(const Eigen::Isometry3d& a_from_b, double time, PairSolution& solution,
                        WorkLimit::Clock::time_point cycle_end) {
  State& state = this->state();
  bool is_to_go_on = false;
  state.solveRecentred(a_from_b, solution, [&](const Eigen::Isometry3d& pose) {
    is_to_go_on = state.cycle.prove(pose, time, solution, cycle_end);
  });
  return is_to_go_on;
}

bool PairTracker::addNiches(PairSolution& solution, WorkLimit::Clock::time_point cycle_end) {
  State& state = this->state();
  const bool is_done = state.cycle.addNiches(solution, cycle_end);
  state.moveBack(solution);
  return is_done;
}

void PairTracker::putOffNiches(PairSolution& solution) {
  State& state = this->state();
  state.cycle.putOffNiches(solution);
  state.moveBack(solution);
}

void PairTracker::solve(const Eigen::Isometry3d& a_from_b, PairSolution& solution) {
  State& state = this->state();
  state.solveRecentred(a_from_b, solution,
                       [&](const Eigen::Isometry3d& pose) { state.cycle.solve(pose, solution); });
}

void PairTracker::prepare(const std::vector<Eigen::Isometry3d>& a_from_b) {
  state().cycle.prepare();
  PairSolution solution;
  double time = 0.0;
  for (const Eigen::Isometry3d& pose : a_from_b) update(pose, time += 1.0, solution);
  restart();
}

void PairTracker::reset() {
  state().cycle.reset();
}

void PairTracker::restart() {
  state().cycle.restart();
}

void PairTracker::holdSearch(bool is_held) {
  state().cycle.holdSearch(is_held);
}

void PairTracker::setParameters(const TrackerParameters& parameters) {
  state().cycle.setParameters(parameters);
}

std::size_t PairTracker::memoryBytes() const {
  return state().cycle.memoryBytes();
}

const TrackerParameters& PairTracker::parameters() const {
  return state().cycle.parameters();
}

PairSolution solveOnce(const std::string& name, const std::shared_ptr<const BodyMesh>& a,
                       const std::shared_ptr<const BodyMesh>& b, const TrackerParameters& parameters,
                       const Eigen::Isometry3d& a_from_b) {
  PairTracker tracker(name, a, b, parameters);
  PairSolution solution;
  tracker.solve(a_from_b, solution);
  return solution;
}

std::vector<PairSolution> solveEach(const std::string& name, const std::shared_ptr<const BodyMesh>& a,
                                    const std::shared_ptr<const BodyMesh>& b,
                                    const TrackerParameters& parameters,
                                    const std::vector<Eigen::Isometry3d>& a_from_b, std::uint32_t threads) {
  std::vector<PairSolution> solutions(a_from_b.size());
  // The bodies make their parts on demand: first here, because threads would wait for them.
  PairTracker(name, a, b, parameters).prepare();
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, a_from_b.size(), kPosesOfOneTracker),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        PairTracker tracker(name, a, b, parameters);
                        for (std::size_t i = range.begin(); i != range.end(); ++i) {
                          tracker.solve(a_from_b[i], solutions[i]);
                        }
                      });
  });
  return solutions;
}

}  // namespace concave_distance
