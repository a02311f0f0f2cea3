#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/scene/cycle_counts.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/tracked_pair.h"

namespace concave_distance {

class CycleSolver;
class NichePreparation;

struct SceneTrackerOptions {
  std::uint32_t threads = 0;                ///< that solve pairs; 0: one per core, 1: only the caller's
  const std::atomic<bool>* stop = nullptr;  ///< set: a cycle ends without solving the pairs that are left
  /// Makes what niches need of the bodies in the background, from setScene() on; until a pair has it, its
  /// cycles at level `certified` give the distance alone. false: the first cycle with niches makes it.
  bool prepares_in_background = false;
};

/// The end of a cycle without one.
inline constexpr WorkLimit::Clock::time_point kNoCycleEnd = WorkLimit::Clock::time_point::max();

/// Tracks every pair of a scene: leaves out what is beyond its cutoff, solves the rest in parallel and
/// compares the distances with the warning distances. One thread at a time.
class SceneTracker {
 public:
  using Pairs = std::vector<std::shared_ptr<TrackedPair>>;
  /// Returns where the pair at this place in scene.pairs is. Called in the order of the pairs, by one thread.
  using Locate = std::function<PairInput(std::size_t)>;

  explicit SceneTracker(SceneTrackerOptions options = {});
  ~SceneTracker();
  SceneTracker(const SceneTracker&) = delete;
  SceneTracker& operator=(const SceneTracker&) = delete;

  /// Pairs whose bodies are in both scenes go on, warm. The order becomes that of scene.pairs. When it
  /// throws, the scene before is still tracked.
  /// @param settings_changed false: no pair of both scenes has other settings, and none is solved anew
  /// @throws Error for a pair whose bodies are not two bodies with meshes of the scene
  void setScene(const Scene& scene, bool settings_changed = true);
  /// Returns for each pair of a scene its place in pairs() if setScene() would let it go on. @throws
  /// Error as setScene()
  std::vector<std::optional<std::size_t>> placesNow(const Scene& scene) const;

  /// One cycle over all enabled pairs. @param world_from_body one pose for each of scene.bodies, each rigid
  /// (rotation orthonormal within 1e-3); empty where it is not known
  /// @param time seconds of these poses, from any beginning
  /// @param demand of each pair
  /// @throws Error for another number of poses than the scene has bodies
  CycleCounts update(const std::vector<std::optional<Eigen::Isometry3d>>& world_from_body, double time,
                     const PairDemand& demand = {true, true, true, false},
                     WorkLimit::Clock::time_point end = kNoCycleEnd);

  /// One cycle. @param demand one per pair, in their order. A pair that is not watched costs nothing and
  /// starts cold when it is watched again; one that is watched but not due keeps its state. What belongs to a
  /// disabled pair is ignored.
  /// @param end of the cycle. First the distance of each pair is proven, then niches and effects are added,
  /// in the order of doc/parameters.md ("A cycle has an end"). What there is no time for is put off
  /// (TrackedPair::put_off): the distance is proven, its status says so, niches_complete is false, and later
  /// cycles go on with the list. Answers then depend on the clock. Without an end, one seed gives one answer.
  /// @throws Error for another number of demands than pairs
  /// After a cycle that threw, all pairs start cold.
  CycleCounts update(const std::vector<PairDemand>& demand, const Locate& locate,
                     WorkLimit::Clock::time_point end = kNoCycleEnd);

  /// Every pair, or the one at this place in scene.pairs, starts cold in its next cycle. @throws Error when
  /// there is no such place
  void restart();
  void restart(std::size_t pair);

  /// Returns the pairs in the order of scene.pairs.
  const Pairs& pairs() const { return pairs_; }
  /// Pairs that left the scene with an alert raised, which setScene took back; reported once.
  Pairs takeRetired();

 private:
  void choosePairs(const std::vector<PairDemand>& demand, const Locate& locate, CycleCounts& counts);
  bool isPrepared(TrackedPair& pair);
  void prepareAhead(const Scene& scene);
  void count(CycleCounts& counts) const;

  SceneTrackerOptions options_;
  std::unique_ptr<CycleSolver> solver_;
  std::unique_ptr<NichePreparation> preparation_;  ///< nullptr: cycles prepare
  Pairs pairs_;
  Pairs retired_;
  std::size_t body_count_ = 0;            ///< of the scene
  std::uint64_t largest_retired_id_ = 0;  ///< of removed pairs
  bool interrupted_ = false;              ///< the last cycle threw, or the running one has not ended
  std::vector<TrackedPair*> to_solve_;
  std::vector<PairDemand> demand_;
};

}  // namespace concave_distance
