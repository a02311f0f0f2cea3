#include "gap_sampler.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "scene/solver_threads.h"

namespace concave_distance::detail {
namespace {

constexpr std::chrono::milliseconds kReportPeriod(100);

}  // namespace

GapSampler::GapSampler(const MotionPaths& paths, const std::vector<ClearancePair>& pairs,
                       const ClearanceParameters& parameters, WorkLimit limit)
    : paths_(paths),
      pairs_(pairs),
      parameters_(parameters),
      limit_(limit),
      arena_(solverThreads(parameters.threads)),
      workspaces_(static_cast<std::size_t>(solverThreads(parameters.threads))),
      next_report_(WorkLimit::Clock::now() + kReportPeriod) {}

void GapSampler::split(const ClearanceGap& gap, double moment, const SampleRequest& request, GapJob& job,
                       ClearanceWorkspace& workspace) const {
  const ClearancePair& pair = pairs_[gap.pair];
  WorkLimit limit = limit_;
  job.sample = sampleIn(paths_, pair, gap, moment, request, workspace, limit);
  const auto add = [&](const ClearanceSample& left, const ClearanceSample& right) {
    ClearanceGap part = gapBetween(paths_, pair, gap.pair, left, right, workspace);
    part.lower = std::max(part.lower, gap.lower);
    job.parts.push_back(part);
  };
  if (gap.left.moment == gap.right.moment) {
    add(job.sample, job.sample);
  } else if (moment == gap.left.moment) {
    add(job.sample, gap.right);
  } else if (moment == gap.right.moment) {
    add(gap.left, job.sample);
  } else {
    add(gap.left, job.sample);
    add(job.sample, gap.right);
  }
}

ClearanceSample GapSampler::sampleExactly(std::size_t pair, double moment, const TrianglePair& start) {
  ClearanceWorkspace& workspace = workspaces_.front();
  pairs_[pair].path.evaluate(paths_, momentAt(moment, paths_.segmentCount()), workspace.pose);
  SampleRequest request;
  request.aim = request.need = std::numeric_limits<double>::infinity();
  request.allows_boxes = false;
  ClearanceSample sample = sampleAt(pairs_[pair], moment, request, &start, 1, false, workspace, limit_);
  count();
  return sample;
}

void GapSampler::count() {
  queries_ = box_queries_ = 0;
  for (const ClearanceWorkspace& workspace : workspaces_) {
    queries_ += workspace.queries;
    box_queries_ += workspace.box_queries;
  }
}

bool GapSampler::isReportDue() {
  if (!parameters_.progress || WorkLimit::Clock::now() < next_report_) return false;
  next_report_ = WorkLimit::Clock::now() + kReportPeriod;
  return true;
}

}  // namespace concave_distance::detail
