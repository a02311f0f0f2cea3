#include "concave_distance/tracking/pair_tracker.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <new>
#include <optional>
#include <utility>

#include "concave_distance/base/error.h"
#include "padded_solution.h"
#include "pair_answer.h"
#include "pair_cycle.h"
#include "recentred_pair.h"
#include "require_bodies.h"

namespace concave_distance {
namespace {

// So many that making a tracker does not count.
constexpr std::size_t kPosesOfOneTracker = 16;

}  // namespace

struct PairTracker::State {
  State(std::string of, const std::shared_ptr<const BodyMesh>& a, const std::shared_ptr<const BodyMesh>& b,
        const TrackerParameters& parameters, std::uint64_t largest_id)
      : name(std::move(of)),
        bodies(a, b),
        kept(parameters),
        largest_used_id(largest_id),
        last_id(largest_id) {
    current();
  }

  /// Returns the cycle; where the last one has run out of memory, a new one that goes on after it.
  PairCycle& current() {
    if (!cycle) {
      cycle.emplace(name, bodies.a(), bodies.b(), kept, largest_used_id, bodies.poseError());
      cycle->goOn(number, last_id);
    }
    return *cycle;
  }

  /// Calls solve(), and ends what runs out of memory in it: what it leaves may be half made, and is freed.
  /// @param pose of the bodies as they are solved
  template <typename Solve>
  void solveWithin(const Eigen::Isometry3d& pose, PairSolution& solution, const Solve& solve) {
    try {
      solve(current());
    } catch (const std::bad_alloc&) {
      if (cycle) {
        cycle->endWithoutMemory(solution);
        kept = cycle->parameters();
        number = cycle->number() + 1;
        last_id = cycle->takeId();
        cycle.reset();
      } else {
        clearAnswer(kept, number, false, solution);
        solution.a_from_b = pose;
        answerByVertices(kept, *bodies.a(), *bodies.b(), pose, solution);
        solution.status = SolveStatus::MemoryExhausted;
        padSolution(kept, solution);
      }
    }
  }

  /// Calls solve(cycle, pose) with the pose of the bodies as they are solved.
  template <typename Solve>
  void solveRecentred(const Eigen::Isometry3d& a_from_b, PairSolution& solution, const Solve& solve) {
    const std::optional<Eigen::Isometry3d> moved = bodies.isMoved() ? bodies.poseOf(a_from_b) : std::nullopt;
    const Eigen::Isometry3d& pose = moved ? *moved : a_from_b;
    solveWithin(pose, solution, [&](PairCycle& now) { solve(now, pose); });
    if (moved) bodies.moveBack(a_from_b, solution);
  }

  /// Goes on with a solution whose pose is known to be rigid.
  template <typename Solve>
  void solveOn(PairSolution& solution, const Solve& solve) {
    solveWithin(solution.a_from_b, solution, solve);
    if (bodies.isMoved()) bodies.moveBack(Eigen::Isometry3d(solution.a_from_b), solution);
  }

  std::string name;
  RecentredPair bodies;
  TrackerParameters kept;         ///< while there is no cycle
  std::uint64_t largest_used_id;  ///< before the first cycle
  std::uint64_t last_id;          ///< before the next cycle that is made
  std::uint64_t number = 0;       ///< of that one
  std::optional<PairCycle> cycle;
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
  state().solveRecentred(a_from_b, solution, [&](PairCycle& cycle, const Eigen::Isometry3d& pose) {
    cycle.update(pose, time, solution);
  });
}

bool PairTracker::prove(const Eigen::Isometry3d& a_from_b, double time, PairSolution& solution,
                        WorkLimit::Clock::time_point cycle_end) {
  bool is_to_go_on = false;
  state().solveRecentred(a_from_b, solution, [&](PairCycle& cycle, const Eigen::Isometry3d& pose) {
    is_to_go_on = cycle.prove(pose, time, solution, cycle_end);
  });
  return is_to_go_on;
}

bool PairTracker::addNiches(PairSolution& solution, WorkLimit::Clock::time_point cycle_end) {
  bool is_done = true;
  state().solveOn(solution, [&](PairCycle& cycle) { is_done = cycle.addNiches(solution, cycle_end); });
  return is_done;
}

void PairTracker::putOffNiches(PairSolution& solution) {
  state().solveOn(solution, [&](PairCycle& cycle) { cycle.putOffNiches(solution); });
}

void PairTracker::solve(const Eigen::Isometry3d& a_from_b, PairSolution& solution) {
  state().solveRecentred(a_from_b, solution, [&](PairCycle& cycle, const Eigen::Isometry3d& pose) {
    cycle.solve(pose, solution);
  });
}

void PairTracker::prepare(const std::vector<Eigen::Isometry3d>& a_from_b) {
  state().current().prepare();
  PairSolution solution;
  double time = 0.0;
  for (const Eigen::Isometry3d& pose : a_from_b) update(pose, time += 1.0, solution);
  restart();
}

void PairTracker::reset() {
  state().current().reset();
}

void PairTracker::restart() {
  state().current().restart();
}

void PairTracker::holdSearch(bool is_held) {
  state().current().holdSearch(is_held);
}

void PairTracker::setParameters(const TrackerParameters& parameters) {
  state().current().setParameters(parameters);
}

const TrackerParameters& PairTracker::parameters() const {
  return state().cycle ? state().cycle->parameters() : state().kept;
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
