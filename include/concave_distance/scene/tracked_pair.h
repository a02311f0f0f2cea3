#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/tracked_effects.h"
#include "concave_distance/scene/warning_monitor.h"
#include "concave_distance/tracking/pair_tracker.h"

namespace concave_distance {

class PreparationTask;

/// Says what is wanted of a pair in one cycle.
struct PairDemand {
  bool watched = false;  ///< somebody follows the pair; otherwise it costs nothing and starts cold later
  bool due = false;      ///< an answer is wanted in this cycle
  bool niches = false;   ///< with the niches
  bool effects = false;  ///< with the effects that its settings ask for
  /// Its niches are found after those of all other pairs, in what a cycle with an end has left.
  bool niches_last = false;
};

/// Says where B is, seen from A.
struct PairInput {
  bool located = true;  ///< false: the poses are not known, and the pair has no answer
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  double time = 0.0;   ///< seconds, from any beginning
  bool fixed = false;  ///< the bodies never move against each other, whatever the time
  /// Seconds since the last input, where `time` is not precise enough; empty: the difference of the times.
  std::optional<double> step;
  /// Velocity of B relative to A, for the effects; empty: from consecutive poses.
  std::optional<RelativeTwist> b_in_a;
};

enum class PairState : std::uint8_t {
  NotWatched,    ///< nothing was computed
  NotLocated,    ///< its poses are not known
  BeyondCutoff,  ///< boxes and spheres around the bodies prove it (`box_bound`)
  Solved,        ///< `solution` is of the last input
  Stopped        ///< the work was stopped before its turn
};

/// One pair of a scene while it is tracked: its tracker and effects, made when it is first watched, and its
/// last answer. Not thread-safe; pairs run in parallel.
struct TrackedPair {
  /// @param index of the pair in the scene
  /// @param first_id niche ids are greater than this
  TrackedPair(const Scene& scene, std::size_t index, std::uint64_t first_id);
  /// @param pair not listed perhaps, of these two bodies
  TrackedPair(std::shared_ptr<const ScenePair> pair, std::shared_ptr<const SceneBody> a,
              std::shared_ptr<const SceneBody> b, std::uint64_t first_id);

  std::shared_ptr<const ScenePair> origin;  ///< the scene pair that it was last set up from
  /// Bodies of the scene. One that is removed and added again is another, with settings of its own.
  std::shared_ptr<const SceneBody> body_a;
  std::shared_ptr<const SceneBody> body_b;
  PairSettings settings;            ///< with the margins of the bodies
  PairInput input;                  ///< the last one
  std::optional<double> box_bound;  ///< metres, with BeyondCutoff
  PairSolution solution;            ///< with Solved; otherwise NaN and empty, as not computed
  TrackedEffects effects;
  WarningMonitor warning;
  PairDemand demand;
  PairState state = PairState::NotWatched;
  bool repeated = false;         ///< the input is that of the last answer, which stands: nothing was computed
  bool warning_changed = false;  ///< in this cycle
  bool put_off = false;          ///< the end of the cycle has left niches or effects of the answer unfinished
  std::uint64_t largest_id = 0;  ///< of a niche reported so far
  std::uint32_t cycles_put_off = 0;  ///< in a row, since the list was finished or had most of a cycle's time
  std::uint32_t cycles_unfinished = 0;  ///< in a row, since the list was finished
  double seconds_to_finish = 0.0;       ///< that finish() is expected to take, by what it last took
  /// Makes what its bodies need for these settings, in the background or in SceneTracker::prepare(); nullptr:
  /// not begun.
  std::shared_ptr<PreparationTask> preparation;

  bool solved() const { return state == PairState::Solved; }

  /// Takes the input and decides, by the bodies' bounds, whether it can be within the cutoff. A pair that
  /// comes back from beyond it within two seconds goes on warm.
  /// @param stop flag that ends solves early; nullptr: none
  /// @return true when solve() has to be called
  bool locate(const PairInput& next, const std::atomic<bool>* stop);
  /// Distance, niches and effects at the input.
  void solve();
  /// The halves of solve() in a cycle with an end: the proven distance, then, for every pair of which that is
  /// done, the rest, with what there is time for.
  void prove(WorkLimit::Clock::time_point cycle_end);
  /// @param end when this pair has to be done; where that is past, niches are put off
  void finish(WorkLimit::Clock::time_point end);
  /// Compares the answer with the warning distance.
  void watchWarning();
  /// A grid and metric will be needed that the bodies may not have yet.
  bool needsSearch() const;

  /// Ends a cycle without an answer; the niches are kept for the next one.
  void stop();
  /// Forgets the niches; ids go on.
  void restart();
  /// The same when it is no longer watched; an alert that is raised is taken back.
  void stopWatching();
  /// The same after an exception: tracker and effects may be half changed and are made
  /// anew. Allocates nothing.
  void discard();
  /// Other settings from the next cycle on, of the same two bodies.
  /// @param settings_changed false: they are known to be the same
  void adopt(std::shared_ptr<const ScenePair> pair, std::shared_ptr<const SceneBody> a,
             std::shared_ptr<const SceneBody> b, bool settings_changed);

  const PairTracker* tracker() const { return tracker_.get(); }

 private:
  bool isSearchHeld() const;
  void takeSettings();
  void stayBeyond(double bound);
  void prepare(const std::atomic<bool>* stop);
  void updateEffects(WorkLimit limit);
  void endSolve();
  void endWithoutAnswer(PairState now);

  std::unique_ptr<PairTracker> tracker_;  ///< made when the pair is first watched
  PairInput solved_input_;
  std::optional<double> beyond_since_;  ///< time at which it went beyond its cutoff with niches
  bool stale_parameters_ = false;       ///< the tracker has to be given the settings again
  bool must_solve_ = true;              ///< even when the input is the last one
  bool needs_niches_ = false;           ///< between prove() and finish(), as the next
  bool is_proof_cut_ = false;           ///< by the end of the cycle
};

}  // namespace concave_distance
