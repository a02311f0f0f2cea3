#include "clearance_search.h"

#include <algorithm>

namespace concave_distance::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Gaps that are sampled together at first: few, because the first distances exclude most.
constexpr std::size_t kFirstJobs = 8;
/// Share of the tolerance that a distance is proven to.
constexpr double kSampleShare = 0.25;
/// A gap of certified ends in which nothing moves farther than this share of the tolerance is not split.
constexpr double kLeastWayShare = 1.0 / 64.0;
/// Metres: distances prove little of a gap in which more is moved.
constexpr double kLongestWay = 0.5;
/// Steps of moments in which the nearest moment is looked for where contact is open.
constexpr double kFirstStep = 1.0 / 64.0;
constexpr double kLastStep = 1e-7;

}  // namespace

ClearanceSearch::ClearanceSearch(GapSampler& sampler)
    : sampler_(sampler), parameters_(sampler.parameters()), records_(sampler.pairs().size()) {}

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

ClearanceProgress ClearanceSearch::progress() const {
  ClearanceProgress progress;
  const double whole = sampler_.paths().end() * static_cast<double>(records_.size());
  progress.fraction = whole > 0.0 ? std::min(1.0, closed_ / whole) : 0.0;
  progress.distance = least_ ? least_->sample.distance : kInfinity;
  progress.lower_bound = lower();
  return progress;
}

void ClearanceSearch::begin() {
  const MotionPaths& paths = sampler_.paths();
  jobs_.assign(sampler_.pairs().size(), {});
  for (std::size_t i = 0; i < jobs_.size(); ++i) jobs_[i].gap = i;
  sampler_.run(jobs_, [&](GapJob& job, ClearanceWorkspace& workspace) {
    const ClearancePair& pair = sampler_.pairs()[job.gap];
    pair.path.evaluate(paths, momentAt(0.0, paths.segmentCount()), workspace.pose);
    ClearanceSample right;
    right.moment = paths.end();
    job.parts.push_back(
        gapBetween(paths, pair, job.gap, sampleByBoxes(pair, 0.0, workspace), right, workspace));
  });
  for (const GapJob& job : jobs_) open_.push(job.parts.front(), job.parts.front().lower);
}

// The least sample is exact to a share of the tolerance; now its distance becomes the pair's at its moment.
// Where the bracket leaves open whether there is contact, the pair is followed to its nearest moment close
// by.
void ClearanceSearch::sharpenLeast() {
  if (!least_) return;
  const std::size_t pair = least_->pair;
  const auto look = [&](double moment) {
    take(sampler_.sampleExactly(pair, moment, least_->sample.triangles), pair);
  };
  look(least_->sample.moment);
  const auto is_open = [&] {
    return least_->sample.distance > 0.0 && least_->sample.distance <= parameters_.tolerance;
  };
  for (double step = kFirstStep; step > kLastStep; step *= 0.5) {
    for (const double signed_step : {step, -step}) {
      double before = kInfinity;
      while (is_open() && least_->sample.distance < before) {
        before = least_->sample.distance;
        look(std::clamp(least_->sample.moment + signed_step, 0.0, sampler_.paths().end()));
      }
    }
  }
}

// Some samples are taken even where the limits allow none.
void ClearanceSearch::findLeast() {
  begin();
  std::size_t most = kFirstJobs;
  for (bool is_first = true; !open_.isEmpty(); is_first = false) {
    is_cut_ = !is_first && sampler_.isSpent();
    if (is_cut_) break;
    jobs_.clear();
    while (!open_.isEmpty() && jobs_.size() < most) {
      const std::size_t place = open_.pop();
      if (isDone(open_[place])) {
        close(open_[place]);
        open_.free(place);
      } else {
        jobs_.emplace_back().gap = place;
      }
    }
    sampler_.run(jobs_,
                 [&](GapJob& job, ClearanceWorkspace& workspace) { refine(open_[job.gap], job, workspace); });
    for (const GapJob& job : jobs_) take(job.sample, open_[job.gap].pair);
    for (const GapJob& job : jobs_) {
      open_.free(job.gap);
      for (const ClearanceGap& part : job.parts) {
        if (isDone(part)) {
          close(part);
        } else {
          open_.push(part, part.lower);
        }
      }
    }
    most = GapSampler::kMostJobs;
    sampler_.report([&] { return progress(); });
  }
  sharpenLeast();
}

// Halves a gap in which much is moved. Else samples an end that proves less than is aimed at and was not
// looked at exactly, or the weakest moment.
void ClearanceSearch::refine(const ClearanceGap& gap, GapJob& job, ClearanceWorkspace& workspace) const {
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
    moment = splitAt(sampler_.paths(), gap.left.moment, gap.right.moment,
                     0.5 * (gap.left.moment + gap.right.moment));
  } else if (is_weak(gap.left)) {
    moment = gap.left.moment;
    request.allows_boxes = false;
  } else if (is_weak(gap.right)) {
    moment = gap.right.moment;
    request.allows_boxes = gap.right.lower == -kInfinity && !is_undivided;
  }
  sampler_.split(gap, moment, request, job, workspace);
}

double ClearanceSearch::lower() const {
  double lower = kInfinity;
  for (const PairLeast& record : records_) lower = std::min(lower, record.lower);
  open_.visit([&](const ClearanceGap& gap) { lower = std::min(lower, gap.bound()); });
  return least_ ? std::min(lower, least_->sample.distance) : lower;
}

std::vector<ClearanceSearch::PairLeast> ClearanceSearch::pairs() const {
  std::vector<PairLeast> pairs = records_;
  open_.visit(
      [&](const ClearanceGap& gap) { pairs[gap.pair].lower = std::min(pairs[gap.pair].lower, gap.bound()); });
  for (PairLeast& pair : pairs) pair.lower = std::min(pair.lower, pair.distance);
  return pairs;
}

std::vector<ClearanceGap> ClearanceSearch::gapsBelow() const {
  std::vector<ClearanceGap> gaps = kept_;
  open_.visit([&](const ClearanceGap& gap) { gaps.push_back(gap); });
  return gaps;
}

}  // namespace concave_distance::detail
