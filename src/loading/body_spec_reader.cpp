#include "body_spec_reader.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/constants.h"
#include "base/number_text.h"
#include "kinematics/frame_name.h"
#include "mesh/surface/primitive_table.h"
#include "scene/name_pattern.h"
#include "settings_reader.h"

namespace concave_distance::detail {
namespace {

// A quaternion is normalised when its norm is this near to 1, else refused (as for distance_query).

constexpr std::pair<const char*, GeometrySource> kGeometrySources[] = {
    {"collision", GeometrySource::Collision}, {"visual", GeometrySource::Visual}};

// One of two texts at most, one at least where it is required.
void readOneOf(YamlMap& map, const char* first, const char* second, std::string& into_first,
               std::string& into_second, bool required) {
  const std::optional<YamlValue> a = map.take(first);
  const std::optional<YamlValue> b = map.take(second);
  const std::string both = "'" + std::string(first) + "' and '" + second + "'";
  if (a && b) b->fail("both " + both + " are given", "give one of them");
  if (required && !a && !b) map.value().fail("neither of " + both + " is given", "give one of them");
  if (a) into_first = a->text();
  if (b) into_second = b->text();
}

Eigen::Vector3d readScale(const YamlValue& value) {
  const char* allowed = "a number or a list of three, not 0; negative ones mirror";
  const auto accepts = [](double s) { return s != 0.0 && std::isfinite(s); };
  if (value.isScalar()) return Eigen::Vector3d::Constant(value.number(allowed, accepts));
  Eigen::Vector3d scale = value.vector3(allowed);
  if ((scale.array() == 0.0).any()) value.refuse(allowed);
  return scale;
}

Eigen::Quaterniond fromRollPitchYaw(const Eigen::Vector3d& rpy) {
  // As in URDF: rotations about the fixed axes x, y, z in this order.
  return Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX());
}

Eigen::Vector4d readColour(const YamlValue& value) {
  const char* allowed = "three or four numbers from 0 to 1: red, green, blue, opacity";
  if (!value.isList()) value.refuse(allowed);
  const std::vector<YamlValue> parts = value.list(allowed);
  if (parts.size() != 3 && parts.size() != 4) value.refuse(allowed);
  Eigen::Vector4d colour(0, 0, 0, 1);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    colour[static_cast<Eigen::Index>(i)] =
        parts[i].number("from 0 to 1", [](double c) { return c >= 0.0 && c <= 1.0; });
  }
  return colour;
}

double readMargin(const YamlValue& value) {
  return value.number("a number from 0, metres",
                      [](double margin) { return margin >= 0.0 && std::isfinite(margin); });
}

void readPrimitive(const Primitive& primitive, const YamlValue& value, BodyDescription& body) {
  YamlMap map(value, "a map of dimensions");
  body.primitive = primitive.name;
  for (const auto& [key, count] : primitive.sizes) {
    const std::string quoted = std::string("give `") + key;
    if (count == 1) {
      body.dimensions.push_back(readLength(map.require(key, quoted + "`, metres")));
      continue;
    }
    const YamlValue size = map.require(key, quoted + ": [x, y, z]`, metres");
    const char* allowed = "three lengths greater than 0, metres";
    for (const double length : size.numbers(count, allowed)) {
      if (!(length > 0.0)) size.refuse(allowed);
      body.dimensions.push_back(length);
    }
  }
  map.finish();
}

/// Reads what robots and bodies may say each for itself, else `defaults` say.
void readOverDefaults(YamlMap& map, const BodyDefaults& defaults, std::optional<double>& max_edge_length,
                      std::optional<double>& chord_error, Material& material) {
  max_edge_length = defaults.max_edge_length;
  if (auto v = map.take("max_edge_length")) max_edge_length = readEdgeLength(*v);
  chord_error = defaults.chord_error;
  if (auto v = map.take("chord_error")) chord_error = readLength(*v);
  material = defaults.material;
  if (auto v = map.take("material")) material = readMaterial(*v, defaults.materials);
}

void readGeometry(YamlMap& map, BodyDescription& body) {
  std::optional<YamlValue> given = map.take("mesh");
  if (given) body.mesh_resource = given->text();
  const std::string remedy = "give one of mesh, " + primitiveNames();
  for (const Primitive& primitive : primitives()) {
    const std::optional<YamlValue> value = map.take(primitive.name);
    if (!value) continue;
    if (given) value->fail("a second geometry", remedy);
    given = value;
    readPrimitive(primitive, *value, body);
  }
  if (!given) map.value().fail("no geometry", remedy);
}

}  // namespace

Eigen::Isometry3d readPose(const YamlValue& value) {
  YamlMap map(value, "a map with xyz and rpy or quaternion");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (auto v = map.take("xyz")) {
    pose.translation() = v->vector3("three numbers, metres");
    if (pose.translation().cwiseAbs().maxCoeff() > kLargestCoordinate) v->refuse("three numbers up to 1e18");
  }
  const std::optional<YamlValue> rpy = map.take("rpy");
  const std::optional<YamlValue> quaternion = map.take("quaternion");
  if (rpy && quaternion) quaternion->fail("both 'rpy' and 'quaternion' are given", "give one of them");
  if (rpy) pose.linear() = fromRollPitchYaw(rpy->vector3("three angles, radians")).toRotationMatrix();
  if (quaternion) {
    const char* allowed = "four numbers x, y, z, w of norm 1";
    const std::vector<double> q = quaternion->numbers(4, allowed);
    const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
    if (!(std::abs(rotation.norm() - 1.0) <= kUnitTolerance)) {
      quaternion->fail("the norm is " + numberText(rotation.norm()), std::string("allowed: ") + allowed);
    }
    pose.linear() = rotation.normalized().toRotationMatrix();
  }
  map.finish();
  return pose;
}

void readBodyDefaults(YamlMap& map, BodyDefaults& defaults) {
  if (auto v = map.take("geometry")) defaults.geometry = v->choice(kGeometrySources);
  if (auto v = map.take("max_edge_length")) defaults.max_edge_length = readEdgeLength(*v);
  if (auto v = map.take("chord_error")) defaults.chord_error = readLength(*v);
  if (auto v = map.take("material")) defaults.material = readMaterial(*v, defaults.materials);
}

RobotSpec readRobotSpec(const YamlValue& value, const BodyDefaults& defaults) {
  YamlMap map(value, "a map with description or urdf");
  RobotSpec robot;
  robot.where = value.where();
  readOneOf(map, "description", "urdf", robot.description, robot.urdf, true);
  readOneOf(map, "semantic_description", "srdf", robot.semantic_description, robot.srdf, false);
  if (auto v = map.take("name")) {
    robot.name = v->text();
    if (isPattern(robot.name)) v->refuse("a text without * ? [");
  }
  if (auto v = map.take("prefix")) {
    robot.prefix = withoutLeadingSlash(v->text());  // else tf2 would refuse every frame
    if (isPattern(robot.prefix)) v->refuse("a text without * ? [");
  }
  robot.geometry = defaults.geometry;
  if (auto v = map.take("geometry")) robot.geometry = v->choice(kGeometrySources);
  if (auto v = map.take("skip_links")) {
    for (const YamlValue& link : v->list("a list of links and patterns")) {
      robot.skipped_links.push_back({link.where(), link.text()});
    }
  }
  if (auto v = map.take("margin")) robot.margin = readMargin(*v);
  readOverDefaults(map, defaults, robot.max_edge_length, robot.chord_error, robot.material);
  map.finish();
  return robot;
}

BodySpec readBodySpec(const YamlValue& value, const BodyDefaults& defaults) {
  YamlMap map(value, "a map with name, frame and a geometry");
  BodySpec body;
  body.where = value.where();
  BodyDescription& description = body.description;
  const YamlValue name = map.require("name", "give every body a name");
  description.name = name.text();
  if (isPattern(description.name)) name.refuse("a text without * ? [");
  description.frame = description.name;
  if (auto v = map.take("frame")) {
    description.frame = requireFrameName(v->text(), v->where());
  } else if (const std::string problem = tfFrameProblem(description.name); !problem.empty()) {
    name.fail("it cannot also be the name of its frame: " + problem, "give a 'frame' or another name");
  }
  readGeometry(map, description);
  if (auto v = map.take("scale")) {
    if (description.mesh_resource.empty()) v->fail("a primitive has no scale", "give its dimensions instead");
    description.scale = readScale(*v);
  }
  if (auto v = map.take("pose")) description.frame_from_geometry = readPose(*v);
  if (auto v = map.take("colour")) body.colour = readColour(*v);
  if (auto v = map.take("margin")) body.margin = readMargin(*v);
  readOverDefaults(map, defaults, description.max_edge_length, description.chord_error, body.material);
  map.finish();
  return body;
}

}  // namespace concave_distance::detail
