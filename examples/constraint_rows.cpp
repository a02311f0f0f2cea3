// Joint velocities that keep a robot clear of all that is near it: a row for every place where two bodies
// could touch next, without ROS.
//   constraint_rows scene.yaml robot.urdf [folder of the package that the URDF's meshes are in]
#include <concave_distance/kinematics/constraint_rows.h>
#include <concave_distance/loading/load_scene.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

int main(int argc, char** argv) try {
  using namespace concave_distance;
  if (argc < 3) throw std::invalid_argument("usage: constraint_rows scene.yaml robot.urdf [package folder]");
  std::ifstream urdf(argv[2]);
  SceneLoadOptions options;
  if (argc > 3) options.package_locator = [&](const std::string&) { return std::string(argv[3]); };
  options.descriptions["robot_description"] = {std::istreambuf_iterator<char>(urdf), {}};

  // From here to the last row: what a user writes.
  const Scene scene = loadSceneFile(argv[1], options);
  const auto joints = std::make_shared<const SceneKinematics>(scene);
  SceneState state = joints->startState();
  SceneTracker tracker;
  tracker.setScene(scene);
  ConstraintRows rows(joints, {0.15, 64});  // metres, slots
  Eigen::VectorXd positions = joints->restPositions();
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(64);  // a slot keeps its row, and so its multiplier
  const Eigen::VectorXd wanted = Eigen::VectorXd::Constant(positions.size(), 0.2);
  double least = INFINITY;
  for (int step = 0; step < 1000; ++step) {
    joints->evaluate(positions, state);
    tracker.update(state.world_from_body, 0.01 * step);
    rows.update(tracker.pairs(), state, 0.01 * step);
    // The velocities nearest to the wanted ones that obey gradient * velocities >= bound in every row.
    Eigen::VectorXd velocities = wanted + rows.jacobian().transpose() * multipliers;
    for (int i = 0; i < 50 * 64; ++i) {
      const ConstraintRow& row = rows.rows()[i % 64];
      const auto gradient = rows.jacobian().row(i % 64);
      double& multiplier = multipliers[i % 64];
      const double before = multiplier;
      const double bound = (std::isnan(row.drift) ? 0.0 : row.drift) - 2.0 * (row.value - 0.03);
      const double change = (bound - gradient.dot(velocities)) / std::max(gradient.squaredNorm(), 1e-12);
      multiplier = row.state == SlotState::Used ? std::max(0.0, before + change) : 0.0;
      velocities += (multiplier - before) * gradient.transpose();
      if (row.state == SlotState::Used) least = std::min(least, row.value);
    }
    positions += 0.01 * velocities;
  }
  std::printf("%zu joints, %.4f m left at the nearest place\n", joints->velocityNames().size(), least);
  return least > 0.0 ? 0 : 1;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "constraint_rows: %s\n", problem.what());
  return 1;
}
