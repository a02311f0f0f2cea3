#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/scene/cycle_counts.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/tracked_pair.h"

namespace concave_distance {

class CycleSolver;
class NearPairs;
class NichePreparation;

struct SceneTrackerOptions {
  std::uint32_t threads = 0;                ///< that solve pairs; 0: one per core, 1: only the caller's
  const std::atomic<bool>* stop = nullptr;  ///< set: a cycle ends without solving the pairs that are left
  /// Makes what niches need of the bodies in the background, from setScene() on; until a pair has it, its
  /// cycles at level `certified` give the distance alone. false: the first cycle with niches makes it.
  bool prepares_in_background = false;
};

/// Says how SceneTracker::prepare() works.
struct PreparationSettings {
  std::uint32_t threads = 0;  ///< that make parts of the bodies; 0: one per core
  /// Seconds; what has been begun by then is finished, some 0.1 s for a body of 10,000 triangles.
  double time_limit = std::numeric_limits<double>::infinity();
  /// Called after each piece of work, by one thread at a time; empty: nobody.
  std::function<void(std::size_t done, std::size_t count)> progress;
};

/// Counts what SceneTracker::prepare() has looked at and left.
struct PreparationCounts {
  std::size_t bodies = 0;      ///< meshes that it looked at
  std::size_t left = 0;        ///< of these the ones that there was no time for
  std::size_t lists_left = 0;  ///< pairs whose niches there was no time for

  bool isComplete() const { return left == 0 && lists_left == 0; }
};

/// The end of a cycle without one.
inline constexpr WorkLimit::Clock::time_point kNoCycleEnd = WorkLimit::Clock::time_point::max();

/// Tracks a scene: finds the pairs that are near each other by the poses of the bodies, solves them in
/// parallel and compares the distances with the warning distances. Pairs that the scene lists are tracked
/// at any distance, those that its rules give while they can be within their cutoff or warning distance. One
/// thread at a time.
class SceneTracker {
 public:
  using Pairs = std::vector<std::shared_ptr<TrackedPair>>;
  /// World poses of the bodies of a scene, in their order; empty where one is not known.
  using Poses = std::vector<std::optional<Eigen::Isometry3d>>;
  /// Returns where two bodies of the scene are together, both at one time. Called once for each pair that is
  /// due, in the order of pairs(), by one thread.
  using Locate = std::function<PairInput(std::size_t body_a, std::size_t body_b)>;
  /// Returns what is wanted of the enabled pair at this place in pairs(). Called likewise.
  using DemandOf = std::function<PairDemand(std::size_t, const TrackedPair&)>;

  explicit SceneTracker(SceneTrackerOptions options = {});
  ~SceneTracker();
  SceneTracker(const SceneTracker&) = delete;
  SceneTracker& operator=(const SceneTracker&) = delete;

  /// Pairs whose bodies are in both scenes go on, warm: a body is the same while its serial and its mesh are.
  /// When it throws, the scene before is still tracked.
  /// @param settings_changed false: no pair of both scenes has other settings, and none is solved anew
  /// @throws Error for a body without a mesh, and a listed pair whose bodies are not two of the scene
  void setScene(const Scene& scene, bool settings_changed = true);
  /// Returns for each listed pair of a scene its place in pairs() if setScene() would let it go on. @throws
  /// Error as setScene()
  std::vector<std::optional<std::size_t>> placesNow(const Scene& scene) const;

  /// Before a loop in real time: an update() near these poses then takes what a warm one takes. Makes what
  /// niches need of the bodies of pairs(), and of all that rules watch, where it is missing, so that after an
  /// edit of the scene it makes that of new bodies: normal cones (0.5 kB a triangle), grids and metrics of
  /// the search (SceneLoadOptions::metric_memory_limit bounds the largest part). Then solves each pair at
  /// these poses, cold and moved to and fro by a millionth of its size, so that buffers grow and niches have
  /// their ids; a pair whose last answer is of these poses is left as it is. pairs() has the answers.
  /// Warnings are compared from the next update() on. What contact needs, or a pair that is far away, is
  /// made when it comes to that: call it for such poses too, with the first ones of the loop last.
  /// @param time of these poses, seconds, before that of the next update() @param demand of cycles to come
  /// @throws Error as update()
  PreparationCounts prepare(const Poses& world_from_body, double time,
                            const PairDemand& demand = {true, true, true, false},
                            const PreparationSettings& settings = {});

  /// One cycle. @param world_from_body each body at its newest pose, rigid (rotation orthonormal within
  /// 1e-3), perhaps of another time than the others: by these pairs come near @param now seconds, from the
  /// beginning that PairInput::time has @param locate where each pair is solved
  /// @param demand_of A pair that is not watched costs nothing and starts cold when it is watched again; one
  /// that is watched but not due keeps its state.
  /// @param end of the cycle. First the distance of each pair is proven, then niches and effects are added,
  /// in the order of doc/parameters.md ("A cycle has an end"). What there is no time for is put off
  /// (TrackedPair::put_off): the distance is proven, its status says so, niches_complete is false, and later
  /// cycles go on with the list. Answers then depend on the clock. Without an end, one seed gives one answer.
  /// A warm cycle in which no pair comes near or leaves allocates nothing.
  /// @throws Error for another number of poses than the scene has bodies
  /// After a cycle that threw, all pairs start cold.
  CycleCounts update(const Poses& world_from_body, double now, const DemandOf& demand_of,
                     const Locate& locate, WorkLimit::Clock::time_point end = kNoCycleEnd);

  /// One cycle at poses of one time, with the same demand of all enabled pairs or one for each.
  /// @param time seconds, from any beginning @throws Error as above
  CycleCounts update(const Poses& world_from_body, double time,
                     const PairDemand& demand = {true, true, true, false},
                     WorkLimit::Clock::time_point end = kNoCycleEnd);
  CycleCounts update(const Poses& world_from_body, double time, const DemandOf& demand_of,
                     WorkLimit::Clock::time_point end = kNoCycleEnd);

  /// Every pair, or the one at this place in pairs(), starts cold in its next cycle. @throws Error when there
  /// is no such place
  void restart();
  void restart(std::size_t pair);

  /// Returns the listed pairs in the order of scene.pairs, then those by rule that the last cycle found near.
  /// One that has left is there for one more cycle.
  const Pairs& pairs() const { return pairs_; }
  std::size_t listedCount() const { return listed_; }
  /// Counts the pairs by rule that pairs() does not have, after the last cycle.
  const OtherPairs& others() const;
  /// Pairs that left the scene with an alert raised, which setScene took back; reported once.
  Pairs takeRetired();

 private:
  void begin();
  void refreshPairs();
  void findNear(const Poses& world_from_body, double now);
  CycleCounts runCycle(CycleSolver& solver, const DemandOf& demand_of, const Locate& locate,
                       WorkLimit::Clock::time_point end, bool watches_warnings = true);
  bool prepareBodies(const PairDemand& demand, const PreparationSettings& settings,
                     WorkLimit::Clock::time_point end, PreparationCounts& counts);
  void runPreparingCycles(const Locate& locate, const PairDemand& demand, const PreparationSettings& settings,
                          WorkLimit::Clock::time_point end, PreparationCounts& counts);
  void count(CycleCounts& counts) const;

  SceneTrackerOptions options_;
  std::unique_ptr<CycleSolver> solver_;
  std::unique_ptr<NichePreparation> preparation_;  ///< nullptr: cycles prepare
  std::unique_ptr<NearPairs> near_;
  std::uint64_t near_revision_ = 0;  ///< that pairs_ has
  Pairs pairs_;
  std::size_t listed_ = 0;  ///< the first of pairs_
  Pairs retired_;
  std::size_t body_count_ = 0;            ///< of the scene
  std::uint64_t largest_retired_id_ = 0;  ///< of removed pairs
  bool interrupted_ = false;              ///< the last cycle threw, or the running one has not ended
  std::vector<TrackedPair*> to_solve_;
};

}  // namespace concave_distance
