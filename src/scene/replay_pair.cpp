#include "replay_pair.h"

#include <limits>

namespace concave_distance {

std::size_t replayPair(const ScenePair& pair, const std::shared_ptr<const SceneBody>& body_a,
                       const std::shared_ptr<const SceneBody>& body_b, const std::vector<TimedPose>& poses,
                       bool with_niches, WorkLimit::Clock::time_point end, const std::atomic<bool>* stop,
                       const std::function<bool(std::size_t, const TrackedPair&)>& visit) {
  auto fresh = std::make_shared<ScenePair>(pair);
  fresh->enabled = true;
  fresh->settings.tracker.time_budget = std::numeric_limits<double>::infinity();
  fresh->settings.effects = EffectSettings();
  TrackedPair tracked(std::move(fresh), body_a, body_b, 0);
  tracked.demand = {true, true, with_niches, false};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    PairInput input;
    input.a_from_b = poses[i].pose;
    input.time = poses[i].time;
    // An edit has placed a body anew at the time of the pose before: that the pose is another one counts.
    input.fixed = i > 0 && poses[i].time == poses[i - 1].time;
    if (tracked.locate(input, stop)) {
      tracked.prove(end);
      tracked.finish(end);
    }
    if (tracked.put_off || (stop != nullptr && *stop)) return i;
    if (!visit(i, tracked)) return i + 1;
  }
  return poses.size();
}

}  // namespace concave_distance
