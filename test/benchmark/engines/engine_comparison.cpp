// The contact scenes beside two independent engines: Simbody's compliant contact and ODE's constraints.
//
//   engine_comparison [--output doc/results/engines.csv]
//
// Built where libsimbody-dev and libode-dev are found. A row is a scene, an engine and a time: place (height
// of the ball's centre, way of the box down the slope; metres) and velocity. The parameters are those of
// config/bouncing_ball.yaml, box_sticks.yaml and box_slides.yaml; how each engine is told them, and why they
// differ, is in doc/simulation.md. The summary on the standard output is the largest difference from ours.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>

#include "concave_distance/scene/load_scene.h"
#include "concave_distance/simulation/simulation.h"
#include "engines.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kInterval = 0.01;  // seconds between rows

Scene load(const std::string& name) {
  SceneLoadOptions options;
  options.package_locator = [](const std::string&) { return std::string(CONCAVE_DISTANCE_SOURCE_DIR); };
  return loadSceneFile(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/config/" + name + ".yaml", options);
}

Trajectory ours(const Scene& scene, int axis, double origin) {
  Simulation simulation(scene);
  Trajectory trajectory;
  for (int line = 0; line * kInterval <= scene.simulation->duration + 1e-9; ++line) {
    simulation.advanceTo(line * kInterval);
    const SimulatedBody& body = simulation.bodies()[1];
    trajectory.push_back({simulation.time(), body.centre[axis] - origin, body.velocity[axis]});
  }
  return trajectory;
}

void compare(const std::string& scene, const std::map<std::string, Trajectory>& runs, std::ofstream& output) {
  const Trajectory& reference = runs.at("concave_distance");
  for (const auto& [engine, trajectory] : runs) {
    double largest = 0.0;
    double last = 0.0;
    for (std::size_t i = 0; i < trajectory.size(); ++i) {
      output << scene << ',' << engine << ',' << trajectory[i].time << ',' << trajectory[i].place << ','
             << trajectory[i].velocity << '\n';
      last = std::abs(trajectory[i].place - reference[i].place);
      largest = std::max(largest, last);
    }
    std::printf("%-14s %-18s largest difference %.3g m, at the end %.3g m, end %.6g m %.6g m/s\n",
                scene.c_str(), engine.c_str(), largest, last, trajectory.back().place,
                trajectory.back().velocity);
  }
}

void run(const std::string& path) {
  std::ofstream output(path);
  output.precision(9);
  output << "scene,engine,t,place,velocity\n";
  {
    const Scene scene = load("bouncing_ball");
    const SimulationSettings& settings = *scene.simulation;
    const Material& material = scene.bodies[1].material;
    BallScene ball;
    ball.radius = scene.pairs[0].settings.effects.normal_force->radius;
    ball.mass = massPropertiesOf(scene.bodies[1].mesh->surface(), *settings.bodies[0].density, "ball").mass;
    ball.height = settings.bodies[0].pose.translation().z();
    ball.contact_modulus = inContact(scene.bodies[0].material, material).contact_modulus;
    ball.dissipation = material.dissipation;
    ball.duration = settings.duration;
    ball.interval = kInterval;
    compare(
        "bouncing_ball",
        {{"concave_distance", ours(scene, 2, 0.0)}, {"simbody", simbodyBall(ball)}, {"ode", odeBall(ball)}},
        output);
  }
  for (const char* name : {"box_sticks", "box_slides"}) {
    const Scene scene = load(name);
    const SimulationSettings& settings = *scene.simulation;
    const Material& material = scene.bodies[1].material;
    BoxScene box;
    box.size = scene.bodies[1].mesh->surface().boundingBox().sizes();
    box.mass = *settings.bodies[0].mass;
    box.foundation_stiffness = scene.pairs[0].settings.effects.normal_force->foundation_stiffness;
    box.dissipation = material.dissipation;
    box.friction = material.dynamic_friction;
    box.gravity = settings.gravity;
    box.duration = settings.duration;
    box.interval = kInterval;
    compare(name,
            {{"concave_distance", ours(scene, 0, settings.bodies[0].pose.translation().x())},
             {"simbody", simbodyBox(box)},
             {"ode", odeBox(box)}},
            output);
  }
}

}  // namespace
}  // namespace concave_distance::benchmark

int main(int argc, char** argv) {
  try {
    std::string path = CONCAVE_DISTANCE_SOURCE_DIR "/doc/results/engines.csv";
    CLI::App app("The contact scenes beside Simbody and ODE.", "engine_comparison");
    app.add_option("--output", path, "CSV: scene,engine,t,place,velocity")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    concave_distance::benchmark::run(path);
  } catch (const std::exception& error) {
    std::cerr << "engine_comparison: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
