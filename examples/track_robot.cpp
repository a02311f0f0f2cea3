// Tracks the links of a robot without ROS: the nearest pair at every step of a motion of one joint.
//   track_robot robot.urdf [folder with its meshes ...]
#include <concave_distance/kinematics/scene_kinematics.h>
#include <concave_distance/loading/load_scene.h>
#include <concave_distance/scene/scene_tracker.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

int main(int argc, char** argv) try {
  using namespace concave_distance;
  if (argc < 2) throw std::invalid_argument("usage: track_robot robot.urdf [folder with its meshes ...]");
  std::ifstream file(argv[1]);
  const std::string urdf{std::istreambuf_iterator<char>(file), {}};

  SceneLoadOptions options;
  options.mesh_search_path.assign(argv + 1, argv + argc);  // a file means its folder
  const Scene scene = loadRobotScene(urdf, argv[1], options);
  for (const SceneProblem& problem : scene.problems)
    std::printf("%s: %s\n", problem.where.c_str(), problem.message.c_str());
  const SceneKinematics joints(scene);
  SceneState state = joints.startState();
  Eigen::VectorXd positions = joints.restPositions();
  if (positions.size() == 0) throw std::runtime_error("no joint of the robot moves");
  const Eigen::Index moved = positions.size() / 2;
  const std::string& joint = joints.positionNames()[static_cast<std::size_t>(moved)];

  SceneTracker tracker;
  tracker.setScene(scene);
  for (int step = 0; step < 50; ++step) {
    positions[moved] = 0.02 * step;
    joints.evaluate(positions, state);
    tracker.update(state.world_from_body, 0.02 * step);
    const TrackedPair* nearest = nullptr;
    for (const auto& pair : tracker.pairs()) {
      if (!pair->solved()) continue;  // its status is in pair->state
      if (nearest == nullptr || pair->solution.distance < nearest->solution.distance) nearest = pair.get();
    }
    if (nearest == nullptr) throw std::runtime_error("no pair of the robot could be solved");
    std::printf("%s %+.2f: %s %.4f m, %zu niches\n", joint.c_str(), 0.02 * step,
                nearest->origin->name.c_str(), nearest->solution.distance, nearest->solution.niches.size());
  }
  return 0;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "track_robot: %s\n", problem.what());
  return 1;
}
