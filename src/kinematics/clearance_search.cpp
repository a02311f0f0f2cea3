#include "clearance_search.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>
#include <utility>

#include "scene/solver_threads.h"

namespace concave_distance::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Gaps that are worked on together: at first few, because the first distances exclude most.
constexpr std::size_t kFirstJobs = 8;
constexpr std::size_t kMostJobs = 32;
/// Shares of the tolerance that a distance is proven to.
constexpr double kSampleShare = 0.25;
constexpr double kFirstSampleShare = 0.0625;
/// A gap of certified ends in which nothing moves farther than this share of the tolerance is not split.
constexpr double kLeastWayShare = 1.0 / 64.0;
/// Metres: distances prove little of a gap in which more is moved.
constexpr double kLongestWay = 0.5;
/// Steps of moments in which the nearest moment is looked for where contact is open.
constexpr double kFirstStep = 1.0 / 64.0;
constexpr double kLastStep = 1e-7;
constexpr std::chrono::milliseconds kReportPeriod(100);

}  // namespace

bool ClearanceSearch::Key::operator<(const Key& other) const {
  return std::tie(other.order, other.moment, other.pair) < std::tie(order, moment, pair);
}

ClearanceSearch::ClearanceSearch(const MotionPaths& paths, const std::vector<ClearancePair>& pairs,
                                 const ClearanceParameters& parameters, WorkLimit limit)
    : paths_(paths),
      pairs_(pairs),
      parameters_(parameters),
      limit_(limit),
      records_(pairs.size()),
      arena_(solverThreads(parameters.threads)),
      workspaces_(static_cast<std::size_t>(solverThreads(parameters.threads))),
      next_report_(WorkLimit::Clock::now() + kReportPeriod) {}

double ClearanceSearch::aimOf(std::size_t pair) const {
  const double best = parameters_.each_pair ? records_[pair].distance
                      : least_              ? least_->sample.distance
                                            : kInfinity;
  return best - parameters_.tolerance;
}

bool ClearanceSearch::isUndivided(const ClearanceGap& gap) const {
  return gap.isUndivided(kLeastWayShare * parameters_.tolerance);
}

bool ClearanceSearch::isDone(const ClearanceGap& gap) const {
  return gap.bound() >= aimOf(gap.pair) || (gap.isCertified() && isUndivided(gap));
}

// Works on all jobs, on as many threads as there are; what is written here is each job's own.
template <typename Work>
void ClearanceSearch::runJobs(const Work& work) {
  if (workspaces_.size() == 1 || jobs_.size() == 1) {
    for (Job& job : jobs_) work(job, workspaces_.front());
  } else {
    arena_.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, jobs_.size(), 1),
                        [&](const tbb::blocked_range<std::size_t>& range) {
                          const int thread = tbb::this_task_arena::current_thread_index();
                          ClearanceWorkspace& workspace = workspaces_[static_cast<std::size_t>(thread)];
                          for (std::size_t i = range.begin(); i != range.end(); ++i)
                            work(jobs_[i], workspace);
                        });
    });
  }
  queries_ = box_queries_ = 0;
  for (const ClearanceWorkspace& workspace : workspaces_) {
    queries_ += workspace.queries;
    box_queries_ += workspace.box_queries;
  }
}

void ClearanceSearch::push(const ClearanceGap& gap, double order) {
  std::size_t place = gaps_.size();
  if (free_.empty()) {
    gaps_.push_back(gap);
  } else {
    place = free_.back();
    free_.pop_back();
    gaps_[place] = gap;
  }
  open_.push_back({order, gap.pair, gap.left.moment, place});
  std::push_heap(open_.begin(), open_.end());
}

// The gap stays in its place until it is freed.
std::size_t ClearanceSearch::pop() {
  std::pop_heap(open_.begin(), open_.end());
  const std::size_t gap = open_.back().gap;
  open_.pop_back();
  return gap;
}

void ClearanceSearch::close(const ClearanceGap& gap) {
  PairLeast& record = records_[gap.pair];
  record.lower = std::min(record.lower, gap.bound());
  closed_ += gap.right.moment - gap.left.moment;
  const double threshold = parameters_.threshold.value_or(0.0);
  if (gap.lower < threshold || gap.lower <= 0.0) kept_.push_back(gap);
}

void ClearanceSearch::take(const ClearanceSample& sample, std::size_t pair) {
  PairLeast& record = records_[pair];
  if (sample.distance < record.distance) {
    record.distance = sample.distance;
    record.moment = sample.moment;
  }
  if (!sample.is_certified || (least_ && sample.distance >= least_->sample.distance)) return;
  least_ = Least{pair, sample};
}

void ClearanceSearch::report() {
  if (!parameters_.progress || WorkLimit::Clock::now() < next_report_) return;
  next_report_ = WorkLimit::Clock::now() + kReportPeriod;
  ClearanceProgress progress;
  const double whole = paths_.end() * static_cast<double>(pairs_.size());
  progress.fraction = whole > 0.0 ? std::min(1.0, closed_ / whole) : 0.0;
  progress.distance = least_ ? least_->sample.distance : kInfinity;
  progress.lower_bound = lower();
  progress.queries = queries_;
  parameters_.progress(progress);
}

// Some samples are taken in any case.
bool ClearanceSearch::mayGoOn(bool is_first) {
  if (!is_first && (limit_.isOver() || queries_ + box_queries_ >= parameters_.sample_limit)) is_cut_ = true;
  return !is_cut_;
}

void ClearanceSearch::begin() {
  jobs_.assign(pairs_.size(), {});
  for (std::size_t i = 0; i < jobs_.size(); ++i) jobs_[i].gap = i;
  runJobs([&](Job& job, ClearanceWorkspace& workspace) {
    const ClearancePair& pair = pairs_[job.gap];
    pair.path.evaluate(paths_, momentAt(0.0, paths_.segmentCount()), workspace.pose);
    ClearanceSample right;
    right.moment = paths_.end();
    job.parts.push_back(
        gapBetween(paths_, pair, job.gap, sampleByBoxes(pair, 0.0, workspace), right, workspace));
  });
  addStarts();
  for (const Job& job : jobs_) {
    for (const ClearanceGap& gap : job.parts) push(gap, gap.lower);
  }
}

// Splits the gaps of the whole motion where the caller expects small distances.
void ClearanceSearch::addStarts() {
  ClearanceWorkspace& workspace = workspaces_.front();
  for (const ClearanceStart& start : parameters_.starts) {
    const double moment = paths_.momentOf(start.time);
    for (Job& job : jobs_) {
      const ClearancePair& pair = pairs_[job.gap];
      if (std::minmax(pair.body_a, pair.body_b) != std::minmax(start.body_a, start.body_b)) continue;
      const auto holder = std::find_if(job.parts.begin(), job.parts.end(), [&](const ClearanceGap& gap) {
        return gap.left.moment < moment && moment < gap.right.moment;
      });
      if (holder == job.parts.end()) continue;
      const ClearanceGap gap = *holder;
      SampleRequest request;
      request.aim = request.need = kInfinity;
      request.tolerance = kSampleShare * parameters_.tolerance;
      const ClearanceSample sample = sampleIn(paths_, pair, gap, moment, request, workspace, limit_);
      take(sample, job.gap);
      *holder = gapBetween(paths_, pair, job.gap, gap.left, sample, workspace);
      job.parts.push_back(gapBetween(paths_, pair, job.gap, sample, gap.right, workspace));
    }
  }
}

// The least sample is exact to a share of the tolerance; now its distance becomes the pair's at its moment.
// Where the bracket leaves open whether there is contact, the pair is followed to its nearest moment close
// by.
void ClearanceSearch::sharpenLeast() {
  if (!least_) return;
  const std::size_t pair = least_->pair;
  sampleExactly(pair, least_->sample.moment);
  const auto isOpen = [&] {
    return least_->sample.distance > 0.0 && least_->sample.distance <= parameters_.tolerance;
  };
  for (double step = kFirstStep; step > kLastStep; step *= 0.5) {
    for (const double signed_step : {step, -step}) {
      double before = std::numeric_limits<double>::infinity();
      while (isOpen() && least_->sample.distance < before) {
        before = least_->sample.distance;
        sampleExactly(pair, std::clamp(least_->sample.moment + signed_step, 0.0, paths_.end()));
      }
    }
  }
}

void ClearanceSearch::sampleExactly(std::size_t pair, double moment) {
  ClearanceWorkspace& workspace = workspaces_.front();
  pairs_[pair].path.evaluate(paths_, momentAt(moment, paths_.segmentCount()), workspace.pose);
  SampleRequest request;
  request.aim = request.need = kInfinity;
  request.allows_boxes = false;
  const TrianglePair start = least_->sample.triangles;
  ++queries_;
  take(sampleAt(pairs_[pair], moment, request, &start, 1, false, workspace, limit_), pair);
}

void ClearanceSearch::findLeast() {
  begin();
  std::size_t most = kFirstJobs;
  for (bool is_first = true; !open_.empty() && mayGoOn(is_first); is_first = false) {
    jobs_.clear();
    while (!open_.empty() && jobs_.size() < most) {
      const std::size_t place = pop();
      if (isDone(gaps_[place])) {
        close(gaps_[place]);
        free_.push_back(place);
      } else {
        jobs_.emplace_back().gap = place;
      }
    }
    runJobs([&](Job& job, ClearanceWorkspace& workspace) { refine(job, workspace); });
    for (const Job& job : jobs_) take(job.sample, gaps_[job.gap].pair);
    for (const Job& job : jobs_) {
      free_.push_back(job.gap);
      for (const ClearanceGap& part : job.parts) {
        if (isDone(part)) {
          close(part);
        } else {
          push(part, part.lower);
        }
      }
    }
    most = kMostJobs;
    report();
  }
  sharpenLeast();
}

// Halves a gap in which much is moved. Else samples an end that proves less than is aimed at and was not
// looked at exactly, or the weakest moment.
void ClearanceSearch::refine(Job& job, ClearanceWorkspace& workspace) const {
  const ClearanceGap& gap = gaps_[job.gap];
  SampleRequest request;
  request.aim = aimOf(gap.pair);
  request.need = std::max(0.0, request.aim - gap.lower);
  request.tolerance = kSampleShare * parameters_.tolerance;
  const bool is_undivided = isUndivided(gap);
  const auto is_weak = [&](const ClearanceSample& end) {
    return !end.is_certified && (is_undivided || !(end.lower > request.aim));
  };
  double moment = gap.weakest;
  if (gap.way > kLongestWay && !is_undivided) {
    request.need = 0.0;
    moment = splitAt(paths_, gap.left.moment, gap.right.moment, 0.5 * (gap.left.moment + gap.right.moment));
  } else if (is_weak(gap.left)) {
    moment = gap.left.moment;
    request.allows_boxes = false;
  } else if (is_weak(gap.right)) {
    moment = gap.right.moment;
    request.allows_boxes = gap.right.lower == -kInfinity && !is_undivided;
  }
  sampleAndSplit(job, moment, request, workspace);
}

void ClearanceSearch::sampleAndSplit(Job& job, double moment, const SampleRequest& request,
                                     ClearanceWorkspace& workspace) const {
  const ClearanceGap& gap = gaps_[job.gap];
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

double ClearanceSearch::lower() const {
  double lower = kInfinity;
  for (const PairLeast& record : records_) lower = std::min(lower, record.lower);
  for (const Key& key : open_) lower = std::min(lower, gaps_[key.gap].bound());
  return least_ ? std::min(lower, least_->sample.distance) : lower;
}

std::vector<ClearanceSearch::PairLeast> ClearanceSearch::pairs() const {
  std::vector<PairLeast> pairs = records_;
  for (const Key& key : open_) {
    const ClearanceGap& gap = gaps_[key.gap];
    pairs[gap.pair].lower = std::min(pairs[gap.pair].lower, gap.bound());
  }
  for (PairLeast& pair : pairs) pair.lower = std::min(pair.lower, pair.distance);
  return pairs;
}

void ClearanceSearch::findFirstBelow(double threshold) {
  first_.proven_until = paths_.end();
  const auto note = [&](const ClearanceSample& sample, std::size_t pair) {
    if (!sample.is_certified || !(sample.distance < threshold) ||
        (first_.moment && *first_.moment <= sample.moment))
      return;
    first_.moment = sample.moment;
    first_.pair = pair;
  };
  // What was proven stays; the gaps below the threshold are taken up in the order of time.
  std::vector<ClearanceGap> below = std::move(kept_);
  for (const Key& key : open_) below.push_back(gaps_[key.gap]);
  std::vector<PairLeast> proven = pairs();
  open_.clear();
  gaps_.clear();
  free_.clear();
  records_ = std::move(proven);
  for (const ClearanceGap& gap : below) {
    note(gap.left, gap.pair);
    note(gap.right, gap.pair);
  }
  double unresolved = kInfinity;
  const auto add = [&](const ClearanceGap& gap) {
    if (first_.moment && gap.left.moment >= *first_.moment) return;
    const std::optional<double> middle = middleBelow(paths_, gap, threshold);
    if (!middle) return;
    const bool is_end = *middle <= gap.left.moment || *middle >= gap.right.moment;
    if (gap.left.is_certified && (is_end || gap.way <= parameters_.tolerance)) {
      unresolved = std::min(unresolved, gap.left.moment);
    } else {
      push(gap, gap.left.moment);
    }
  };
  for (const ClearanceGap& gap : below) add(gap);
  is_cut_ = false;
  while (!open_.empty() && mayGoOn(false)) {
    jobs_.clear();
    while (!open_.empty() && jobs_.size() < kMostJobs) {
      const std::size_t place = pop();
      const double moment = gaps_[place].left.moment;
      if (first_.moment && moment >= *first_.moment) {
        free_.push_back(place);
      } else {
        jobs_.emplace_back().gap = place;
      }
    }
    runJobs([&](Job& job, ClearanceWorkspace& workspace) { narrow(job, threshold, workspace); });
    for (const Job& job : jobs_) note(job.sample, gaps_[job.gap].pair);
    for (const Job& job : jobs_) {
      free_.push_back(job.gap);
      for (const ClearanceGap& part : job.parts) add(part);
    }
    report();
  }
  for (const Key& key : open_) unresolved = std::min(unresolved, key.moment);
  first_.proven_until = std::min({first_.proven_until, unresolved, first_.moment.value_or(kInfinity)});
}

void ClearanceSearch::narrow(Job& job, double threshold, ClearanceWorkspace& workspace) const {
  const ClearanceGap& gap = gaps_[job.gap];
  SampleRequest request;
  request.aim = threshold;
  request.need = std::max(0.0, threshold - gap.lower);
  request.tolerance = kFirstSampleShare * parameters_.tolerance;
  double moment = *middleBelow(paths_, gap, threshold);
  const bool is_small = gap.way <= parameters_.tolerance || moment <= gap.left.moment;
  if (!gap.left.is_certified && (gap.left.lower < threshold || is_small)) {
    moment = gap.left.moment;
    request.allows_boxes = false;
  }
  sampleAndSplit(job, moment, request, workspace);
}

}  // namespace concave_distance::detail
