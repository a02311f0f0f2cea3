#include <algorithm>
#include <cmath>
#include <limits>

#include "benchmark/engines/engine_differences.h"
#include "concave_distance/base/error.h"
#include "concave_distance/loading/load_scene.h"
#include "support/hunt_crossley_rebound.h"

namespace concave_distance::benchmark {
namespace {

// Of the bed of springs under the feet; the scene file itself has Hunt and Crossley's law for round bodies,
// which Simbody does not have for meshes.
constexpr double kFeetFoundation = 1e9;
constexpr double kBoxSpacing = 0.02;
constexpr double kFeetSpacing = 0.004;

ComparedScene load(const std::string& file, const std::string& body, ComparedShape shape) {
  ComparedScene compared;
  compared.name = file;
  compared.shape = shape;
  const std::string path = std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/config/" + file + ".yaml";
  SceneLoadOptions options;
  options.package_locator = [](const std::string&) { return std::string(CONCAVE_DISTANCE_SOURCE_DIR); };
  compared.scene = loadSceneFile(path, options);
  const auto index = compared.scene.findBody(body);
  if (!index || compared.scene.bodies.size() != 2 || compared.scene.pairs.size() != 1 ||
      !compared.scene.simulation || !compared.scene.problems.empty()) {
    throw Error(path, "not a scene of one body '" + body + "' over a ground", "restore the file");
  }
  compared.body = *index;
  bool found = false;
  for (const SimulatedBodySettings& settings : compared.settings().bodies) {
    if (settings.body != body) continue;
    found = true;
    if (settings.density) {
      compared.mass = massPropertiesOf(compared.surface(), *settings.density, path);
    } else if (settings.mass) {
      compared.mass = massPropertiesOfMass(compared.surface(), *settings.mass, path);
    } else {
      throw Error(path, "the body '" + body + "' has neither density nor mass", "restore the file");
    }
    compared.pose = settings.pose;
    if (!settings.velocity.isZero() || !settings.angular_velocity.isZero()) {
      throw Error(path, "the body '" + body + "' moves at the start", "restore the file");
    }
  }
  if (!found) throw Error(path, "the body '" + body + "' is not free", "restore the file");
  compared.material = inContact(compared.scene.bodies[0].material, compared.scene.bodies[1].material);
  const EffectSettings& effects = compared.scene.pairs[0].settings.effects;
  if (!effects.normal_force) throw Error(path, "no normal force", "restore the file");
  if (effects.friction.model != FrictionModel::None) compared.friction = compared.material.dynamic_friction;
  compared.foundation_stiffness = effects.normal_force->foundation_stiffness;
  compared.radius = effects.normal_force->radius;
  compared.box_size = compared.surface().boundingBox().sizes();
  compared.scene.simulation->tracking = SimulationTracking::Niches;
  return compared;
}

double heightOfLowestPoint(const ComparedScene& scene) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& vertex : scene.surface().vertices()) {
    lowest = std::min(lowest, (scene.pose * vertex).z());
  }
  return lowest;
}

// A body that falls from rest; of one that hits beside its centre the lowest point's speed is the same.
void setRestitution(ComparedScene& scene) {
  const double speed = std::sqrt(-2.0 * scene.settings().gravity.z() * heightOfLowestPoint(scene));
  scene.restitution = test::huntCrossleyRebound(speed, scene.material.dissipation) / speed;
}

}  // namespace

double mechanicalEnergy(const ComparedScene& scene, const EngineSample& sample) {
  const Eigen::Vector3d turning = sample.world_from_body.transpose() * sample.angular_velocity;
  return 0.5 * scene.mass.mass * sample.velocity.squaredNorm() +
         0.5 * turning.dot(scene.mass.inertia * turning) -
         scene.mass.mass * scene.settings().gravity.dot(sample.centre);
}

std::size_t sampleCount(const ComparedScene& scene, double rate) {
  return static_cast<std::size_t>(std::llround(scene.settings().duration * rate)) + 1;
}

std::vector<ComparedScene> comparedScenes() {
  std::vector<ComparedScene> scenes;
  scenes.push_back(load("bouncing_ball", "ball", ComparedShape::Sphere));
  setRestitution(scenes.back());
  for (const char* name : {"box_sticks", "box_slides"}) {
    scenes.push_back(load(name, "box", ComparedShape::Box));
    scenes.back().spring_spacing = kBoxSpacing;
  }
  ComparedScene diagonal = scenes.back();
  diagonal.name = "box_slides_diagonally";
  SimulationSettings& settings = *diagonal.scene.simulation;
  settings.gravity = Eigen::AngleAxisd(std::acos(-1.0) / 4.0, Eigen::Vector3d::UnitZ()) * settings.gravity;
  diagonal.pose.translation().y() = -0.2;  // room on the slope
  for (SimulatedBodySettings& body : settings.bodies) {
    if (body.body == diagonal.scene.bodies[diagonal.body].name) body.pose = diagonal.pose;
  }
  scenes.push_back(diagonal);
  ComparedScene feet = load("two_feet", "two_feet", ComparedShape::Mesh);
  NormalForceSettings& normal = *feet.scene.pairs.edit(0).settings.effects.normal_force;
  normal.model = NormalForceModel::ElasticFoundation;
  normal.foundation_stiffness = feet.foundation_stiffness = kFeetFoundation;
  feet.spring_spacing = kFeetSpacing;
  setRestitution(feet);
  scenes.push_back(std::move(feet));
  return scenes;
}

}  // namespace concave_distance::benchmark
