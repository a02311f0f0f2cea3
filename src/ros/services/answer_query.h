#pragma once

#include <concave_distance/DistanceQuery.h>
#include <concave_distance/PairContactState.h>
#include <concave_distance/PairNiches.h>
#include <ros/time.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "concave_distance/kinematics/scene_kinematics.h"
#include "concave_distance/scene/scene.h"
#include "node_limits.h"
#include "ros/tf/transform_buffer.h"

namespace concave_distance {

/// Holds what a query is answered with besides the scene.
struct QueryContext {
  const TransformBuffer* transforms = nullptr;
  std::string reference_frame;
  double transform_timeout = 0.2;  ///< s
  double stale_after = 1.0;        ///< s
  /// All queries of a call end at this time: running ones stop with the bound they have.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  /// The joints of the scene's robots; called for queries at joint positions alone. @throws Error without
  /// them
  std::function<std::shared_ptr<const SceneKinematics>()> joints = nullptr;
  const std::atomic<bool>* stop = nullptr;  ///< set: running queries end, no other begins
  std::uint32_t largest_niche_count = NodeLimits().largest_niche_count;  ///< with contacts, in one answer
};

/// The answer to one query.
struct QueryAnswer {
  PairNiches result;
  PairContactState contacts;  ///< empty unless asked for
};

/// Answers one query by a solve of its own: nothing that is tracked is read or changed. Never throws: what
/// cannot be answered has a status that says why.
QueryAnswer answerQuery(const DistanceQuery& query, const Scene& scene, const QueryContext& context,
                        ros::Time now) noexcept;

/// Removes the ids of an answer: they belong to what is tracked.
void forgetIds(PairNiches& answer);

/// True when the answer carries a distance.
bool isAnswered(const PairNiches& answer);

}  // namespace concave_distance
