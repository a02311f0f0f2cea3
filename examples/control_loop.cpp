// A controller's loop at 1 kHz that slows a tool down near a fixture: everything is prepared before the loop.
//   control_loop tool.stl fixture.stl
#include <concave_distance/loading/load_body_mesh.h>
#include <concave_distance/tracking/pair_tracker.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <thread>

int main(int argc, char** argv) try {
  using namespace concave_distance;
  using Clock = std::chrono::steady_clock;
  if (argc != 3) return std::fputs("usage: control_loop tool.stl fixture.stl\n", stderr), 2;
  const auto tool = loadBodyMesh(argv[1]).mesh;
  const auto fixture = loadBodyMesh(argv[2]).mesh;

  TrackerParameters parameters;
  parameters.time_budget = 500e-6;  // a cycle ends then, with a bound that holds
  PairTracker tracker("fixture/tool", fixture, tool, parameters);
  PairSolution solution;

  // The tool stands above the fixture and comes down.
  double height = fixture->diameter() + tool->diameter();
  tracker.prepare({Eigen::Isometry3d(Eigen::Translation3d(0, 0, height)),
                   Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.5 * height))});

  const double step = 1e-3;
  double slowest = 0.0;
  double speed = 0.0;
  Clock::time_point next = Clock::now();
  for (int cycle = 1; cycle <= 2000; ++cycle) {
    next += std::chrono::milliseconds(1);
    std::this_thread::sleep_until(next);
    height -= speed * step;
    tracker.update(Eigen::Isometry3d(Eigen::Translation3d(0, 0, height)), cycle * step, solution);
    // The bound holds even when a cycle ends early: never faster than what stops within it.
    speed = std::min(0.5, 2.0 * solution.lower_bound);
    slowest = std::max(slowest, solution.solve_seconds);
  }
  std::printf("%.4f m left, %zu niches, slowest cycle %.0f us\n", solution.distance, solution.niches.size(),
              1e6 * slowest);
  return 0;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "control_loop: %s\n", problem.what());
  return 1;
}
