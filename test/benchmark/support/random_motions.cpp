#include "benchmark/support/random_motions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "benchmark/support/sampled_clearance.h"
#include "concave_distance/base/error.h"
#include "support/robots.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kNoise = 0.2;        // rad, around the path
constexpr double kShortChange = 0.3;  // rad
constexpr double kVelocity = 1.0;     // rad/s
constexpr double kNear = 0.05;        // m
constexpr double kCoarseStep = 0.01;  // m of path, to sort motions by what they do
constexpr int kTries = 10000;
constexpr int kHalvings = 20;

std::vector<Eigen::VectorXd> readPath(const std::string& file, double from, double to) {
  std::istringstream lines(test::packageFile(file));
  std::vector<Eigen::VectorXd> path;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    std::vector<double> row{std::istream_iterator<double>(cells), std::istream_iterator<double>()};
    if (row.empty() || row[0] < from || row[0] > to) continue;
    path.emplace_back(Eigen::Map<Eigen::VectorXd>(row.data() + 1, static_cast<Eigen::Index>(row.size()) - 1));
  }
  return path;
}

/// The positions of one motion, moved to those of another by a share.
Motion between(const Motion& from, const Motion& to, double share) {
  Motion motion = from;
  for (std::size_t i = 0; i < motion.positions.size(); ++i) {
    motion.positions[i] += share * (to.positions[i] - from.positions[i]);
  }
  return motion;
}

}  // namespace

const std::vector<std::string>& RandomMotions::kinds() {
  static const std::vector<std::string> kinds{"short", "long", "near", "colliding", "grazing", "cubic"};
  return kinds;
}

RandomMotions::RandomMotions(const MotionStage& stage, const std::string& path, double from, double to,
                             double share, std::uint64_t seed)
    : stage_(stage), path_(readPath(path, from, to)), share_(share), engine_(seed) {}

double RandomMotions::uniform(double lowest, double highest) {
  return lowest + (highest - lowest) * uniformUnit(engine_);
}

Eigen::VectorXd RandomMotions::drawPositions() {
  const Eigen::VectorXd& lower = stage_.chain().lower();
  const Eigen::VectorXd& upper = stage_.chain().upper();
  Eigen::VectorXd positions = lower;
  if (uniformUnit(engine_) < share_) {
    positions = path_[uniformIndex(engine_, static_cast<std::uint32_t>(path_.size()))];
    for (Eigen::Index i = 0; i < positions.size(); ++i) positions[i] += uniform(-kNoise, kNoise);
    positions = positions.cwiseMax(lower).cwiseMin(upper);
  } else {
    for (Eigen::Index i = 0; i < positions.size(); ++i) positions[i] = uniform(lower[i], upper[i]);
  }
  return positions;
}

bool RandomMotions::isClear(const Eigen::VectorXd& positions) const {
  MotionStage::Poses poses;
  stage_.place(positions, poses);
  return stage_.leastAt(poses, 1e-3) >= 1e-3;
}

bool RandomMotions::touches(const Motion& motion) const {
  // No motion of half a step brings bodies nearer than that.
  return sampleMotion(stage_, motion, {kCoarseStep, 0.0, true, 0.5 * kCoarseStep}).least <= 0.0;
}

Motion RandomMotions::drawAny(std::size_t waypoints) {
  Motion motion;
  while (motion.positions.size() < waypoints) {
    motion.times.push_back(motion.times.empty() ? 0.0 : motion.times.back() + uniform(0.5, 3.0));
    do {
      motion.positions.push_back(drawPositions());
      if (isClear(motion.positions.back())) break;
      motion.positions.pop_back();
    } while (true);
  }
  return motion;
}

Motion RandomMotions::drawNear(std::size_t waypoints) {
  for (int i = 0; i < kTries; ++i) {
    Motion motion = drawAny(waypoints);
    const double least = sampleMotion(stage_, motion, {kCoarseStep, 0.0, false, kNear}).least;
    if (least > 0.0 && least < kNear && !touches(motion)) return motion;
  }
  throw Error(stage_.name(), "no motion comes near without a contact", "choose another path");
}

Motion RandomMotions::drawColliding(std::size_t waypoints) {
  for (int i = 0; i < kTries; ++i) {
    Motion motion = drawAny(waypoints);
    if (touches(motion)) return motion;
  }
  throw Error(stage_.name(), "no motion touches anything", "choose another path");
}

Motion RandomMotions::drawGrazing(std::size_t waypoints) {
  const Motion clear = drawNear(waypoints);
  const Motion touching = drawColliding(waypoints);
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double share = 0.5 * (low + high);
    (touches(between(clear, touching, share)) ? high : low) = share;
  }
  const double more = std::pow(10.0, uniform(-6.0, -2.0));
  return between(clear, touching, std::clamp(high + (uniformUnit(engine_) < 0.5 ? more : -more), 0.0, 1.0));
}

Motion RandomMotions::draw(const std::string& kind) {
  Motion motion;
  const std::size_t few = 2 + uniformIndex(engine_, 3);
  if (kind == "short") {
    motion = drawAny(1);
    motion.times.push_back(uniform(0.2, 1.0));
    motion.positions.push_back(motion.positions[0]);
    for (Eigen::Index i = 0; i < motion.positions[1].size(); ++i) {
      motion.positions[1][i] += uniform(-kShortChange, kShortChange);
    }
  } else if (kind == "long") {
    motion = drawAny(few + 2);
  } else if (kind == "near") {
    motion = drawNear(few);
  } else if (kind == "colliding") {
    motion = drawColliding(few);
  } else if (kind == "grazing") {
    motion = drawGrazing(few);
  } else {
    motion = drawNear(few);
    for (const Eigen::VectorXd& positions : motion.positions) {
      motion.velocities.push_back(0.0 * positions);
      for (Eigen::Index i = 0; i < positions.size(); ++i)
        motion.velocities.back()[i] = uniform(-kVelocity, kVelocity);
    }
  }
  motion.kind = kind;
  return motion;
}

RandomMotions motionsOf(const MotionStage& stage, std::uint64_t seed) {
  // In the shelf's path the hand is before the shelf and in it from 0 to 8 s.
  if (stage.name() == "shelf") return {stage, "config/wam_path.csv", 0.0, 8.0, 0.8, seed};
  return {stage, "config/cell_path.csv", 0.0, 1e9, 0.5, seed};
}

}  // namespace concave_distance::benchmark
