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

/// Runs the stages that find the distance and the niches of one pair, in their order, and what goes from one
/// to the next. Each stage keeps what it needs of the last cycle itself.
class PairStages {
 public:
  /// Says what has passed since another cycle.
  struct Passed {
    double displacement;  ///< no point of B has moved farther, metres; infinite without a cycle before
    double elapsed;       ///< seconds; 0 where not known
  };
  /// Says of a cycle what its stages go by.
  struct Cycle {
    std::uint64_t number = 0;
    bool is_tracked = true;  ///< a next cycle uses what this one finds
    bool is_first = true;
    bool is_warm = false;
    bool ends_first = false;  ///< before the pair's own time budget
    Passed since_last{};
    Passed since_niches{};               ///< since the last cycle that wanted niches
    Eigen::Isometry3d last_niches_pose;  ///< of that one
  };

  /// @param pose_error metres, how far the poses may be off (RecentredPair::poseError())
  PairStages(std::string name, std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
             const TrackerParameters& parameters, double pose_error);

  /// Begins a cycle. @param pose rigid
  void begin(const Eigen::Isometry3d& pose);
  Cycle& cycle() { return cycle_; }
  const Cycle& cycle() const { return cycle_; }
  StageClock& clock() { return clock_; }

  /// At `certified` the search waits while it is held.
  void holdSearch(bool is_held) { is_search_held_ = is_held; }

  void prove(PairSolution& solution, WorkLimit& limit);
  void findNiches(PairSolution& solution, WorkLimit& limit);
  /// Makes what the first cycle would make otherwise.
  void prepare();

  void reset();
  void beginIdsAfter(std::uint64_t id);
  /// Returns an id that no niche has had.
  std::uint64_t takeId() { return std::max(meshes_.archive.takeId(), round_.takeId()); }
  /// @throws Error for parameters out of range, and then keeps those before
  void setParameters(const TrackerParameters& parameters);
  /// Makes the next cycle go by the parameters even where the pair has not moved.
  void renew();

  const std::string& name() const { return name_; }
  const BodyMesh& a() const { return *a_; }
  const BodyMesh& b() const { return *b_; }
  const TrackerParameters& parameters() const { return parameters_; }
  const PairFrame& frame() const { return *frame_; }
  const DistanceProof& proof() const { return proof_; }
  DistanceProof& proof() { return proof_; }
  /// Returns the niches that are reported.
  std::vector<NicheRecord>& records() { return isRound() ? round_.records() : meshes_.archive.records(); }
  /// Returns the nearest of all minima at a level that proves nothing, or nullptr.
  const MinimumCandidate* nearestProposed() const {
    return isExact() ? basis_->niches.nearestProposed() : nullptr;
  }
  bool hasAllNiches() const { return basis_->niches.isFinished() || isPairOfShapes(); }
  bool proves() const { return provesDistance(parameters_.accuracy); }
  bool isExact() const { return parameters_.accuracy != AccuracyLevel::Nodes; }
  bool wantsNiches() const { return !proves() || parameters_.niches_wanted; }
  /// At the exact levels the solids count, at `nodes` their meshes.
  bool isRound() const { return isExact() && (a_->shape() != nullptr || b_->shape() != nullptr); }
  bool isPairOfShapes() const { return isExact() && a_->shape() != nullptr && b_->shape() != nullptr; }
  /// Returns the proven distance of the cycle before; NaN: there is none.
  double distanceBefore() const { return distance_before_; }

 private:
  void solveNodes(const Passed& passed, PairSolution& solution, WorkLimit& limit);
  void solveExact(const Passed& passed, PairSolution& solution, WorkLimit& limit);
  void solveRound(const Passed& passed, PairSolution& solution, WorkLimit& limit);
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
  void propose(SearchCost& cost, WorkLimit& limit);
  detail::ConvexNiches countConvexNiches() const;
  bool mayHelp() const { return parameters_.search_share > 0.0 && !is_search_held_; }
  bool searchIsDue(const WorkLimit& limit) const;
  double certainDistance() const;

  std::string name_;
  std::shared_ptr<const BodyMesh> a_;
  std::shared_ptr<const BodyMesh> b_;
  TrackerParameters parameters_;
  double pose_error_;
  Cycle cycle_;
  bool is_search_held_ = false;
  std::optional<PairFrame> frame_;  ///< of the present cycle
  DistanceProof proof_;
  NicheBasis meshes_;
  std::unique_ptr<NicheBasis> cores_;    ///< of a sphere or a capsule and a mesh; nullptr: not needed yet
  NicheBasis* basis_ = &meshes_;         ///< that the niches of the last cycle were found on
  std::optional<PairFrame> core_frame_;  ///< of cores_, in the present cycle
  TrackerParameters core_parameters_;    ///< with the radii of the cores as margins
  RoundNiches round_;                    ///< of the solids, where there are any
  std::vector<TrialPoint> known_;        ///< node pairs, of the cycle
  double distance_before_ = kNotComputed;
  StageClock clock_;
};

}  // namespace concave_distance
