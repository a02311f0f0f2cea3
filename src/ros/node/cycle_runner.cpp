#include "cycle_runner.h"

#include <ros/console.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "base/thread_team.h"
#include "node_parameters.h"
#include "ros/callback_guard.h"
#include "ros/time_difference.h"

namespace concave_distance {
namespace {

WorkLimit::Clock::time_point endOfCycle(WorkLimit::Clock::time_point start, double seconds) {
  if (!std::isfinite(seconds)) return kNoCycleEnd;
  return start +
         std::chrono::duration_cast<WorkLimit::Clock::duration>(std::chrono::duration<double>(seconds));
}

// A marker lives for this many marker periods, but never shorter than the seconds below.
constexpr double kMarkerPeriods = 5.0;
constexpr double kShortestMarkerLife = 0.5;
constexpr double kWarningPeriod = 5.0;  // s, between two warnings of the same kind

std::vector<std::string> failingPairs(const PublishedPairs& pairs) {
  std::vector<std::string> failing;
  for (const auto& pair : pairs) {
    const bool failed = pair->status.code == PairStatus::MISSING_TRANSFORM ||
                        pair->status.code == PairStatus::STALE_TRANSFORM;
    if (pair->demand().due && failed) {
      failing.push_back(pair->heading.pair + ": " + pair->status.message);
    }
  }
  return failing;
}

}  // namespace

CycleRunner::CycleRunner(TransformBuffer& transforms, SceneStore& keeper, TopicPublishers& publishers,
                         RestartRequests& restarts, const CycleOptions& options,
                         const std::optional<double>& cycle_budget)
    : transforms_(transforms),
      keeper_(keeper),
      publishers_(publishers),
      restarts_(restarts),
      cycle_budget_(cycle_budget),
      cycle_(transforms, options),
      timer_([this](std::int64_t due) {
        if (!guarded("A cycle", [&] { runTimedCycle(due); })) statistics_.addFailure();
      }) {}

void CycleRunner::start(double rate) {
  rate_ = rate;
  timer_.start(rate);
}

void CycleRunner::setRates(double rate, double marker_rate) {
  marker_rate_ = marker_rate;
  if (rate != rate_.exchange(rate)) {
    timer_.setRate(rate);
  }
}

void CycleRunner::setMarkers(bool publish, bool contacts) {
  publish_markers_ = publish;
  contact_markers_ = contacts;
}

void CycleRunner::runTimedCycle(std::int64_t due) {
  const std::int64_t cpu_start = threadCpuNanoseconds();
  const WorkLimit::Clock::time_point cycle_start = WorkLimit::Clock::now();
  const ros::WallTime start = ros::WallTime::now();
  statistics_.begin(start.toSec());
  const ros::Time now = ros::Time::now();
  checkClock(now);
  CycleRecord record = runCycle(now, cycle_start);
  record.duration = (ros::WallTime::now() - start).toSec();
  record.cpu =
      1e-9 * static_cast<double>(threadCpuNanoseconds() - cpu_start) + record.report.helper_cpu_seconds;
  const auto past_due = static_cast<std::int64_t>(ros::Time::now().toNSec()) - due;
  record.late = 1e-9 * static_cast<double>(past_due) > 1.0 / rate_;
  if (!record.failing.empty()) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod,
                             record.failing.size()
                                 << " of " << record.report.watched
                                 << " watched pairs are not solved: transforms are missing or old; "
                                 << record.failing.front());
  }
  statistics_.add(std::move(record));
}

void CycleRunner::checkClock(ros::Time now) {
  if (now < last_now_) {
    ROS_WARN("The clock jumped back by %.3f s: transforms and tracked niches are forgotten.",
             secondsBetween(now, last_now_));
    transforms_.checkClock();
    cycle_.restart();
    publishers_.restart();
  }
  last_now_ = now;
}

bool CycleRunner::adoptScene() {
  std::shared_ptr<const ServedScene> served = keeper_.served();
  const bool scene_changed = served != served_;
  if (scene_changed) {
    const bool settings_changed = !served_ || served_->settings_revision != served->settings_revision;
    cycle_.setScene(*served->scene, settings_changed);
    served_ = std::move(served);
    publishers_.publishRetired(cycle_.takeRetired());
  }
  const RestartRequests::Pending pending = restarts_.take();
  if (pending.all) {
    cycle_.restart();
    publishers_.restart();
  }
  for (const std::string& name : pending.pairs) {
    for (std::size_t place = 0; place < cycle_.pairs().size(); ++place) {
      if (cycle_.pairs()[place]->heading.pair == name) cycle_.restart(place);
    }
  }
  return scene_changed;
}

CycleRecord CycleRunner::runCycle(ros::Time now, WorkLimit::Clock::time_point start) {
  const bool scene_changed = adoptScene();
  const double marker_rate = std::min<double>(marker_rate_, rate_);
  const bool marker_cycle = cycles_until_markers_ == 0;
  cycles_until_markers_ = marker_cycle ? static_cast<std::uint64_t>(std::lround(rate_ / marker_rate)) - 1
                                       : cycles_until_markers_ - 1;
  publishers_.readDemand(*served_, {publish_markers_, contact_markers_, marker_cycle});
  CycleRecord record;
  // One more cycle after the last subscriber has gone ends what it needed. After that, pairs without
  // subscribers cost nothing.
  const bool idle = publishers_.isIdle();
  if (std::exchange(was_idle_, idle) && idle && !scene_changed) {
    return record;
  }
  const auto demand_of = [this](std::size_t place, const TrackedPair& pair) {
    return publishers_.demandOf(*served_, place, pair);
  };
  record.report = cycle_.run(demand_of, now, endOfCycle(start, cycleBudget(cycle_budget_, rate_)));
  const PublishReport published =
      publishers_.publish(*served_, cycle_.pairs(), cycle_.others(),
                          std::max(kMarkerPeriods / marker_rate, kShortestMarkerLife), now);
  publishers_.publishConstraints({cycle_.trackedPairs(), cycle_.located(), cycle_.others()}, now);
  record.latency = published.latency;
  record.messages = published.messages;
  record.markers = published.markers;
  record.failing = failingPairs(cycle_.pairs());
  return record;
}

}  // namespace concave_distance
