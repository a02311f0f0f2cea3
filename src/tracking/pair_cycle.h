#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "distance_proof.h"
#include "niche_archive.h"
#include "niche_basis.h"
#include "niche_placement.h"
#include "niche_search.h"
#include "round_niches.h"

namespace concave_distance {

/// Runs the cycle of one pair: its stages, in their order, and what goes from one to the next. Each stage
/// keeps what it needs of the last cycle itself.
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
  /// Solves at one pose alone.
  void solve(const Eigen::Isometry3d& pose, PairSolution& solution);
  /// Makes what the first cycle would make otherwise.
  void prepare();
  void reset();
  void restart();
  void setParameters(const TrackerParameters& parameters);

  NicheSearch& search() { return meshes_.search; }
  const std::string& name() const { return name_; }
  const TrackerParameters& parameters() const { return parameters_; }
  std::size_t memoryBytes() const;

 private:
  struct Moment {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    double time = 0.0;
    bool known = false;
  };
  /// Says what has passed since another cycle.
  struct Passed {
    double displacement;  ///< no point of B has moved farther, metres; infinite without a cycle before
    double elapsed;       ///< seconds; 0 where not known
  };
  Passed passed(const Moment& before, const Moment& now) const;

  bool begin(const Eigen::Isometry3d& pose, double time, PairSolution& solution, bool is_tracked);
  void beginSecondHalf(PairSolution& solution);
  void end(PairSolution& solution);
  void findNiches(PairSolution& solution);
  void solveNodes(const Passed& passed, PairSolution& solution);
  void solveExact(const Passed& passed, PairSolution& solution);
  void solveRound(const Passed& passed, PairSolution& solution);
  void chooseBasis();
  void takeCoreParameters();
  void prepare(NicheBasis& basis);
  const PairFrame& basisFrame() const { return basis_ == &meshes_ ? *frame_ : *core_frame_; }
  PairFrame& basisFrame() { return basis_ == &meshes_ ? *frame_ : *core_frame_; }
  const TrackerParameters& basisParameters() const {
    return basis_ == &meshes_ ? parameters_ : core_parameters_;
  }
  WitnessPair provenOnBasis();
  double cutoffOfBasis() const;
  double certainOnBasis() const;
  void prove(PairSolution& solution);
  void propose(SearchCost& cost);
  detail::ConvexNiches countConvexNiches() const;
  bool searchIsDue() const;
  double certainDistance() const;
  void report(PairSolution& solution);
  void reportAlone(PairSolution& solution);
  bool hasMissedNearest(const PairSolution& solution) const;
  void reportCompleteness(PairSolution& solution) const;
  bool proves() const { return provesDistance(parameters_.accuracy); }
  bool isExact() const { return parameters_.accuracy != AccuracyLevel::Nodes; }
  bool isWarm() const { return wantsNiches() ? last_niches_.known : last_cycle_.known; }
  bool wantsNiches() const { return !proves() || parameters_.niches_wanted; }
  /// At the exact levels the solids count, at `nodes` their meshes.
  bool isRound() const { return isExact() && (a_->shape() != nullptr || b_->shape() != nullptr); }
  bool isPairOfShapes() const { return isExact() && a_->shape() != nullptr && b_->shape() != nullptr; }
  /// That are reported.
  std::vector<NicheRecord>& niches() { return isRound() ? round_.records() : meshes_.archive.records(); }

  std::string name_;
  std::shared_ptr<const BodyMesh> a_;
  std::shared_ptr<const BodyMesh> b_;
  std::optional<PairFrame> frame_;  ///< of the present cycle
  TrackerParameters parameters_;
  std::uint64_t largest_used_id_;
  double pose_error_;
  DistanceProof proof_;
  NicheBasis meshes_;
  std::unique_ptr<NicheBasis> cores_;    ///< of a sphere or a capsule and a mesh; nullptr: not needed yet
  NicheBasis* basis_ = &meshes_;         ///< that the niches of the last cycle were found on
  std::optional<PairFrame> core_frame_;  ///< of cores_, in the present cycle
  TrackerParameters core_parameters_;    ///< with the radii of the cores as margins
  RoundNiches round_;                    ///< of the solids, where there are any
  std::vector<TrialPoint> known_;        ///< node pairs, of the cycle
  std::uint64_t cycle_ = 0;
  bool is_tracked_ = true;            ///< of the present cycle
  bool cycle_ends_first_ = false;     ///< before the pair's own time budget
  bool is_proof_cut_ = false;         ///< in the first half of the present cycle
  bool was_cut_ = true;               ///< by the end of a cycle, when it last had time; or it never had
  std::vector<NicheRecord> carried_;  ///< of putOffNiches()
  Moment now_;
  Passed since_cycle_{};   ///< at now_
  Passed since_niches_{};  ///< at now_
  Moment last_cycle_;
  Moment last_niches_;  ///< the last cycle that wanted niches
  double last_distance_ = kNotComputed;
  double distance_before_ = kNotComputed;  ///< the proof's, of the cycle before
  StageClock stage_clock_;
  WorkLimit limit_;  ///< of the present cycle
};

}  // namespace concave_distance
