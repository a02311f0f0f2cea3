#include "robot_at_rest.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>

#include "base/number_text.h"
#include "base/random_engine.h"
#include "concave_distance/kinematics/robot_kinematics.h"
#include "concave_distance/scene/broad_phase.h"
#include "distance/bound/certificate.h"
#include "distance/bound/solid_overlap.h"
#include "kinematics/wording.h"

namespace concave_distance::detail {
namespace {

constexpr double kCutoffShare = 0.2;  // of the robot's diagonal
constexpr std::size_t kRandomPoses = 20;
constexpr double kHalfTurn = 3.141592653589793;  // rad
constexpr std::uint64_t kSeed = 1;
constexpr std::size_t kMostNamed = 8;
constexpr std::size_t kMostTried = 100'000;  // pairs: those of a robot of 450 links
constexpr double kEnoughToBeApart = 0.9;     // of the distance: the proof ends with a bound above 0

using Poses = std::unordered_map<std::string, Eigen::Isometry3d>;

// Poses of the links in the frame of the root, by their frames.
Poses posesOf(const RobotKinematics& robot, const Eigen::VectorXd& positions) {
  RobotState state = robot.restState();
  robot.evaluate(positions, Eigen::Isometry3d::Identity(), state);
  Poses poses;
  for (std::size_t i = 0; i < robot.linkNames().size(); ++i) {
    poses.emplace(robot.linkNames()[i], state.world_from_link[i]);
  }
  return poses;
}

// Every number at random in its range: without one an angle within a turn, all else at rest.
Eigen::VectorXd randomPositions(const RobotKinematics& robot, RandomEngine& engine) {
  Eigen::VectorXd positions = robot.restPositions();
  const Eigen::VectorXd lowest = robot.lowestPositions();
  const Eigen::VectorXd highest = robot.highestPositions();
  for (Eigen::Index i = 0; i < positions.size(); ++i) {
    const double share = uniformUnit(engine);
    if (std::isfinite(lowest[i])) positions[i] = lowest[i] + share * (highest[i] - lowest[i]);
    if (!std::isfinite(lowest[i]) && robot.isAngle(static_cast<std::size_t>(i)))
      positions[i] = kHalfTurn * (2.0 * share - 1.0);
  }
  return positions;
}

const Eigen::Isometry3d* poseOf(const Poses& poses, const SceneBody& body) {
  const auto found = poses.find(body.frame);
  return found == poses.end() ? nullptr : &found->second;
}

bool overlap(const SceneBody& a, const SceneBody& b, const Poses& poses) {
  const Eigen::Isometry3d* pose_a = poseOf(poses, a);
  const Eigen::Isometry3d* pose_b = poseOf(poses, b);
  if (pose_a == nullptr || pose_b == nullptr) return false;
  const Eigen::Isometry3d a_from_b = pose_a->inverse() * *pose_b;
  if (distanceLowerBound(a.bounds, b.bounds, a_from_b) > 0.0) return false;
  CertificateWorkspace workspace;
  CertificateRequest request;
  request.relative_tolerance = kEnoughToBeApart;
  const DistanceCertificate proof =
      certifyDistance(*a.mesh, *b.mesh, a_from_b, nullptr, 0, request, workspace);
  if (proof.status == CertificateStatus::Penetrating) return true;
  WorkLimit no_limit;
  return isContained(*a.mesh, *b.mesh, a_from_b, no_limit).value_or(false);
}

double diagonalAt(const Scene& scene, const Poses& poses) {
  Eigen::AlignedBox3d box;
  for (const SceneBody& body : scene.bodies) {
    const Eigen::Isometry3d* pose = poseOf(poses, body);
    if (pose == nullptr) continue;
    const Eigen::AlignedBox3d& own = body.mesh->bounds();
    for (int corner = 0; corner < 8; ++corner) {
      box.extend(*pose * own.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
    }
  }
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

// The scene's largest robot counts, in its zero pose; without one the diagonal is 0.
double largestDiagonal(const Scene& scene) {
  double diagonal = 0.0;
  for (const auto& robot : scene.robots) {
    diagonal = std::max(diagonal, diagonalAt(scene, posesOf(*robot, robot->restPositions())));
  }
  return diagonal;
}

double automaticCutoff(double diagonal) {
  if (!(diagonal > 0.0) || !std::isfinite(diagonal)) return std::numeric_limits<double>::infinity();
  const double wanted = kCutoffShare * diagonal;
  const double unit = std::pow(10.0, std::floor(std::log10(wanted)) - 1.0);
  return std::ceil(wanted / unit) * unit;
}

// Places in `pairs`.
std::vector<std::size_t> pairsThatAlwaysOverlap(const Scene& scene, const PairList& pairs,
                                                const RobotKinematics& robot, const LoadProgress* progress) {
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].enabled) left.push_back(i);
  }
  RandomEngine engine(kSeed);
  for (std::size_t pose = 0; pose <= kRandomPoses && !left.empty(); ++pose) {
    if (progress != nullptr && progress->isStopped()) return {};
    const Poses poses = posesOf(robot, pose == 0 ? robot.restPositions() : randomPositions(robot, engine));
    std::vector<char> overlaps(left.size(), 0);
    tbb::parallel_for(std::size_t{0}, left.size(), [&](std::size_t i) {
      const ScenePair& pair = pairs[left[i]];
      overlaps[i] = overlap(scene.bodies[pair.body_a], scene.bodies[pair.body_b], poses) ? 1 : 0;
    });
    std::vector<std::size_t> still;
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (overlaps[i] != 0) still.push_back(left[i]);
    }
    left = std::move(still);
  }
  return left;
}

std::string describeOverlap(const PairList& all, const std::vector<std::size_t>& pairs) {
  std::string text = counted(pairs.size(), "pair") + (pairs.size() == 1 ? " overlaps" : " overlap") +
                     " in the zero pose and in " + std::to_string(kRandomPoses) +
                     " random poses, so that the distance is always 0: ";
  for (std::size_t i = 0; i < std::min(pairs.size(), kMostNamed); ++i) {
    text += (i == 0 ? "" : ", ") + all[pairs[i]].name;
  }
  return text + (pairs.size() > kMostNamed ? ", ..." : "");
}

std::string metres(double length) {
  return numberText(length) + " m";
}

std::vector<PairSettings*> settingsByRule(Scene& scene) {
  std::vector<PairSettings*> all{&scene.defaults.pairs};
  for (std::size_t i = 1; i < scene.rules.settings.size(); ++i) all.push_back(&scene.rules.settings[i]);
  return all;
}

bool watchesWithoutCutoff(const Scene& scene) {
  return std::any_of(scene.rules.list.begin(), scene.rules.list.end(), [&](const PairRule& rule) {
    return rule.is_watched && rule.is_enabled && !std::isfinite(settingsOf(scene, rule).tracker.cutoff);
  });
}

}  // namespace

void limitManyPairs(Scene& scene) {
  const std::size_t pairs = watchesWithoutCutoff(scene) ? countPairsByRule(scene) : 0;
  if (pairs <= kFewPairs) return;
  double diagonal = largestDiagonal(scene);
  for (const SceneBody& body : scene.bodies) diagonal = std::max(diagonal, body.mesh->diameter());
  const double cutoff = automaticCutoff(diagonal);
  if (!std::isfinite(cutoff)) return;
  for (PairSettings* settings : settingsByRule(scene)) {
    if (std::isfinite(settings->tracker.cutoff)) continue;
    // An alert needs the distance.
    settings->tracker.cutoff = std::max(cutoff, settings->warning_distance.value_or(0.0));
  }
  scene.notes.push_back("cutoff " + metres(cutoff) + " of the pairs without one, because there are " +
                        std::to_string(pairs) + ": a fifth of the largest diagonal of a robot or body, " +
                        metres(diagonal) + " (set cutoff in defaults; a pair that an entry names by both " +
                        "bodies keeps none)");
}

void setAutomaticCutoff(Scene& scene) {
  const double diagonal = largestDiagonal(scene);
  const double cutoff = automaticCutoff(diagonal);
  scene.automatic_cutoff = cutoff;
  scene.defaults.pairs.tracker.cutoff = cutoff;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    scene.pairs.edit(i).settings.tracker.cutoff = cutoff;
  }
  for (PairSettings& settings : scene.rules.settings) settings.tracker.cutoff = cutoff;
  if (!std::isfinite(cutoff)) return;
  scene.notes.push_back("cutoff " + metres(cutoff) + ", a fifth of the robot's diagonal of " +
                        metres(diagonal) + " in its zero pose: pairs farther apart have only a lower bound " +
                        "(set ~cutoff to change it; none: no cutoff)");
}

// Without this warning an empty robot would not be noticed.
void warnOfNoGeometry(Scene& scene, const RobotDescription& robot, GeometrySource geometry) {
  if (!scene.bodies.empty() || !scene.problems.empty()) return;
  const bool collision = geometry == GeometrySource::Collision;
  const std::string other = collision ? "visual" : "collision";
  std::string text =
      std::string("no link of the robot has ") + (collision ? "collision" : "visual") + " geometry";
  if (robot.links_with_other_geometry > 0) {
    text += ", but " + counted(robot.links_with_other_geometry, "link") + " with " + other +
            " geometry: set ~geometry to " + other;
  }
  scene.warnings.push_back(text);
}

std::vector<std::pair<std::string, std::string>> reportOverlappingPairs(Scene& scene,
                                                                        const SceneLoadOptions& options) {
  if (scene.robots.empty()) return {};
  const PairList all = allPairs(scene, kMostTried);
  const std::vector<std::size_t> pairs =
      pairsThatAlwaysOverlap(scene, all, *scene.robots.front(), options.progress);
  if (pairs.empty()) return {};
  const std::string text = describeOverlap(all, pairs);
  if (!options.skip_overlapping_pairs) {
    scene.warnings.push_back(text + ". If this is intended, disable them in its SRDF, or set " +
                             "~skip_overlapping_pairs");
    return {};
  }
  scene.notes.push_back(text + ". They are left out because ~skip_overlapping_pairs is set");
  auto filtered =
      scene.rules.filtered ? *scene.rules.filtered : std::vector<std::pair<std::uint64_t, std::uint64_t>>();
  std::vector<std::pair<std::string, std::string>> left_out;
  for (const std::size_t pair : pairs) {
    const SceneBody& a = scene.bodies[all[pair].body_a];
    const SceneBody& b = scene.bodies[all[pair].body_b];
    filtered.emplace_back(std::minmax(a.serial, b.serial));
    left_out.emplace_back(a.name, b.name);
  }
  std::sort(filtered.begin(), filtered.end());
  scene.rules.filtered = std::make_shared<const decltype(filtered)>(std::move(filtered));
  return left_out;
}

}  // namespace concave_distance::detail
