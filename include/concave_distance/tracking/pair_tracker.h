#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance {

/// One pair of bodies over time: each cycle is warm-started from the niches of the last one (Carretero, sec.
/// 6.2.2), every niche is re-descended, refined and matched to its persistent id. Not thread-safe; different
/// trackers may run in parallel. Once buffers have grown, a cycle without prominences allocates nothing.
class PairTracker {
 public:
  /// @param name keys the random streams, with the seed and the cycle
  /// @param largest_used_id niche ids are greater than this
  /// @throws Error for a body that is null, for parameters out of range
  PairTracker(std::string name, std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
              const TrackerParameters& parameters, std::uint64_t largest_used_id = 0);
  ~PairTracker();
  /// The other one may only be destroyed or assigned to; anything else throws Error.
  PairTracker(PairTracker&&) noexcept;
  PairTracker& operator=(PairTracker&&) noexcept;

  /// Solves at one pose. @param a_from_b rigid, rotation orthonormal within 1e-3, else status InvalidPose
  /// @param time seconds of the transforms, for velocities; a time not after the last one gives no velocity
  /// `solution` keeps its capacity.
  void update(const Eigen::Isometry3d& a_from_b, double time, PairSolution& solution);
  /// The halves of update(), for a caller whose cycle has an end: prove(), and when it returns true either
  /// addNiches() or putOffNiches(), with the same solution, before anything else.
  /// Gives the distance with its proof, at levels that prove it; until `cycle_end` or its share of the time
  /// budget. @return true when niches are to be added
  bool prove(const Eigen::Isometry3d& a_from_b, double time, PairSolution& solution,
             WorkLimit::Clock::time_point cycle_end);
  /// Adds the niches. Where the cycle ends first, the list is incomplete, the status is that of the proof,
  /// and the next cycle goes on with what was found. @return false then
  bool addNiches(PairSolution& solution, WorkLimit::Clock::time_point cycle_end);
  /// Adds known niches where their points are now, on the bodies: not minima, and none is missed or judged.
  /// Costs about 0.2 us a niche. At levels that prove nothing it is addNiches() without time.
  void putOffNiches(PairSolution& solution);
  /// Solves at one pose alone: the answer of the first update() after restart() (but for `cost` and the
  /// niches' origins), sooner, because nothing is kept for a next pose. Ends what was tracked.
  void solve(const Eigen::Isometry3d& a_from_b, PairSolution& solution);

  /// Before a loop in real time: makes what the parameters need of the bodies (grids, metrics, normal cones),
  /// which the first solve would, and lets buffers grow by solving these poses. Then starts anew.
  void prepare(const std::vector<Eigen::Isometry3d>& a_from_b = {});

  /// Forgets all niches: the next cycle is cold. Ids go on counting.
  void reset();
  /// As if newly made, but buffers are kept: the next cycles give what those of a new tracker would.
  void restart();

  /// While it is held, cycles at level `certified` do without the search, whose grids somebody else makes.
  void holdSearch(bool is_held);
  /// Takes effect at the next cycle. @throws Error for parameters out of range
  void setParameters(const TrackerParameters& parameters);
  [[nodiscard]] const TrackerParameters& parameters() const;

 private:
  struct State;
  [[nodiscard]] State& state() const;
  std::unique_ptr<State> state_;
};

/// A cold, independent solve: PairTracker::solve() of a new tracker with that name. For many
/// poses solveEach() is faster.
/// @throws Error as PairTracker
[[nodiscard]] PairSolution solveOnce(const std::string& name, const std::shared_ptr<const BodyMesh>& a,
                                     const std::shared_ptr<const BodyMesh>& b,
                                     const TrackerParameters& parameters, const Eigen::Isometry3d& a_from_b);

/// The same at each of these poses, in parallel: the answers of solveOnce(), in the order of the poses.
/// @param threads 0: one per core
/// @throws Error as PairTracker
[[nodiscard]] std::vector<PairSolution> solveEach(const std::string& name,
                                                  const std::shared_ptr<const BodyMesh>& a,
                                                  const std::shared_ptr<const BodyMesh>& b,
                                                  const TrackerParameters& parameters,
                                                  const std::vector<Eigen::Isometry3d>& a_from_b,
                                                  std::uint32_t threads = 0);

}  // namespace concave_distance
