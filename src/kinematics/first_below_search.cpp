#include "first_below_search.h"

#include <algorithm>

namespace concave_distance::detail {
namespace {

/// Share of the tolerance that a distance is proven to.
constexpr double kFirstSampleShare = 0.0625;

}  // namespace

FirstBelowSearch::FirstBelowSearch(GapSampler& sampler, double threshold)
    : sampler_(sampler), threshold_(threshold) {
  first_.proven_until = sampler.paths().end();
}

bool FirstBelowSearch::isLate(const ClearanceGap& gap) const {
  return first_.moment && gap.left.moment >= *first_.moment;
}

void FirstBelowSearch::note(const ClearanceSample& sample, std::size_t pair) {
  if (!sample.is_certified || !(sample.distance < threshold_)) return;
  if (first_.moment && *first_.moment <= sample.moment) return;
  first_.moment = sample.moment;
  first_.pair = pair;
}

// Queues a gap, or gives it up where another sample would prove nothing more.
void FirstBelowSearch::add(const ClearanceGap& gap) {
  if (isLate(gap)) return;
  const std::optional<double> middle = middleBelow(sampler_.paths(), gap, threshold_);
  if (!middle) return;
  const bool is_end = *middle <= gap.left.moment || *middle >= gap.right.moment;
  if (gap.left.is_certified && (is_end || gap.way <= sampler_.parameters().tolerance)) {
    first_.proven_until = std::min(first_.proven_until, gap.left.moment);
  } else {
    open_.push(gap, gap.left.moment);
  }
}

FirstBelowSearch::First FirstBelowSearch::find(const std::vector<ClearanceGap>& gaps,
                                               const ClearanceProgress& progress) {
  for (const ClearanceGap& gap : gaps) {
    note(gap.left, gap.pair);
    note(gap.right, gap.pair);
  }
  for (const ClearanceGap& gap : gaps) add(gap);
  while (!open_.isEmpty() && !sampler_.isSpent()) {
    jobs_.clear();
    while (!open_.isEmpty() && jobs_.size() < GapSampler::kMostJobs) {
      const std::size_t place = open_.pop();
      if (isLate(open_[place])) {
        open_.free(place);
      } else {
        jobs_.emplace_back().gap = place;
      }
    }
    sampler_.run(jobs_,
                 [&](GapJob& job, ClearanceWorkspace& workspace) { narrow(open_[job.gap], job, workspace); });
    for (const GapJob& job : jobs_) note(job.sample, open_[job.gap].pair);
    for (const GapJob& job : jobs_) {
      open_.free(job.gap);
      for (const ClearanceGap& part : job.parts) add(part);
    }
    sampler_.report([&] { return progress; });
  }
  const auto end_at = [&](double moment) { first_.proven_until = std::min(first_.proven_until, moment); };
  open_.visit([&](const ClearanceGap& gap) { end_at(gap.left.moment); });
  if (first_.moment) end_at(*first_.moment);
  return first_;
}

void FirstBelowSearch::narrow(const ClearanceGap& gap, GapJob& job, ClearanceWorkspace& workspace) const {
  const double tolerance = sampler_.parameters().tolerance;
  SampleRequest request;
  request.aim = threshold_;
  request.need = std::max(0.0, threshold_ - gap.lower);
  request.tolerance = kFirstSampleShare * tolerance;
  double moment = *middleBelow(sampler_.paths(), gap, threshold_);
  const bool is_small = gap.way <= tolerance || moment <= gap.left.moment;
  if (!gap.left.is_certified && (gap.left.lower < threshold_ || is_small)) {
    moment = gap.left.moment;
    request.allows_boxes = false;
  }
  sampler_.split(gap, moment, request, job, workspace);
}

}  // namespace concave_distance::detail
