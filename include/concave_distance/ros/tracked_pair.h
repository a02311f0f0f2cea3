#pragma once

#include <concave_distance/PairStatus.h>
#include <ros/time.h>

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "concave_distance/ros/conversions.h"
#include "concave_distance/ros/followed_effects.h"
#include "concave_distance/ros/tf_poses.h"
#include "concave_distance/ros/warning_monitor.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/tracking/pair_tracker.h"

namespace concave_distance {

/// What the subscribers want of a pair in one cycle.
struct PairDemand {
  bool watched = false;  ///< some topic that carries the pair has a subscriber
  bool due = false;      ///< one of them gets a message in this cycle
  bool niches = false;   ///< some of them carries niches
  bool effects = false;  ///< some of them carries contacts
};

/// One pair of the scene while it is followed; owned by the cycle's thread.
struct TrackedPair {
  /// @param index of the pair in the scene
  TrackedPair(const Scene& scene, std::size_t index, const std::string& reference_frame,
              std::uint64_t first_id);

  std::shared_ptr<const ScenePair> origin;  ///< the scene pair that it was last set up from

  /// Bodies of the scene. One that is removed and added again is another, with settings of its own.
  std::shared_ptr<const SceneBody> body_a;
  std::shared_ptr<const SceneBody> body_b;
  PairFrames frames;
  PairAncestors ancestors;
  PairSettings settings;
  bool enabled = true;
  PairDemand demand;

  /// Names, stamp and pose of the last answer. Its id_offset keeps ids unused when a pair comes back under
  /// its old name: a tracker begins to count at 1.
  PairHeading heading;
  PairStatus status;      ///< why there is no solution; OK when there is
  bool solved = false;    ///< `solution` is of this stamp
  bool repeated = false;  ///< no newer transforms: the last answer stands, nothing was computed
  bool fixed = false;     ///< both bodies are connected by static transforms only
  /// Metres, with status BEYOND_CUTOFF: proven by boxes and spheres around the bodies.
  std::optional<double> box_bound;
  Eigen::Isometry3d located_a_from_b = Eigen::Isometry3d::Identity();  ///< of the last transforms
  Eigen::Isometry3d solved_a_from_b = Eigen::Isometry3d::Identity();
  PairSolution solution;
  FollowedEffects effects;
  std::uint64_t largest_id = 0;  ///< reported so far, with the offset

  WarningMonitor warning;
  std::unique_ptr<PairTracker> tracker;  ///< made when the pair is first watched
  bool warning_changed = false;
  bool stale_parameters = false;  ///< the tracker has to be given the settings again
  bool must_solve = true;         ///< even when the transforms are the last ones

  /// Forgets the niches; ids go on.
  void restart();
  /// The same after an exception: tracker and effects may be half changed and are made anew. Allocates
  /// nothing.
  void discard();
  /// Gives tracker and effects what the settings and the demand say; makes them when there are none.
  /// @param stop flag of the node; when set, a solve ends with its results so far
  void prepare(const std::atomic<bool>* stop);
};

}  // namespace concave_distance
