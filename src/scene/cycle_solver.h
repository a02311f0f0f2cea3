#pragma once

#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/thread_team.h"
#include "concave_distance/base/work_limit.h"
#include "concave_distance/scene/tracked_pair.h"
#include "solving_order.h"

namespace concave_distance {

/// Solves the pairs of a cycle on threads of its own: each to its end, or all of them until the cycle's.
class CycleSolver {
 public:
  /// @param threads 0: one per core, 1: only the caller's
  /// @param stop set: pairs that are left are not solved; nullptr: none
  CycleSolver(std::uint32_t threads, const std::atomic<bool>* stop);

  /// Makes room for so many pairs.
  void reserve(std::size_t pairs);
  /// Takes the pairs of a cycle, in the order of the scene, and makes what their searches need of the bodies.
  void begin(const std::vector<TrackedPair*>& pairs);
  void solveAll();
  /// Proves the distances first, then adds niches and effects, in the order of urgency. What there is no time
  /// for is put off.
  void solveUntil(WorkLimit::Clock::time_point end);
  /// Returns the processor time of the threads that helped the caller's since begin().
  double helperSeconds() const { return team_.seconds(); }

 private:
  /// A pair in the order of a cycle with an end.
  struct Turn {
    TrackedPair* pair;
    std::size_t place;  ///< in the order of the scene
    PairUrgency urgency;
    double seconds_after;  ///< that the pairs after it are expected to need
  };
  bool isStopped() const { return stop_ != nullptr && *stop_; }
  void solve(TrackedPair& pair);
  template <typename Act>
  void forEach(std::size_t count, const Act& act);
  template <typename Act>
  void forEachInOrder(const Act& act);
  void sortByUrgency();
  /// @param seconds that other threads have for short lists
  void giveThread(double seconds_of_others);

  bool is_serial_;
  const std::atomic<bool>* stop_;
  tbb::task_arena arena_;
  ThreadTeam team_;
  std::vector<TrackedPair*> pairs_;
  std::vector<Turn> turns_;
  std::vector<const BodyMesh*> to_prepare_;
};

}  // namespace concave_distance
