// A controller's loop at 1 kHz that slows a tool down near a fixture: everything is prepared before the loop.
//   control_loop tool.stl fixture.stl
#include <concave_distance/loading/load_body_mesh.h>
#include <concave_distance/scene/scene_tracker.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <thread>

namespace {

using namespace concave_distance;

SceneBody bodyOf(const char* name, const char* file) {
  SceneBody body;
  body.name = body.frame = name;
  body.serial = newBodySerial();
  body.mesh = loadBodyMesh(file).mesh;
  body.bounds = boundsOf(*body.mesh);
  return body;
}

}  // namespace

int main(int argc, char** argv) try {
  using Clock = std::chrono::steady_clock;
  if (argc != 3) return std::fputs("usage: control_loop tool.stl fixture.stl\n", stderr), 2;
  Scene scene;
  scene.bodies.push_back(bodyOf("fixture", argv[2]));
  scene.bodies.push_back(bodyOf("tool", argv[1]));
  ScenePair pair;
  pair.name = "fixture/tool";
  pair.body_b = 1;
  scene.pairs.push_back(pair);
  SceneTracker tracker({1, nullptr});  // the loop's thread and no other
  tracker.setScene(scene);

  // The tool stands above the fixture and comes down.
  double height = scene.bodies[0].mesh->diameter() + scene.bodies[1].mesh->diameter();
  const auto poses = [&](double z) -> std::vector<std::optional<Eigen::Isometry3d>> {
    return {Eigen::Isometry3d::Identity(), Eigen::Isometry3d(Eigen::Translation3d(0, 0, z))};
  };
  tracker.prepare(poses(0.5 * height), -1.0);
  tracker.prepare(poses(height), 0.0);
  auto now = poses(height);

  const double step = 1e-3;
  double slowest = 0.0;
  double speed = 0.0;
  const PairSolution& solution = tracker.pairs()[0]->solution;
  Clock::time_point next = Clock::now();
  for (int cycle = 1; cycle <= 2000; ++cycle) {
    next += std::chrono::milliseconds(1);
    std::this_thread::sleep_until(next);
    height -= speed * step;
    now[1]->translation().z() = height;
    const Clock::time_point start = Clock::now();
    tracker.update(now, cycle * step, {true, true, true, false}, start + std::chrono::microseconds(500));
    slowest = std::max(slowest, std::chrono::duration<double>(Clock::now() - start).count());
    // The bound holds even when a cycle ends early: never faster than what stops within it.
    speed = std::min(0.5, 2.0 * solution.lower_bound);
  }
  std::printf("%.4f m left, %zu niches, slowest cycle %.0f us\n", solution.distance, solution.niches.size(),
              1e6 * slowest);
  return 0;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "control_loop: %s\n", problem.what());
  return 1;
}
