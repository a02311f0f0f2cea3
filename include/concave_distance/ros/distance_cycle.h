#pragma once

#include <ros/time.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "concave_distance/ros/tracked_pair.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance {

struct CycleOptions {
  std::string reference_frame;
  double stale_after = 1.0;                 ///< s
  std::uint32_t threads = 0;                ///< that solve pairs; 0: one per core, 1: only the caller's
  const std::atomic<bool>* stop = nullptr;  ///< set: a cycle ends without solving the pairs that are left
};

/// What one run did, for the diagnostics.
struct CycleReport {
  std::uint32_t watched = 0;
  std::uint32_t solved = 0;
  std::uint32_t cold = 0;      ///< of the solved, those from nothing
  std::uint32_t repeated = 0;  ///< no newer transforms
  std::uint32_t beyond_cutoff = 0;
  std::uint32_t without_transform = 0;  ///< missing or stale
  std::uint32_t search_misses = 0;
  std::uint32_t unproven = 0;       ///< solves at `certified` that the time budget ended before the proof
  EffectCounts effects;             ///< of all pairs
  double helper_cpu_seconds = 0.0;  ///< processor time of the threads that helped the caller's
};

/// Follows every pair of a scene: looks up transforms, leaves out what is beyond the cutoff, solves the rest
/// in parallel, watches the warning distances. Knows the transforms but no topic. One thread at a time.
class DistanceCycle {
 public:
  DistanceCycle(const TransformBuffer& transforms, CycleOptions options);

  /// Pairs whose bodies are in both scenes go on, warm. The order becomes that of scene.pairs. When it
  /// throws, the scene before is still followed.
  /// @param settings_changed false: no pair of both scenes has other settings, and none is solved anew
  void setScene(const Scene& scene, bool settings_changed = true);
  /// @param demand one per pair, in their order. A pair that is not watched costs nothing and starts cold
  /// when
  ///        it is watched again; one that is watched but not due keeps its state.
  /// After a run that threw, all pairs start cold.
  CycleReport run(const std::vector<PairDemand>& demand, ros::Time now);

  /// Every pair, or the one at this place in scene.pairs, starts cold in its next cycle.
  void restart();
  void restart(std::size_t pair);

  const std::vector<std::unique_ptr<TrackedPair>>& pairs() const { return pairs_; }
  /// Pairs that left the scene with an alert raised, which setScene took back; they are told of once.
  std::vector<std::unique_ptr<TrackedPair>> takeRetired();

 private:
  bool locate(TrackedPair& pair, const tf2::BufferCore& buffer, ros::Time now);
  void stopWatching(TrackedPair& pair);
  std::vector<std::size_t> placesNow(const Scene& scene) const;
  void prepareSearches();
  void solveAll();
  void solve(TrackedPair& pair);

  const TransformBuffer& transforms_;
  CycleOptions options_;
  tbb::task_arena arena_;
  std::vector<std::unique_ptr<TrackedPair>> pairs_;
  std::vector<std::unique_ptr<TrackedPair>> retired_;
  std::uint64_t largest_retired_id_ = 0;  ///< of removed pairs
  bool interrupted_ = false;              ///< the last run threw, or the running one has not ended
  std::vector<TrackedPair*> to_solve_;
  std::vector<const BodyMesh*> to_prepare_;
  std::atomic<std::int64_t> helper_cpu_nanoseconds_{0};
};

}  // namespace concave_distance
