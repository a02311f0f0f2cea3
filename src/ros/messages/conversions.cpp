#include "conversions.h"

#include <tf2_eigen/tf2_eigen.h>

#include <cmath>

#include "concave_distance/search/prepare_search.h"
#include "mesh/surface/mesh_topology.h"

namespace concave_distance {
namespace {

static_assert(Niche::KIND_POINT == static_cast<int>(NicheKind::Point));
static_assert(Niche::KIND_SEGMENT == static_cast<int>(NicheKind::Segment));
static_assert(Niche::KIND_PATCH == static_cast<int>(NicheKind::Patch));
static_assert(Niche::OUTWARD == static_cast<int>(Outwardness::Outward));
static_assert(Niche::THROUGH_MATERIAL == static_cast<int>(Outwardness::ThroughMaterial));
static_assert(Niche::UNKNOWN == static_cast<int>(Outwardness::Unknown));
static_assert(NicheChange::BIRTH == static_cast<int>(NicheEvent::Kind::Birth));
static_assert(Niche::SIGNED_NOT_ASKED == static_cast<int>(SignedState::NotAsked));
static_assert(Niche::SIGNED_KNOWN == static_cast<int>(SignedState::Known));
static_assert(Niche::SIGNED_OPEN_SURFACE == static_cast<int>(SignedState::OpenSurface));
static_assert(Niche::SIGNED_CROSSED_SHELLS == static_cast<int>(SignedState::CrossedShells));
static_assert(Niche::SIGNED_NO_CLOSED_FORM == static_cast<int>(SignedState::NoClosedForm));
static_assert(Niche::SIGNED_UNFINISHED == static_cast<int>(SignedState::Unfinished));
static_assert(NicheChange::DEATH == static_cast<int>(NicheEvent::Kind::Death));
static_assert(NicheChange::MERGE == static_cast<int>(NicheEvent::Kind::Merge));

Niche toNiche(const PairHeading& heading, const TrackedNiche& niche) {
  Niche message;
  message.id = niche.id;
  message.distance = niche.distance;
  message.point_a = toPoint(heading.reference_from_a * niche.point_a_in_a);
  message.point_b = toPoint(heading.reference_from_a * niche.point_b_in_a);
  message.normal = toVector(heading.reference_from_a.linear() * niche.normal_in_a);
  message.has_closing_speed = !std::isnan(niche.closing_speed);
  message.closing_speed = niche.closing_speed;
  message.kind = static_cast<std::uint8_t>(niche.kind);
  message.extent = niche.extent;
  message.outwardness = static_cast<std::uint8_t>(niche.outward);
  message.visible = static_cast<std::uint8_t>(niche.visible);
  message.origin = static_cast<std::uint8_t>(niche.origin);
  message.has_prominence = !std::isnan(niche.prominence);
  message.prominence = niche.prominence;
  message.proven_local_minimum = static_cast<std::uint8_t>(niche.proven_local_minimum);
  message.birth_cycle = niche.birth_cycle;
  message.has_signed_distance = !std::isnan(niche.signed_distance);
  message.signed_distance = niche.signed_distance;
  const SignedPlace& place = niche.signed_place;
  message.signed_state = static_cast<std::uint8_t>(place.state);
  message.signed_point_a = toPoint(heading.reference_from_a * place.point_a_in_a);
  message.signed_point_b = toPoint(heading.reference_from_a * place.point_b_in_a);
  message.signed_pivot = toPoint(heading.reference_from_a * place.pivot_in_a);
  message.signed_gradient = toVector(heading.reference_from_a.linear() * place.gradient_in_a);
  message.signed_since_cycle = place.since_cycle;
  return message;
}

NicheChange toChange(const NicheEvent& event) {
  NicheChange message;
  message.kind = static_cast<std::uint8_t>(event.kind);
  message.id = event.id;
  message.into_id = event.kind == NicheEvent::Kind::Merge ? event.into_id : 0;
  return message;
}

}  // namespace

geometry_msgs::Point toPoint(const Eigen::Vector3d& point) {
  return tf2::toMsg(point);
}

geometry_msgs::Vector3 toVector(const Eigen::Vector3d& vector) {
  geometry_msgs::Vector3 message;
  return tf2::toMsg(vector, message);
}

geometry_msgs::Quaternion toQuaternion(const Eigen::Quaterniond& rotation) {
  return tf2::toMsg(rotation);
}

geometry_msgs::Pose toPose(const Eigen::Isometry3d& pose) {
  geometry_msgs::Pose message;
  message.position = toPoint(pose.translation());
  message.orientation = toQuaternion(Eigen::Quaterniond(pose.linear()));
  return message;
}

geometry_msgs::Wrench toWrench(const Wrench& wrench) {
  geometry_msgs::Wrench message;
  message.force = toVector(wrench.force);
  message.torque = toVector(wrench.torque);
  return message;
}

PairStatus toStatus(SolveStatus status) {
  PairStatus message;
  switch (status) {
    case SolveStatus::Ok:
      message.code = PairStatus::OK;
      return message;
    case SolveStatus::Penetrating:
      message.code = PairStatus::PENETRATING;
      break;
    case SolveStatus::InvalidPose:
      message.code = PairStatus::INVALID_POSE;
      break;
    case SolveStatus::BudgetExhausted:
      message.code = PairStatus::BUDGET_EXHAUSTED;
      break;
    case SolveStatus::WithinTolerance:
      message.code = PairStatus::WITHIN_TOLERANCE;
      break;
    case SolveStatus::MemoryExhausted:
      message.code = PairStatus::MEMORY_EXHAUSTED;
      break;
  }
  message.message = std::string(toString(status));
  return message;
}

PairStatus toStatus(TransformStatus status, const std::string& message) {
  PairStatus made;
  made.message = message;
  switch (status) {
    case TransformStatus::Ok:
      made.code = PairStatus::OK;
      break;
    case TransformStatus::Missing:
      made.code = PairStatus::MISSING_TRANSFORM;
      break;
    case TransformStatus::Stale:
      made.code = PairStatus::STALE_TRANSFORM;
      break;
  }
  return made;
}

bool hasDistance(const PairStatus& status) {
  switch (status.code) {
    case PairStatus::OK:
    case PairStatus::PENETRATING:
    case PairStatus::WITHIN_TOLERANCE:
    case PairStatus::BUDGET_EXHAUSTED:
    case PairStatus::MEMORY_EXHAUSTED:
      return true;
    default:
      return false;
  }
}

std::uint8_t toAccuracyCode(AccuracyLevel level) {
  switch (level) {
    case AccuracyLevel::Nodes:
      return PairDistance::ACCURACY_NODES;
    case AccuracyLevel::Refined:
      return PairDistance::ACCURACY_REFINED;
    case AccuracyLevel::Certified:
      return PairDistance::ACCURACY_CERTIFIED;
  }
  return 0;
}

PairDistance emptyDistance(const PairHeading& heading, const PairStatus& status) {
  auto message = headedMessage<PairDistance>(heading, status);
  message.accuracy = toAccuracyCode(heading.accuracy);
  message.distance = message.lower_bound = message.surface_distance = message.closing_speed = kNotComputed;
  message.signed_distance = kNotComputed;
  message.cost.solve_time = kNotComputed;
  message.point_a = message.point_b = toPoint(Eigen::Vector3d::Constant(kNotComputed));
  message.normal = toVector(Eigen::Vector3d::Constant(kNotComputed));
  message.warning = static_cast<std::uint8_t>(heading.warning);
  return message;
}

PairDistance toDistance(const PairHeading& heading, const PairSolution& solution) {
  PairDistance message = emptyDistance(heading, toStatus(solution.status));
  message.accuracy = toAccuracyCode(solution.accuracy);
  message.cost.solve_time = solution.solve_seconds;
  message.cost.evaluations = solution.cost.evaluations;
  message.cost.generations = solution.cost.generations;
  message.cost.inherited = solution.cost.inherited;
  message.cost.children = solution.cost.children;
  message.cost.box_bounds = solution.proof_cost.box_bounds;
  message.cost.triangle_pairs = solution.proof_cost.triangle_pairs;
  if (std::isnan(solution.distance)) {
    if (solution.status == SolveStatus::Ok) {
      message.status.code = PairStatus::NOT_FOUND;
      message.status.message = "the search met no minimum that leaves the bodies outwards";
    }
    return message;
  }
  message.has_distance = 1;
  message.distance = solution.distance;
  message.has_lower_bound = !std::isnan(solution.lower_bound);
  message.lower_bound = solution.lower_bound;
  message.has_surface_distance = !std::isnan(solution.surface_distance);
  message.surface_distance = solution.surface_distance;
  message.has_signed_distance = !std::isnan(solution.signed_distance);
  message.signed_distance = solution.signed_distance;
  message.has_meeting_triangles = solution.meeting_triangles.has_value();
  if (solution.meeting_triangles) {
    message.triangle_a = solution.meeting_triangles->a.value;
    message.triangle_b = solution.meeting_triangles->b.value;
  }
  message.has_points = solution.point_a_in_a.allFinite() && solution.point_b_in_a.allFinite();
  if (message.has_points == 0) {
    return message;
  }
  message.point_a = toPoint(heading.reference_from_a * solution.point_a_in_a);
  message.point_b = toPoint(heading.reference_from_a * solution.point_b_in_a);
  const Eigen::Vector3d between = solution.point_b_in_a - solution.point_a_in_a;
  if (between.squaredNorm() > 0.0) {
    message.normal = toVector(heading.reference_from_a.linear() * between.normalized());
  }
  if (solution.normal_in_a.allFinite()) {
    message.normal = toVector(heading.reference_from_a.linear() * solution.normal_in_a);
  }
  message.has_closing_speed = !std::isnan(solution.closing_speed);
  message.closing_speed = solution.closing_speed;
  if (heading.with_niches && !solution.niches.empty() &&
      solution.niches.front().distance == solution.distance) {
    message.nearest_niche_id = solution.niches.front().id;
  }
  return message;
}

PairNiches emptyNiches(const PairHeading& heading, const PairStatus& status) {
  PairNiches message;
  message.nearest = emptyDistance(heading, status);
  message.header = message.nearest.header;
  message.solve_time = kNotComputed;
  return message;
}

PairNiches toNiches(const PairHeading& heading, const PairSolution& solution) {
  PairNiches message;
  message.nearest = toDistance(heading, solution);
  message.header = message.nearest.header;
  message.cycle = solution.cycle;
  message.warm = static_cast<std::uint8_t>(solution.warm);
  message.search_miss = static_cast<std::uint8_t>(solution.search_miss);
  message.solve_time = solution.solve_seconds;
  message.evaluations = solution.cost.evaluations;
  if (!heading.with_niches) {
    return message;
  }
  message.niches_complete = static_cast<std::uint8_t>(solution.niches_complete);
  message.niches_cut = static_cast<std::uint8_t>(solution.niches_cut);
  message.niches_beyond_cutoff = solution.niches_beyond_cutoff;
  message.niches.reserve(solution.niches.size());
  for (const TrackedNiche& niche : solution.niches) {
    message.niches.push_back(toNiche(heading, niche));
  }
  message.changes.reserve(solution.events.size());
  for (const NicheEvent& event : solution.events) {
    message.changes.push_back(toChange(event));
  }
  return message;
}

BodyInfo toBodyInfo(const SceneBody& body) {
  BodyInfo message;
  message.name = body.name;
  message.frame_id = body.frame;
  message.source = body.source;
  message.vertices = static_cast<std::uint32_t>(body.mesh->surface().vertexCount());
  message.triangles = static_cast<std::uint32_t>(body.mesh->surface().triangleCount());
  const SearchPreparation prepared = searchPreparationOf(body.mesh->asSolved());
  message.grid_nodes = static_cast<std::uint32_t>(prepared.grid_nodes);
  message.max_edge_length = prepared.max_edge_length;
  message.diameter = body.mesh->diameter();
  message.closed = static_cast<std::uint8_t>(body.mesh->topology().allShellsClosed());
  message.in_robot_model = static_cast<std::uint8_t>(body.in_robot_model);
  message.repair = body.repair.summary();
  message.margin = body.margin;
  message.pose = toPose(body.frame_from_body);
  if (body.attachment) message.attached_to = body.attachment->parent;
  return message;
}

PairInfo toPairInfo(const Scene& scene, const ScenePair& pair) {
  PairInfo message;
  message.name = pair.name;
  message.body_a = scene.bodies[pair.body_a].name;
  message.body_b = scene.bodies[pair.body_b].name;
  message.enabled = static_cast<std::uint8_t>(pair.enabled);
  message.accuracy = toAccuracyCode(pair.settings.tracker.accuracy);
  message.cutoff = pair.settings.tracker.cutoff;
  message.has_warning_distance = static_cast<std::uint8_t>(pair.settings.warning_distance.has_value());
  message.warning_distance = pair.settings.warning_distance.value_or(kNotComputed);
  message.warning_hysteresis = pair.settings.warning_hysteresis;
  return message;
}

}  // namespace concave_distance
