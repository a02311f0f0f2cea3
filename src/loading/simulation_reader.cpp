#include "simulation_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/parameter_checks.h"
#include "concave_distance/base/error.h"
#include "parameter_map.h"
#include "query_poses.h"
#include "scene/simulation_parameters.h"
#include "shape_reader.h"

namespace concave_distance::detail {
namespace {

constexpr std::pair<const char*, bool> kLoadFrames[] = {{"world", false}, {"body", true}};

class SimulationReader {
 public:
  SimulationReader(std::string base_folder, const PackageLocator& package_locator)
      : base_folder_(std::move(base_folder)), package_locator_(package_locator) {}

  SimulatedBodySettings readBody(const YamlValue& value) const;

 private:
  std::vector<TimedPose> readPath(const YamlValue& value) const;
  std::vector<TimedPose> readPosesFile(const YamlValue& value) const;
  CompliantDrive readDrive(const YamlValue& value) const;

  std::string base_folder_;
  const PackageLocator& package_locator_;
};

double positive(const YamlValue& value, const std::string& unit) {
  return value.number("greater than 0, " + unit, positiveFinite);
}

// One number for all axes, or one per axis.
Eigen::Vector3d readPerAxis(const YamlValue& value, const std::string& unit) {
  const std::string allowed = "a number from 0 or a list of three, " + unit;
  if (value.isScalar()) return Eigen::Vector3d::Constant(value.number(allowed, notNegativeFinite));
  Eigen::Vector3d numbers = value.vector3(allowed);
  if (!(numbers.array() >= 0.0).all()) value.refuse(allowed);
  return numbers;
}

MassProperties readInertia(const YamlValue& value) {
  YamlMap map(value, "a map with mass, centre, tensor");
  MassProperties inertia;
  inertia.mass = positive(map.require("mass", "give `mass`, kg"), "kg");
  if (auto v = map.take("centre")) inertia.centre_in_body = v->vector3("three numbers, metres");
  const std::vector<double> t =
      map.require("tensor", "give `tensor: [xx, yy, zz, xy, xz, yz]`, kg m^2")
          .numbers(6, "six numbers xx, yy, zz, xy, xz, yz about the centre of mass, kg m^2");
  inertia.inertia << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2];
  map.finish();
  inertia.validate(value.where());
  return inertia;
}

AppliedLoad readLoad(const YamlValue& value) {
  YamlMap map(value, "a map with force or torque");
  AppliedLoad load;
  const std::optional<YamlValue> force = map.take("force");
  const std::optional<YamlValue> torque = map.take("torque");
  if (!force && !torque) map.value().fail("neither 'force' nor 'torque' is given", "give one of them");
  if (force) load.force = force->vector3("three numbers, newtons");
  if (torque) load.torque = torque->vector3("three numbers, newton metres");
  if (auto v = map.take("point")) load.point_in_body = v->vector3("three numbers, metres, body frame");
  if (auto v = map.take("frame")) load.in_body_frame = v->choice(kLoadFrames);
  if (auto v = map.take("from")) load.from = v->number("0 or more, seconds", notNegativeFinite);
  if (auto v = map.take("until")) {
    const auto later = [&](double until) { return until > load.from && std::isfinite(until); };
    load.until = optionalNumber(*v, "none", "greater than from, seconds", later)
                     .value_or(std::numeric_limits<double>::infinity());
  }
  map.finish();
  return load;
}

// A list of poses with times, or a poses file, moved as a whole if wished.
std::vector<TimedPose> SimulationReader::readPath(const YamlValue& value) const {
  if (value.isMap()) return readPosesFile(value);
  std::vector<TimedPose> path;
  for (const YamlValue& item : value.list("a list of {time, pose}, or a map with file")) {
    YamlMap map(item, "a map with time and pose");
    const YamlValue time = map.require("time", "give `time`, seconds");
    TimedPose pose;
    pose.time = time.number("after the pose before, seconds", [&](double t) {
      return std::isfinite(t) && (path.empty() || t > path.back().time);
    });
    if (auto v = map.take("pose")) pose.pose = readPose(*v);
    map.finish();
    path.push_back(pose);
  }
  if (path.empty()) value.refuse("one pose at least");
  return path;
}

std::vector<TimedPose> SimulationReader::readPosesFile(const YamlValue& value) const {
  YamlMap map(value, "a map with file");
  const YamlValue file = map.require("file", "name a poses file: t,x,y,z,qx,qy,qz,qw");
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  double delay = 0.0;
  if (auto v = map.take("offset")) offset = readPose(*v);
  if (auto v = map.take("delay")) {
    delay = v->number("seconds", [](double seconds) { return std::isfinite(seconds); });
  }
  map.finish();
  std::vector<TimedPose> path;
  try {
    path = readPosePath(locateResource(file.text(), base_folder_, package_locator_));
  } catch (const Error& error) {
    throw Error(file.where() + ", " + error.where(), error.whatIsWrong(), error.remedy());
  }
  for (TimedPose& pose : path) pose = {pose.time + delay, offset * pose.pose};
  return path;
}

CompliantDrive SimulationReader::readDrive(const YamlValue& value) const {
  YamlMap map(value, "a map with target and stiffness");
  CompliantDrive drive;
  drive.target = readPath(map.require("target", "give the target's path: a list of {time, pose}, or {file}"));
  if (auto v = map.take("frame")) drive.body_from_drive = readPose(*v);
  if (auto v = map.take("stiffness")) drive.stiffness = readPerAxis(*v, "N/m");
  if (auto v = map.take("damping")) drive.damping = readPerAxis(*v, "N s/m");
  if (auto v = map.take("rotational_stiffness")) drive.rotational_stiffness = readPerAxis(*v, "N m/rad");
  if (auto v = map.take("rotational_damping")) drive.rotational_damping = readPerAxis(*v, "N m s/rad");
  map.finish();
  return drive;
}

SimulatedBodySettings SimulationReader::readBody(const YamlValue& value) const {
  YamlMap map(value, "a map with body");
  SimulatedBodySettings body;
  body.where = value.where();
  body.body = map.require("body", "name a body or link of the scene").text();
  const std::optional<YamlValue> fixed = map.take("fixed");
  const std::optional<YamlValue> path = map.take("path");
  if (fixed && fixed->boolean()) body.motion = BodyMotion::Fixed;
  if (path) {
    if (fixed && fixed->boolean()) path->fail("a fixed body has no path", "leave out one of them");
    body.motion = BodyMotion::Driven;
    body.path = readPath(*path);
  }
  const auto take_if_free = [&](const char* key) {
    std::optional<YamlValue> v = map.take(key);
    if (v && body.motion != BodyMotion::Free) {
      v->fail("a body that is " + std::string(toString(body.motion)) + " has no " + key,
              "leave it out, or let the body be free");
    }
    return v;
  };
  if (auto v = map.take("pose")) {
    if (path) v->fail("a body with a path has no other pose", "leave out one of them");
    body.pose = readPose(*v);
  }
  if (auto v = take_if_free("velocity")) body.velocity = v->vector3("three numbers, m/s");
  if (auto v = take_if_free("angular_velocity")) body.angular_velocity = v->vector3("three numbers, rad/s");
  const std::optional<YamlValue> inertia = take_if_free("inertia");
  const std::optional<YamlValue> density = take_if_free("density");
  const std::optional<YamlValue> mass = take_if_free("mass");
  if ((inertia && (density || mass)) || (density && mass)) {
    map.value().fail("more than one of 'inertia', 'density', 'mass' is given", "give one of them");
  }
  if (inertia) body.inertia = readInertia(*inertia);
  if (density) body.density = positive(*density, "kg/m^3");
  if (mass) body.mass = positive(*mass, "kg");
  if (auto v = take_if_free("drive")) body.drive = readDrive(*v);
  if (auto v = take_if_free("loads")) {
    for (const YamlValue& load : v->list("a list of loads")) body.loads.push_back(readLoad(load));
  }
  map.finish();
  return body;
}

}  // namespace

SimulationSettings readSimulation(const YamlValue& value, const std::string& base_folder,
                                  const PackageLocator& package_locator) {
  YamlMap map(value, "a map with bodies, duration, gravity and steps");
  SimulationSettings settings;
  if (auto v = map.take("gravity")) settings.gravity = v->vector3("three numbers, m/s^2");
  readParameters(map, simulationParameters(), false, settings);
  if (auto v = map.take("bodies")) {
    const SimulationReader reader(base_folder, package_locator);
    for (const YamlValue& item : v->list("a list of bodies")) {
      SimulatedBodySettings body = reader.readBody(item);
      const auto same = std::find_if(settings.bodies.begin(), settings.bodies.end(),
                                     [&](const auto& other) { return other.body == body.body; });
      if (same != settings.bodies.end()) {
        throw Error(item.where(), "body '" + body.body + "' is given twice, first at " + same->where,
                    "remove one of them");
      }
      settings.bodies.push_back(std::move(body));
    }
  }
  map.finish();
  return settings;
}

}  // namespace concave_distance::detail
