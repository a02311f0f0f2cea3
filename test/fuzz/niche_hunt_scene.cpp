#include "fuzz/niche_hunt_scene.h"

#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "concave_distance/tracking/pair_tracker.h"
#include "fuzz/niche_comparison.h"
#include "support/body_pairs.h"

namespace concave_distance::test {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr const char* kPairName = "niche_hunt";
/// Poses that are tried around one where the lists differ.
constexpr int kNearbyPoses = 8;

std::string described(const TrackerParameters& parameters) {
  std::ostringstream text;
  text.precision(17);
  text << "cutoff " << parameters.cutoff << " largest_niche_count " << parameters.largest_niche_count
       << " hidden " << parameters.hidden << " prominence_limit " << parameters.prominence_limit
       << " least_prominence " << parameters.least_prominence << " niches " << parameters.niches_wanted
       << " margin_a " << parameters.margin_a << " margin_b " << parameters.margin_b;
  return text.str();
}

/// Changes about one of five settings.
void toggle(RandomEngine& engine, double size, TrackerParameters& parameters) {
  const auto changes = [&] { return uniformIndex(engine, 5) == 0; };
  if (changes()) parameters.hidden = !parameters.hidden;
  if (changes())
    parameters.largest_niche_count = uniformIndex(engine, 2) == 0 ? 64 : 1 + uniformIndex(engine, 3);
  if (changes())
    parameters.cutoff = uniformIndex(engine, 2) == 0 ? kUnlimited : uniformIn(engine, 0.05, 1.5) * size;
  if (changes()) {
    const double limits[] = {0.0, 0.5, 4.0, kUnlimited};
    parameters.prominence_limit = limits[uniformIndex(engine, 4)];
  }
  if (changes())
    parameters.least_prominence = uniformIndex(engine, 3) == 0 ? uniformIn(engine, 1e-3, 0.3) : 1e-2;
  if (changes()) parameters.niches_wanted = !parameters.niches_wanted;
}

/// Margins of none, one or both bodies, up to a third of their size or twice the gap.
void drawMargins(RandomEngine& engine, double size, double gap, TrackerParameters& parameters) {
  if (uniformIndex(engine, 3) == 0) return;
  const double most = uniformIndex(engine, 2) == 0 ? 0.3 * size : 2.0 * gap;
  parameters.margin_a = uniformIndex(engine, 3) == 0 ? 0.0 : uniformIn(engine, 0.0, 0.5 * most);
  parameters.margin_b = uniformIndex(engine, 3) == 0 ? 0.0 : uniformIn(engine, 0.0, 0.5 * most);
}

/// Up to 4 ulp off in every number.
Eigen::Isometry3d nearby(RandomEngine& engine, const Eigen::Isometry3d& pose) {
  Eigen::Isometry3d moved = pose;
  const Eigen::Vector3d turn = uniformInCube(engine, std::ldexp(4.0, -52));
  Eigen::Matrix3d skew;
  skew << 0, -turn.z(), turn.y(), turn.z(), 0, -turn.x(), -turn.y(), turn.x(), 0;
  moved.linear() = pose.linear() + skew * pose.linear();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    double& coordinate = moved.translation()[axis];
    const double ulp = std::ldexp(std::max(std::abs(coordinate), pose.translation().norm()), -52);
    coordinate += uniformIn(engine, -4.0, 4.0) * ulp;
  }
  return moved;
}

/// Whether the enumeration gives this answer at a pose nearby.
bool isBorderline(const WideBody& a, const WideBody& b, const PairSolution& solution,
                  const TrackerParameters& parameters, std::uint64_t seed) {
  RandomEngine engine(seed);
  for (int i = 0; i < kNearbyPoses; ++i) {
    const NicheEnumeration moved(a, b, nearby(engine, solution.a_from_b));
    if (complaintAbout(solution, parameters, moved).empty()) return true;
  }
  return false;
}

}  // namespace

NicheScene drawNicheScene(const NicheFamily& family, std::uint64_t seed, std::uint64_t scene) {
  RandomEngine engine(streamSeed(seed, family.name, scene));
  return family.draw(engine);
}

NicheHuntResult huntScene(const NicheScene& scene, std::uint64_t seed, bool with_margins) {
  NicheHuntResult result;
  const auto a = makeBody(scene.a);
  const auto b = makeBody(scene.b);
  const WideBody wide_a(scene.a);
  const WideBody wide_b(scene.b);
  RandomEngine engine(streamSeed(seed, kPairName, 0));
  RandomEngine margins(streamSeed(seed, "margins", 0));
  const double size = 0.5 * (a->diameter() + b->diameter());
  TrackerParameters parameters;
  std::optional<PairTracker> tracker;
  tracker.emplace(kPairName, a, b, parameters);
  PairSolution tracked;
  for (std::size_t cycle = 0; cycle < scene.poses.size(); ++cycle) {
    const Eigen::Isometry3d& pose = scene.poses[cycle];
    const NicheEnumeration enumeration(wide_a, wide_b, pose);
    ++result.poses;
    toggle(engine, size, parameters);
    if (with_margins) drawMargins(margins, size, static_cast<double>(enumeration.least()), parameters);
    parameters.hidden = parameters.hidden && !scene.shells_cross;
    const PairSolution cold = solveOnce(kPairName, a, b, parameters, pose);
    result.niches += cold.niches.size();
    const auto check = [&](const PairSolution& solution, bool is_tracked) {
      const std::string complaint = complaintAbout(solution, parameters, enumeration, scene.shells_cross);
      if (complaint.empty()) return true;
      if (isBorderline(wide_a, wide_b, solution, parameters, seed)) {
        ++result.borderline;
        return true;
      }
      result.failures.push_back({cycle, is_tracked, described(parameters), complaint});
      return false;
    };
    const bool is_cold_right = check(cold, false);
    if (!tracker) continue;
    tracker->setParameters(parameters);
    tracker->update(pose, 0.01 * static_cast<double>(cycle), tracked);
    // What is wrong cold is not held against the tracker, and what it keeps is not looked at any more.
    if (!is_cold_right || !check(tracked, true)) tracker.reset();
  }
  return result;
}

}  // namespace concave_distance::test
