#include "benchmark/support/sampled_clearance.h"

#include <algorithm>
#include <cmath>

namespace concave_distance::benchmark {
namespace {

constexpr std::size_t kMinimaRefined = 8;
constexpr int kSections = 45;
constexpr std::size_t kFirstStride = 32;

class MotionSampler {
 public:
  MotionSampler(const MotionStage& stage, const Motion& motion, Sampled& sampled)
      : stage_(stage), motion_(motion), sampled_(sampled) {}

  /// The least distance of all pairs, or the seed.
  double at(double time, double seed) {
    stage_.place(motion_.at(time), poses_);
    std::size_t pair = sampled_.pair;
    const double distance = stage_.leastAt(poses_, seed, &pair);
    ++sampled_.samples;
    if (distance < sampled_.least) {
      sampled_.least = distance;
      sampled_.least_time = time;
      sampled_.pair = pair;
    }
    return distance;
  }

  /// Golden section between two times. @param seed no distance between them is above it
  void refine(double from, double to, double seed) {
    constexpr double kGolden = 0.6180339887498949;
    double left = to - kGolden * (to - from);
    double right = from + kGolden * (to - from);
    double at_left = at(left, seed);
    double at_right = at(right, seed);
    for (int i = 0; i < kSections && sampled_.least > 0.0; ++i) {
      if (at_left <= at_right) {
        to = right;
        right = left;
        at_right = at_left;
        left = to - kGolden * (to - from);
        at_left = at(left, seed);
      } else {
        from = left;
        left = right;
        at_left = at_right;
        right = from + kGolden * (to - from);
        at_right = at(right, seed);
      }
    }
  }

  /// Halves towards the first time below the threshold between one that is not and one that is.
  double crossing(double from, double to, double threshold) {
    for (int i = 0; i < kSections; ++i) {
      const double middle = 0.5 * (from + to);
      (at(middle, threshold) < threshold ? to : from) = middle;
    }
    return to;
  }

 private:
  const MotionStage& stage_;
  const Motion& motion_;
  Sampled& sampled_;
  MotionStage::Poses poses_;
};

}  // namespace

std::vector<double> sampleTimes(const MotionStage& stage, const Motion& motion, double step) {
  std::vector<double> times{motion.times.front()};
  MotionStage::Poses poses;
  for (std::size_t s = 0; s < motion.segmentCount(); ++s) {
    const Eigen::VectorXd change = motion.positions[s + 1] - motion.positions[s];
    stage.place(motion.positions[s] + 0.5 * change, poses);
    double path = 0.0;
    for (std::size_t i = 0; i < stage.pairs().size(); ++i) {
      path = std::max(path, stage.pathBound(i, poses, change));
    }
    const auto count = std::max(1.0, std::ceil(path / step));
    for (double i = 1.0; i <= count; ++i) {
      times.push_back(motion.times[s] + i / count * (motion.times[s + 1] - motion.times[s]));
    }
  }
  return times;
}

Sampled sampleMotion(const MotionStage& stage, const Motion& motion, const Sampling& sampling) {
  Sampled sampled;
  sampled.least = sampling.ceiling;
  MotionSampler sampler(stage, motion, sampled);
  const std::vector<double> times = sampleTimes(stage, motion, sampling.step);
  const double unknown = std::numeric_limits<double>::infinity();
  std::vector<double> distances(times.size(), unknown);
  // Far samples first: they make the seeds of the others small.
  for (std::size_t i = 0; i < times.size(); i += kFirstStride) {
    const double seed = sampled.least + sampling.step;
    distances[i] = sampler.at(times[i], seed);
    if (distances[i] >= seed) distances[i] = unknown;
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    const bool seeks = sampling.threshold > 0.0 && std::isinf(sampled.first_below);
    if (sampled.least <= 0.0 && !seeks) break;
    const double seed = std::max(sampled.least + sampling.step, seeks ? sampling.threshold : 0.0);
    const double distance = std::min(distances[i], sampler.at(times[i], std::min(seed, distances[i])));
    distances[i] = distance >= seed ? unknown : distance;
    if (seeks && distance < sampling.threshold) {
      sampled.first_below = i == 0 ? times[0] : sampler.crossing(times[i - 1], times[i], sampling.threshold);
    }
  }
  if (!sampling.refines || sampled.least <= 0.0) return sampled;
  std::vector<std::size_t> minima;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double before = i > 0 ? distances[i - 1] : unknown;
    const double after = i + 1 < times.size() ? distances[i + 1] : unknown;
    if (distances[i] < sampled.least + sampling.step && distances[i] <= before && distances[i] <= after) {
      minima.push_back(i);
    }
  }
  std::sort(minima.begin(), minima.end(),
            [&](std::size_t l, std::size_t r) { return distances[l] < distances[r]; });
  if (minima.size() > kMinimaRefined) minima.resize(kMinimaRefined);
  for (const std::size_t i : minima) {
    sampler.refine(times[i > 0 ? i - 1 : 0], times[std::min(i + 1, times.size() - 1)],
                   distances[i] + 2.0 * sampling.step);
  }
  return sampled;
}

bool touchesAtSteps(const MotionStage& stage, const Motion& motion, double step) {
  MotionStage::Poses poses;
  for (std::size_t s = 0; s < motion.segmentCount(); ++s) {
    const Eigen::VectorXd change = motion.positions[s + 1] - motion.positions[s];
    const double count = std::max(1.0, std::ceil(change.cwiseAbs().maxCoeff() / step));
    for (double i = s == 0 ? 0.0 : 1.0; i <= count; ++i) {
      stage.place(motion.at(motion.times[s] + i / count * (motion.times[s + 1] - motion.times[s])), poses);
      if (stage.leastAt(poses, 1e-12) <= 0.0) return true;
    }
  }
  return false;
}

}  // namespace concave_distance::benchmark
