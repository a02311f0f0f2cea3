#include "operation_conversions.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "request_conversions.h"

namespace concave_distance {
namespace {

using detail::OperationKind;

static_assert(SceneOperation::ADD == static_cast<int>(OperationKind::Add));
static_assert(SceneOperation::MOVE == static_cast<int>(OperationKind::Move));
static_assert(SceneOperation::REMOVE == static_cast<int>(OperationKind::Remove));
static_assert(SceneOperation::ATTACH == static_cast<int>(OperationKind::Attach));
static_assert(SceneOperation::DETACH == static_cast<int>(OperationKind::Detach));
static_assert(SceneOperation::ALLOW_CONTACT == static_cast<int>(OperationKind::AllowContact));
static_assert(SceneOperation::DISALLOW_CONTACT == static_cast<int>(OperationKind::DisallowContact));
static_assert(SceneOperation::SET_MARGIN == static_cast<int>(OperationKind::SetMargin));

std::string place(const std::string& list, std::size_t i) {
  return list + "[" + std::to_string(i) + "]";
}

bool hasHeight(std::uint8_t type) {
  using shape_msgs::SolidPrimitive;
  return type == SolidPrimitive::CYLINDER || type == SolidPrimitive::CONE || type == SceneOperation::CAPSULE;
}

BodyShape fromPrimitive(const shape_msgs::SolidPrimitive& primitive, const std::string& where) {
  using shape_msgs::SolidPrimitive;
  BodyShape shape;
  switch (primitive.type) {
    case SolidPrimitive::BOX:
      shape.primitive = "box";
      break;
    case SolidPrimitive::SPHERE:
      shape.primitive = "sphere";
      break;
    case SolidPrimitive::CYLINDER:
      shape.primitive = "cylinder";
      break;
    case SolidPrimitive::CONE:
      shape.primitive = "cone";
      break;
    case SceneOperation::CAPSULE:
      shape.primitive = "capsule";
      break;
    default:
      throw Error(where + ".type", "the value is " + std::to_string(primitive.type),
                  "allowed: BOX 1, SPHERE 2, CYLINDER 3, CONE 4, CAPSULE 200");
  }
  shape.dimensions = primitive.dimensions;
  // There the height is the first.
  if (hasHeight(primitive.type)) std::reverse(shape.dimensions.begin(), shape.dimensions.end());
  return shape;
}

BodyShape fromMesh(const shape_msgs::Mesh& mesh, std::size_t largest_triangle_count,
                   const std::string& where) {
  if (mesh.triangles.empty()) throw Error(where, "it has no triangle", "give at least one");
  if (mesh.triangles.size() > largest_triangle_count) {
    throw Error(where, std::to_string(mesh.triangles.size()) + " triangles",
                "reduce the mesh; the limit of a body is " + std::to_string(largest_triangle_count));
  }
  auto soup = std::make_shared<TriangleSoup>();
  soup->vertices.reserve(mesh.vertices.size());
  for (const geometry_msgs::Point& vertex : mesh.vertices)
    soup->vertices.emplace_back(vertex.x, vertex.y, vertex.z);
  soup->triangles.reserve(mesh.triangles.size());
  for (const shape_msgs::MeshTriangle& triangle : mesh.triangles) {
    soup->triangles.push_back(
        {triangle.vertex_indices[0], triangle.vertex_indices[1], triangle.vertex_indices[2]});
  }
  BodyShape shape;
  shape.triangles = std::move(soup);
  return shape;
}

/// Appends the shapes of one list with their poses.
template <typename List, typename ToShape>
void appendShapes(const std::string& name, const List& list, const std::string& poses_name,
                  const std::vector<geometry_msgs::Pose>& poses, std::vector<BodyShape>& shapes,
                  const ToShape& to_shape) {
  if (!poses.empty() && poses.size() != list.size()) {
    throw Error(poses_name,
                std::to_string(poses.size()) + " poses for " + std::to_string(list.size()) + " " + name,
                "give one for each, or none");
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    shapes.push_back(to_shape(list[i], i));
    if (!poses.empty()) shapes.back().frame_from_geometry = poseFromMessage(poses[i], place(poses_name, i));
  }
}

std::vector<BodyShape> shapesOf(const SceneOperation& message, std::size_t largest_triangle_count) {
  std::vector<BodyShape> shapes;
  appendShapes(
      "primitives", message.primitives, "primitive_poses", message.primitive_poses, shapes,
      [](const auto& primitive, std::size_t i) { return fromPrimitive(primitive, place("primitives", i)); });
  appendShapes("meshes", message.meshes, "mesh_poses", message.mesh_poses, shapes,
               [&](const auto& mesh, std::size_t i) {
                 return fromMesh(mesh, largest_triangle_count, place("meshes", i));
               });
  const auto& scales = message.mesh_resource_scales;
  if (!scales.empty() && scales.size() != message.mesh_resources.size()) {
    throw Error("mesh_resource_scales",
                std::to_string(scales.size()) + " scales for " +
                    std::to_string(message.mesh_resources.size()) + " mesh_resources",
                "give one for each, or none");
  }
  appendShapes("mesh_resources", message.mesh_resources, "mesh_resource_poses", message.mesh_resource_poses,
               shapes, [&](const std::string& resource, std::size_t i) {
                 if (resource.empty()) throw Error(place("mesh_resources", i), "it is empty", "name a file");
                 BodyShape shape;
                 shape.mesh_resource = resource;
                 if (!scales.empty()) shape.scale = scaleFromMessage(scales[i]);
                 return shape;
               });
  if (shapes.empty()) {
    throw Error("shapes", "the body has none", "give primitives, meshes or mesh_resources");
  }
  return shapes;
}

void fill(const SceneOperation& message, detail::SceneOperation& operation) {
  if (message.operation > SceneOperation::SET_MARGIN) {
    throw Error("operation", "the value is " + std::to_string(message.operation), "allowed: 0 to 7");
  }
  operation.kind = static_cast<OperationKind>(message.operation);
  if (!message.frame_id.empty()) operation.frame = requireFrameName(message.frame_id, "frame_id");
  if (operation.kind == OperationKind::Move)
    operation.frame_from_body = poseFromMessage(message.pose, "pose");
  if (operation.kind == OperationKind::Add) {
    operation.partners = {message.pair_with, message.without_pairs != 0, message.touch_links, {}};
    operation.warning_distance = warningDistanceOf(message);
    operation.warning_hysteresis = message.warning_hysteresis;
  }
}

}  // namespace

detail::SceneOperation toOperation(const SceneOperation& message) {
  detail::SceneOperation operation;
  operation.body = message.body;
  operation.other = message.other;
  operation.touch_links = message.touch_links;
  operation.allow_robot_link = message.allow_robot_link != 0;
  operation.margin = message.margin;
  try {
    fill(message, operation);
  } catch (const Error& error) {
    operation.problem = error;
  }
  return operation;
}

BodyDescription bodyOf(const SceneOperation& message, const SceneDefaults& defaults,
                       std::size_t largest_triangle_count) {
  std::vector<BodyShape> shapes = shapesOf(message, largest_triangle_count);
  BodyDescription description;
  static_cast<BodyShape&>(description) = std::move(shapes.front());
  description.other_shapes.assign(std::make_move_iterator(shapes.begin() + 1),
                                  std::make_move_iterator(shapes.end()));
  description.name = message.body;
  description.frame = requireFrameName(message.frame_id, "frame_id");
  description.max_edge_length = defaults.max_edge_length;
  description.chord_error = defaults.chord_error;
  if (message.max_edge_length != 0.0) description.max_edge_length = message.max_edge_length;
  if (message.chord_error != 0.0) description.chord_error = message.chord_error;
  return description;
}

void finishBody(const SceneOperation& message, const SceneDefaults& defaults, SceneBody& body) {
  body.frame_from_body = poseFromMessage(message.pose, "pose");
  body.colour = toColour(message.color, body.colour);
  body.material = defaults.material;
  body.margin = message.margin;
  requireMargin("body '" + body.name + "'", body.margin, *body.mesh);
}

Eigen::Vector4d toColour(const std_msgs::ColorRGBA& color, const Eigen::Vector4d& fallback) {
  const Eigen::Vector4d given(color.r, color.g, color.b, color.a);
  return given.isZero(0.0) ? fallback : given;
}

}  // namespace concave_distance
