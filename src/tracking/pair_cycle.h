#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "pair_stages.h"
#include "signed_values.h"

namespace concave_distance {

/// Runs the cycle of one pair, whole or in two halves: its limits, its stages and its answer.
class PairCycle {
 public:
  /// @param pose_error metres, how far the poses may be off (RecentredPair::poseError())
  PairCycle(std::string name, std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
            const TrackerParameters& parameters, std::uint64_t largest_used_id, double pose_error);

  /// @param is_tracked a next cycle uses what this one finds
  void update(const Eigen::Isometry3d& pose, double time, PairSolution& solution, bool is_tracked = true);
  /// Implement the functions of PairTracker with these names.
  bool prove(const Eigen::Isometry3d& pose, double time, PairSolution& solution,
             WorkLimit::Clock::time_point cycle_end);
  bool addNiches(PairSolution& solution, WorkLimit::Clock::time_point cycle_end);
  void putOffNiches(PairSolution& solution);
  /// Answers after std::bad_alloc: by the proof, where that is made, or by a vertex of each body. Nothing
  /// else may be asked for afterwards but what a new cycle goes on with.
  void endWithoutMemory(PairSolution& solution) const;
  std::uint64_t number() const { return stages_.cycle().number; }
  std::uint64_t takeId() { return stages_.takeId(); }
  /// Goes on after a cycle that has ended so.
  void goOn(std::uint64_t number, std::uint64_t largest_used_id) {
    stages_.cycle().number = number;
    stages_.beginIdsAfter(largest_used_id);
  }
  /// Solves at one pose alone.
  void solve(const Eigen::Isometry3d& pose, PairSolution& solution);
  /// Makes what the first cycle would make otherwise.
  void prepare() { stages_.prepare(); }
  void reset();
  void restart();
  void holdSearch(bool is_held) { stages_.holdSearch(is_held); }
  void setParameters(const TrackerParameters& parameters);

  const std::string& name() const { return stages_.name(); }
  const TrackerParameters& parameters() const { return stages_.parameters(); }

 private:
  struct Moment {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    double time = 0.0;
    bool known = false;
  };
  PairStages::Passed passed(const Moment& before, const Moment& now) const;

  bool begin(const Eigen::Isometry3d& pose, double time, PairSolution& solution, bool is_tracked);
  void beginSecondHalf(PairSolution& solution);
  void end(PairSolution& solution);
  void prove(PairSolution& solution);
  void report(PairSolution& solution);
  void reportAlone(PairSolution& solution) const;
  bool hasMissedNearest(const PairSolution& solution) const;
  void reportCompleteness(PairSolution& solution) const;
  bool proves() const { return stages_.proves(); }
  bool isWarm() const { return wantsNiches() ? last_niches_.known : last_cycle_.known; }
  bool wantsNiches() const { return stages_.wantsNiches(); }

  PairStages stages_;
  std::uint64_t largest_used_id_;
  bool is_proof_made_ = false;        ///< in the present cycle
  bool is_proof_cut_ = false;         ///< likewise, in its first half
  bool was_cut_ = true;               ///< by the end of a cycle, when it last had time; or it never had
  std::vector<NicheRecord> carried_;  ///< of putOffNiches()
  Moment now_;
  Moment last_cycle_;
  Moment last_niches_;  ///< the last cycle that wanted niches
  double last_distance_ = kNotComputed;
  SignedValues signed_values_;
  WorkLimit limit_;  ///< of the present cycle
};

}  // namespace concave_distance
