#include "many_bodies.h"

#include <cmath>
#include <string>
#include <utility>

#include "base/random_engine.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "concave_distance/mesh/surface/round_shape.h"
#include "support/random_solids.h"

namespace concave_distance::benchmark {
namespace {

constexpr std::size_t kShapes = 20;

std::vector<std::shared_ptr<const BodyMesh>> makeShapes(RandomEngine& engine) {
  std::vector<std::shared_ptr<const BodyMesh>> shapes;
  for (std::size_t k = 0; k < kShapes; ++k) {
    const double size = 0.2 + 0.3 * static_cast<double>(k) / kShapes;
    const std::string name = "shape" + std::to_string(k);
    if (k % 3 == 0) {
      BodyMeshOptions options;
      RoundShape ball;
      ball.radius = 0.5 * size;
      options.shape = ball;
      shapes.push_back(std::make_shared<const BodyMesh>(name, makeSphere(0.5 * size, 0.005 * size), options));
    } else if (k % 3 == 1) {
      const Eigen::Vector3d sides = size * Eigen::Vector3d(1.0, 0.6 + 0.4 * uniformUnit(engine), 0.5);
      shapes.push_back(std::make_shared<const BodyMesh>(name, makeBox(sides), BodyMeshOptions()));
    } else {
      // 1,000 to 5,000 triangles.
      const double sag = size * (k % 2 == 0 ? 1.5e-3 : 6e-4) * (1.0 + static_cast<double>(k) / kShapes);
      shapes.push_back(std::make_shared<const BodyMesh>(name, test::makeBumpyBall(0.45 * size, sag, 7.0),
                                                        BodyMeshOptions()));
    }
  }
  return shapes;
}

}  // namespace

Eigen::Isometry3d Path::at(double time) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = home;
  for (std::size_t k = 0; k < 3; ++k) {
    const double rate = 0.5 * (1.0 + static_cast<double>(k));
    for (int i = 0; i < 3; ++i)
      pose.translation()[i] += amplitude[k][i] * std::sin(rate * time + phase[k][i]);
  }
  pose.linear() = Eigen::AngleAxisd(spin * time, axis).toRotationMatrix();
  return pose;
}

Poses ManyBodies::posesAt(double time) const {
  Poses poses;
  for (const Path& path : paths) poses.emplace_back(path.at(time));
  return poses;
}

std::vector<std::shared_ptr<const BodyMesh>> manyShapes() {
  RandomEngine engine(1);
  return makeShapes(engine);
}

ManyBodies manyBodies(std::size_t count) {
  RandomEngine engine(1);
  const auto shapes = makeShapes(engine);
  ManyBodies cell;
  cell.scene.defaults.pairs.tracker.cutoff = kCutoff;
  PairRule rule;
  rule.earlier = rule.later = BodySet::before(count);
  rule.watch(PairOrder::Later);
  cell.scene.rules.list = {rule};
  const double side = std::cbrt(static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    SceneBody body;
    body.name = body.frame = "b" + std::to_string(i);
    body.mesh = shapes[i % kShapes];
    body.bounds = boundsOf(*body.mesh);
    body.is_added = true;
    cell.scene.bodies.push_back(std::move(body));
    Path path;
    path.home = side * (test::uniformInCube(engine, 0.5) + Eigen::Vector3d::Constant(0.5));
    for (std::size_t k = 0; k < 3; ++k) {
      path.amplitude[k] = test::uniformInCube(engine, 0.5 / static_cast<double>(k + 1));
      path.phase[k] = M_PI * test::uniformInCube(engine, 1.0);
    }
    path.axis = (test::uniformInCube(engine, 1.0) + Eigen::Vector3d(0.0, 0.0, 1.1)).normalized();
    path.spin = uniformUnit(engine);
    cell.paths.push_back(path);
  }
  return cell;
}

}  // namespace concave_distance::benchmark
