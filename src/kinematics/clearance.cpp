#include "concave_distance/kinematics/clearance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "base/number_text.h"
#include "clearance_search.h"
#include "concave_distance/base/error.h"
#include "concave_distance/scene/pair_rules.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "first_below_search.h"
#include "motion_paths.h"

namespace concave_distance {
namespace {

using detail::BodyPath;
using detail::ClearanceBody;
using detail::ClearancePair;
using detail::ClearanceSearch;
using detail::FirstBelowSearch;
using detail::GapSampler;
using detail::MotionPaths;

using Clock = WorkLimit::Clock;

void requireParameters(const ClearanceParameters& parameters) {
  const auto require = [](bool is_right, const char* name, double value, const char* allowed) {
    if (!is_right) throw Error(name, "the value is " + numberText(value), allowed);
  };
  require(parameters.tolerance > 0.0 && std::isfinite(parameters.tolerance), "tolerance",
          parameters.tolerance, "allowed: metres above 0");
  require(parameters.time_budget > 0.0, "time_budget", parameters.time_budget, "allowed: seconds above 0");
  require(parameters.sample_limit > 0, "sample_limit", 0.0, "allowed: 1 and more");
  if (!parameters.threshold) return;
  require(*parameters.threshold >= 0.0 && std::isfinite(*parameters.threshold), "threshold",
          *parameters.threshold, "allowed: metres from 0");
}

/// Body A and body B of an enabled pair.
using WatchedPair = std::pair<std::size_t, std::size_t>;

std::optional<WatchedPair> watchedPair(const Scene& scene, std::size_t body, std::size_t other) {
  if (const auto listed = scene.pairs.find(body, other)) {
    const ScenePair& pair = scene.pairs[*listed];
    return pair.enabled ? std::optional<WatchedPair>({pair.body_a, pair.body_b}) : std::nullopt;
  }
  const PairRule* rule = ruleOf(scene, body, other);
  if (rule == nullptr || !rule->is_enabled) return std::nullopt;
  return rule->ordered(body, other);
}

/// Finds the pairs that a motion moves, and what their bodies are solved by.
class MovedPairs {
 public:
  MovedPairs(const Scene& scene, const SceneKinematics& joints, const MotionPaths& paths)
      : scene_(scene), joints_(joints), paths_(paths) {}

  std::vector<ClearancePair> find(std::vector<std::size_t>& not_located) {
    const std::size_t count = scene_.bodies.size();
    std::vector<bool> is_missed(count, false);
    for (std::size_t i = 0; i < count; ++i) {
      if (!isMoved(i)) continue;
      for (std::size_t j = 0; j < count; ++j) {
        if (j == i || (j < i && isMoved(j))) continue;
        const auto [earlier, later] = std::minmax(i, j);
        const bool are_located = paths_.bodies[i] && paths_.bodies[j];
        if (are_located) {
          add(earlier, later);
        } else if (watchedPair(scene_, earlier, later)) {
          if (!paths_.bodies[i]) is_missed[i] = true;
          if (!paths_.bodies[j]) is_missed[j] = true;
        }
      }
    }
    for (std::size_t body = 0; body < count; ++body) {
      if (is_missed[body]) not_located.push_back(body);
    }
    std::sort(pairs_.begin(), pairs_.end(), [](const ClearancePair& left, const ClearancePair& right) {
      return std::pair(left.body_a, left.body_b) < std::pair(right.body_a, right.body_b);
    });
    return std::move(pairs_);
  }

 private:
  bool isMoved(std::size_t body) const {
    const auto& path = paths_.bodies[body];
    return path ? !path->elements.empty() : joints_.isMoved(body);
  }

  void add(std::size_t earlier, std::size_t later) {
    const BodyPath& first = *paths_.bodies[earlier];
    const BodyPath& second = *paths_.bodies[later];
    if (first.elements == second.elements) return;
    const auto watched = watchedPair(scene_, earlier, later);
    if (!watched) return;
    ClearancePair pair{watched->first,
                       watched->second,
                       &bodyOf(watched->first),
                       &bodyOf(watched->second),
                       scene_.bodies[earlier].margin + scene_.bodies[later].margin,
                       0.0,
                       {paths_, bodyOf(watched->first).path, bodyOf(watched->second).path}};
    const auto reach = [](const ClearanceBody& body) {
      return body.bounds.centre.norm() + body.bounds.radius;
    };
    pair.error = pair.path.rounding(paths_, reach(*pair.a) + reach(*pair.b));
    pairs_.push_back(std::move(pair));
  }

  const ClearanceBody& bodyOf(std::size_t index) {
    const auto [place, is_new] = bodies_.try_emplace(index);
    ClearanceBody& body = place->second;
    if (!is_new) return body;
    const std::shared_ptr<const BodyMesh>& mesh = scene_.bodies[index].mesh;
    if (mesh == nullptr) {
      throw Error("body '" + scene_.bodies[index].name + "'", "it has no mesh", "load the scene with meshes");
    }
    const RecentredBody& recentred = mesh->recentred();
    body.mesh = recentred.mesh ? recentred.mesh : mesh;
    body.origin = recentred.origin;
    body.bounds = boundsOf(*body.mesh);
    body.corners = detail::cornersOf(body.bounds);
    body.path = *paths_.bodies[index];
    body.path.tail = body.path.tail * Eigen::Translation3d(body.origin);
    return body;
  }

  const Scene& scene_;
  const SceneKinematics& joints_;
  const MotionPaths& paths_;
  std::map<std::size_t, ClearanceBody> bodies_;  ///< by the place in the scene; the pairs point to them
  std::vector<ClearancePair> pairs_;

 public:
  /// Keeps the bodies of find() alive.
  std::map<std::size_t, ClearanceBody> takeBodies() { return std::move(bodies_); }
};

TrackerParameters settingsFor(const Scene& scene, const ClearancePair& pair) {
  const auto found = pairOf(scene, pair.body_a, pair.body_b);
  TrackerParameters settings = found ? found->settings.tracker : scene.defaults.pairs.tracker;
  settings.accuracy = AccuracyLevel::Certified;
  settings.niches_wanted = true;
  return withMargins(settings, scene.bodies[pair.body_a], scene.bodies[pair.body_b]);
}

void describeLeast(const Scene& scene, const MotionPaths& paths, const ClearancePair& pair,
                   const detail::ClearanceSample& sample, const ClearanceParameters& parameters,
                   ClearanceResult& result) {
  const detail::MotionMoment at = detail::momentAt(sample.moment, paths.segmentCount());
  const Eigen::Isometry3d world_from_a = detail::RelativePath::worldFrom(paths, pair.a->path, at);
  result.time = paths.timeOf(sample.moment);
  result.body_a = pair.body_a;
  result.body_b = pair.body_b;
  result.distance = sample.distance;
  Eigen::Vector3d point_a = sample.point_a_in_a;
  Eigen::Vector3d point_b = sample.point_b_in_a;
  if (sample.distance > 0.0) {
    const Eigen::Vector3d normal = (point_b - point_a).normalized();
    point_a += scene.bodies[pair.body_a].margin * normal;
    point_b -= scene.bodies[pair.body_b].margin * normal;
  }
  result.point_a = world_from_a * point_a;
  result.point_b = world_from_a * point_b;
  result.world_from_a = world_from_a * Eigen::Translation3d(-pair.a->origin);
  if (!parameters.niches) return;
  detail::RelativePose pose;
  pair.path.evaluate(paths, at, pose);
  const Eigen::Isometry3d a_from_b =
      Eigen::Translation3d(pair.a->origin) * pose.a_from_b * Eigen::Translation3d(-pair.b->origin);
  const SceneBody& a = scene.bodies[pair.body_a];
  const SceneBody& b = scene.bodies[pair.body_b];
  result.solution =
      solveOnce(a.pairLabel() + "/" + b.pairLabel(), a.mesh, b.mesh, settingsFor(scene, pair), a_from_b);
}

void describePairs(const MotionPaths& paths, const std::vector<ClearancePair>& pairs,
                   const ClearanceSearch& search, ClearanceResult& result) {
  const std::vector<ClearanceSearch::PairLeast> found = search.pairs();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    PairClearance& pair = result.pairs.emplace_back();
    pair.body_a = pairs[i].body_a;
    pair.body_b = pairs[i].body_b;
    pair.lower_bound = found[i].lower;
    if (!std::isfinite(found[i].distance)) continue;
    pair.distance = found[i].distance;
    pair.time = paths.timeOf(found[i].moment);
  }
}

void describeFirst(const MotionPaths& paths, const std::vector<ClearancePair>& pairs,
                   const FirstBelowSearch::First& first, ClearanceResult& result) {
  FirstBelow& below = result.first_below.emplace();
  below.proven_until = paths.timeOf(first.proven_until);
  if (!first.moment) return;
  below.time = paths.timeOf(*first.moment);
  below.body_a = pairs[first.pair].body_a;
  below.body_b = pairs[first.pair].body_b;
}

ClearanceResult search(const Scene& scene, const SceneKinematics& joints, const MotionPaths& paths,
                       const ClearanceParameters& parameters, Clock::time_point start) {
  ClearanceResult result;
  result.outside_limits = paths.outside_limits;
  result.velocities_ignored = paths.velocities_ignored;
  MovedPairs moved(scene, joints, paths);
  const std::vector<ClearancePair> pairs = moved.find(result.not_located);
  const std::map<std::size_t, ClearanceBody> bodies = moved.takeBodies();
  if (!pairs.empty()) {
    GapSampler sampler(
        paths, pairs, parameters,
        WorkLimit(start, parameters.time_budget, std::numeric_limits<std::size_t>::max(), parameters.stop));
    ClearanceSearch search(sampler);
    search.findLeast();
    result.lower_bound = search.lower();
    describePairs(paths, pairs, search, result);
    const auto least = search.least();
    if (least) describeLeast(scene, paths, pairs[least->pair], least->sample, parameters, result);
    const bool is_proven = least && result.lower_bound >= result.distance - parameters.tolerance;
    result.status = least && result.distance <= 0.0 ? ClearanceStatus::Penetrating
                    : search.isCut() || !is_proven  ? ClearanceStatus::BudgetExhausted
                                                    : ClearanceStatus::Ok;
    // Contact is where a distance is 0, and nothing is less.
    const double contact = std::numeric_limits<double>::min();
    const bool is_contact = result.status == ClearanceStatus::Penetrating;
    if (parameters.threshold || is_contact) {
      FirstBelowSearch first(sampler, std::max(contact, parameters.threshold.value_or(0.0)));
      describeFirst(paths, pairs, first.find(search.gapsBelow(), search.progress()), result);
    }
    result.queries = sampler.queries();
    result.box_queries = sampler.boxQueries();
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

}  // namespace

std::string_view toString(ClearanceStatus status) {
  switch (status) {
    case ClearanceStatus::Ok:
      return "ok";
    case ClearanceStatus::Penetrating:
      return "penetrating";
    case ClearanceStatus::BudgetExhausted:
      return "budget_exhausted";
    case ClearanceStatus::NoPairs:
      return "no_pairs";
  }
  return "unknown";
}

ClearanceResult findClearance(const Scene& scene, const SceneKinematics& joints, const SceneState& state,
                              const JointMotion& motion, const ClearanceParameters& parameters) {
  const auto start = Clock::now();
  requireParameters(parameters);
  return search(scene, joints, detail::pathsOf(joints, state, motion), parameters, start);
}

ClearanceResult findClearance(const Scene& scene, const SceneKinematics& joints, const SceneState& state,
                              const PoseMotion& motion, const ClearanceParameters& parameters) {
  const auto start = Clock::now();
  requireParameters(parameters);
  const MotionPaths paths = detail::pathsOf(scene, joints, state, motion);
  // A body that moves is no longer rigid with those that share its frame.
  Scene moved = scene;
  const std::size_t body = *scene.findBody(motion.body);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!paths.bodies[i] || paths.bodies[i]->elements.empty()) continue;
    moved.bodies.edit(i).carrier = scene.bodies[body].serial;
  }
  return search(moved, joints, paths, parameters, start);
}

}  // namespace concave_distance
