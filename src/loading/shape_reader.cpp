#include "shape_reader.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <utility>

#include "base/constants.h"
#include "base/number_text.h"
#include "mesh/surface/primitive_table.h"
#include "settings_reader.h"

namespace concave_distance::detail {
namespace {

// Entries of a rotation times its transpose are this near to those of the identity, else it is refused.
constexpr double kRotationTolerance = 1e-9;

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

// Row by row; taken as it is, so that no digit of a saved pose is lost.
Eigen::Matrix3d readRotation(const YamlValue& value) {
  const char* allowed = "nine numbers row by row: a rotation without mirroring";
  const std::vector<double> v = value.numbers(9, allowed);
  Eigen::Matrix3d rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(v.data());
  const double error = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= kRotationTolerance) || !(rotation.determinant() > 0.0)) value.refuse(allowed);
  return rotation;
}

void readPrimitive(const Primitive& primitive, const YamlValue& value, BodyShape& body) {
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

Eigen::Vector3d readScaleOf(const YamlValue& value, const BodyShape& shape) {
  if (shape.mesh_resource.empty()) value.fail("a primitive has no scale", "give its dimensions instead");
  return readScale(value);
}

void readGeometry(YamlMap& map, BodyShape& body) {
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
  if (auto v = map.take("scale")) body.scale = readScaleOf(*v, body);
  if (auto v = map.take("pose")) body.frame_from_geometry = readPose(*v);
}

}  // namespace

Eigen::Isometry3d readPose(const YamlValue& value) {
  YamlMap map(value, "a map with xyz and rpy, quaternion or rotation");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (auto v = map.take("xyz")) {
    pose.translation() = v->vector3("three numbers, metres");
    if (pose.translation().cwiseAbs().maxCoeff() > kLargestCoordinate) v->refuse("three numbers up to 1e18");
  }
  const std::optional<YamlValue> rpy = map.take("rpy");
  const std::optional<YamlValue> quaternion = map.take("quaternion");
  const std::optional<YamlValue> rotation = map.take("rotation");
  if (rpy && quaternion) quaternion->fail("both 'rpy' and 'quaternion' are given", "give one of them");
  if (rotation && (rpy || quaternion)) {
    rotation->fail(std::string("both 'rotation' and '") + (rpy ? "rpy" : "quaternion") + "' are given",
                   "give one of them");
  }
  if (rotation) pose.linear() = readRotation(*rotation);
  if (rpy) pose.linear() = fromRollPitchYaw(rpy->vector3("three angles, radians")).toRotationMatrix();
  if (quaternion) {
    const char* allowed = "four numbers x, y, z, w of norm 1";
    const std::vector<double> q = quaternion->numbers(4, allowed);
    const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
    if (!(std::abs(turn.norm() - 1.0) <= kUnitTolerance)) {
      quaternion->fail("the norm is " + numberText(turn.norm()), std::string("allowed: ") + allowed);
    }
    pose.linear() = turn.normalized().toRotationMatrix();
  }
  map.finish();
  return pose;
}

void readShapes(YamlMap& map, BodyDescription& body) {
  const std::optional<YamlValue> list = map.take("shapes");
  if (!list) {
    readGeometry(map, body);
    return;
  }
  std::vector<BodyShape> shapes;
  for (const YamlValue& value : list->list("a list of shapes")) {
    YamlMap shape(value, "a map with a geometry, its scale and its pose");
    readGeometry(shape, shapes.emplace_back());
    shape.finish();
  }
  if (shapes.empty()) list->refuse("a list of at least one shape");
  static_cast<BodyShape&>(body) = shapes.front();
  body.other_shapes.assign(shapes.begin() + 1, shapes.end());
}

}  // namespace concave_distance::detail
