#include "state_conversions.h"

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "loading/saved_operations.h"
#include "ros/messages/conversions.h"
#include "scene/journal.h"

namespace concave_distance {
namespace {

constexpr std::size_t kMostAllowed = 1000;  // pairs listed one by one

using Names = std::unordered_map<std::uint64_t, std::string>;  // of bodies, by serial

// In the order of the scene.
std::vector<std::string> namesOf(const Scene& scene, const std::unordered_set<std::uint64_t>& serials) {
  std::vector<std::string> names;
  for (const SceneBody& body : scene.bodies) {
    if (serials.count(body.serial) != 0) names.push_back(body.name);
  }
  return names;
}

shape_msgs::SolidPrimitive toPrimitive(const BodyShape& shape) {
  using shape_msgs::SolidPrimitive;
  SolidPrimitive message;
  message.dimensions = shape.dimensions;
  if (shape.primitive == "box" || shape.primitive == "sphere") {
    message.type = shape.primitive == "box" ? SolidPrimitive::BOX : SolidPrimitive::SPHERE;
    return message;
  }
  message.type = SceneOperation::CAPSULE;
  if (shape.primitive == "cylinder") message.type = SolidPrimitive::CYLINDER;
  if (shape.primitive == "cone") message.type = SolidPrimitive::CONE;
  std::reverse(message.dimensions.begin(), message.dimensions.end());  // the height is the first
  return message;
}

shape_msgs::Mesh toMesh(const TriangleSoup& soup) {
  shape_msgs::Mesh message;
  for (const Eigen::Vector3d& vertex : soup.vertices) message.vertices.push_back(toPoint(vertex));
  for (const auto& corners : soup.triangles) {
    shape_msgs::MeshTriangle& triangle = message.triangles.emplace_back();
    std::copy(corners.begin(), corners.end(), triangle.vertex_indices.begin());
  }
  return message;
}

void addShape(const BodyShape& shape, const std::string& base_folder, bool with_meshes,
              SceneOperation& message) {
  const geometry_msgs::Pose pose = toPose(shape.frame_from_geometry);
  if (!shape.primitive.empty()) {
    message.primitives.push_back(toPrimitive(shape));
    message.primitive_poses.push_back(pose);
  } else if (!shape.triangles) {
    message.mesh_resources.push_back(detail::savedResource(shape.mesh_resource, base_folder));
    message.mesh_resource_poses.push_back(pose);
    message.mesh_resource_scales.push_back(toVector(shape.scale));
  } else if (with_meshes) {
    message.meshes.push_back(toMesh(*shape.triangles));
    message.mesh_poses.push_back(pose);
  }
}

SceneOperation toAddition(const SceneBody& body, bool with_meshes) {
  SceneOperation message;
  message.operation = SceneOperation::ADD;
  message.body = body.name;
  message.frame_id = body.frame;
  message.pose = toPose(body.frame_from_body);
  message.margin = body.margin;
  message.color.r = static_cast<float>(body.colour[0]);
  message.color.g = static_cast<float>(body.colour[1]);
  message.color.b = static_cast<float>(body.colour[2]);
  message.color.a = static_cast<float>(body.colour[3]);
  if (body.origin) {
    message.max_edge_length = body.origin->max_edge_length.value_or(0.0);
    message.chord_error = body.origin->chord_error.value_or(0.0);
    for (const BodyShape& shape : body.origin->shapes)
      addShape(shape, body.origin->base_folder, with_meshes, message);
  }
  return message;
}

BodyState toState(const Scene& scene, const SceneBody& body, const Names& names,
                  const detail::FramesNow& frames, bool with_meshes) {
  BodyState message;
  message.info = toBodyInfo(body);
  message.is_robot_link = static_cast<std::uint8_t>(body.is_robot_link);
  const auto known = body.frame == frames.reference ? detail::FrameRelation{}
                                                    : frames.relation(frames.reference, body.frame);
  if (known) {
    message.has_pose_now = 1;
    message.pose_now = toPose(known->target_from_source * body.frame_from_body);
  }
  if (const auto carrier = names.find(body.carrier); carrier != names.end())
    message.moved_by = carrier->second;
  if (body.attachment) message.touch_links = namesOf(scene, body.attachment->may_touch);
  message.add = toAddition(body, with_meshes);
  return message;
}

bool hasDisabledRule(const Scene& scene) {
  return std::any_of(scene.rules.list.begin(), scene.rules.list.end(),
                     [](const PairRule& rule) { return !rule.is_enabled; });
}

void listAllowed(const Scene& scene, GetScene::Response& response) {
  if (!hasDisabledRule(scene)) return;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    for (std::size_t j = 0; j < i && response.allowed_contacts.size() < kMostAllowed; ++j) {
      const PairRule* rule = ruleOf(scene, i, j);
      if (rule == nullptr || rule->is_enabled) continue;
      response.allowed_contacts.push_back(toPairInfo(scene, *ruledPair(scene, i, j)));
    }
  }
}

}  // namespace

void fillState(const Scene& scene, const detail::FramesNow& frames, bool with_meshes,
               GetScene::Response& response) {
  response.reference_frame = frames.reference;
  response.cutoff = scene.defaults.pairs.tracker.cutoff;
  Names names;
  for (const SceneBody& body : scene.bodies) names.emplace(body.serial, body.name);
  for (const SceneBody& body : scene.bodies) {
    response.bodies.push_back(toState(scene, body, names, frames, with_meshes));
  }
  for (const auto& operation : detail::wholeJournal(scene)) {
    const std::optional<std::size_t> body = scene.findBody(operation->body);
    if (operation->kind != detail::OperationKind::Add || !body) continue;
    SceneOperation& message = response.bodies[*body].add;
    message.pair_with = operation->partners.names;
    message.touch_links = operation->partners.may_touch;
    message.without_pairs = static_cast<std::uint8_t>(operation->partners.none);
  }
  for (const auto& [name, bodies] : scene.groups) {
    GroupInfo& group = response.groups.emplace_back();
    group.name = name;
    group.bodies = bodies;
    group.of_robot = static_cast<std::uint8_t>(scene.groups_of_robots.count(name));
  }
  for (const ScenePair& pair : scene.pairs) response.named_pairs.push_back(toPairInfo(scene, pair));
  listAllowed(scene, response);
}

void fillReport(detail::ReloadReport report, Reload::Response& response) {
  response.kept = std::move(report.kept);
  response.replaced = std::move(report.replaced);
  response.added = std::move(report.added);
  response.removed = std::move(report.removed);
  response.kept_edits = std::move(report.kept_edits);
  response.dropped = std::move(report.dropped);
}

}  // namespace concave_distance
