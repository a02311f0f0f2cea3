#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "base/output_file.h"
#include "base/run_tool.h"
#include "base/versions.h"
#include "concave_distance/base/error.h"
#include "concave_distance/loading/load_scene.h"
#include "concave_distance/simulation/simulation.h"
#include "parameter_options.h"
#include "scene/simulation_parameters.h"
#include "scene_options.h"
#include "simulation_log.h"
#include "slow_simulation.h"

namespace {

using namespace concave_distance;
using Clock = std::chrono::steady_clock;

constexpr int kDiverged = 3;
constexpr int kUnbalanced = 4;
constexpr double kProgressSeconds = 0.5;

struct Options {
  std::string scene;
  std::string output;
  std::string contacts;
  std::string niches;
  SimulationSettings given;  ///< where the option is given
  bool progress = false;
};

void addOptions(CLI::App& app, Options& options) {
  app.add_option("scene", options.scene, "scene file with a section `simulation`")
      ->required()
      ->type_name("FILE");
  app.add_option("--output", options.output, "CSV: energies, poses, velocities, pairs; a line each log time")
      ->required()
      ->type_name("FILE");
  app.add_option("--contacts", options.contacts, "CSV: every region of overlap with its forces")
      ->type_name("FILE");
  app.add_option("--niches", options.niches, "CSV: every niche of every pair")->type_name("FILE");
  for (const Parameter<SimulationSettings>& parameter : simulationParameters()) {
    tools::addParameter(app, parameter, options.given)->default_str("the scene's");
  }
  app.add_flag("--progress", options.progress, "show simulated time and real-time factor on the way");
}

SimulationSettings settingsOf(const Scene& scene, const CLI::App& app, const Options& options) {
  if (!scene.simulation) {
    throw Error(options.scene, "there is no section `simulation`", "add one: doc/scene_file.md");
  }
  SimulationSettings settings = *scene.simulation;
  for (const Parameter<SimulationSettings>& parameter : simulationParameters()) {
    if (app.count(tools::optionName(parameter.info.name)) == 0) continue;
    parameter.set(settings, parameter.get(options.given));
  }
  return settings;
}

void printWarnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << '\n';
}

Scene load(const Options& options) {
  SceneLoadOptions load_options;
  load_options.package_locator = packagePathFromEnvironment;
  Scene scene = loadSceneFile(options.scene, load_options);
  printWarnings(scene.warnings);
  return scene;
}

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void showProgress(const Simulation& simulation, Clock::time_point start) {
  const double seconds = since(start);
  std::fprintf(stderr, "\rt = %.4f of %.4f s, real-time factor %.3f, %llu steps ", simulation.time(),
               simulation.settings().duration, simulation.time() / seconds,
               static_cast<unsigned long long>(simulation.counters().steps));
  std::fflush(stderr);
}

void summarise(const Simulation& simulation, double loop_seconds) {
  const SimulationCounters& counters = simulation.counters();
  const auto share = [&](double seconds) { return 100.0 * seconds / loop_seconds; };
  std::printf("simulated %.6g s in %.3f s: real-time factor %.3f\n", simulation.time(), loop_seconds,
              simulation.time() / loop_seconds);
  std::printf(
      "steps %llu (%.1f us each), smallest %.3g s, done again %llu before and %llu after they were solved, "
      "with "
      "contact %llu\n",
      static_cast<unsigned long long>(counters.steps),
      1e6 * loop_seconds / static_cast<double>(std::max<std::uint64_t>(1, counters.steps)),
      counters.smallest_step, static_cast<unsigned long long>(counters.shortened),
      static_cast<unsigned long long>(counters.rejected),
      static_cast<unsigned long long>(counters.contact_steps));
  std::printf("steps held back by:");
  for (std::size_t i = 0; i < kStepLimits; ++i) {
    std::printf(" %s %llu", std::string(toString(static_cast<StepLimit>(i))).c_str(),
                static_cast<unsigned long long>(counters.limited_by[i]));
  }
  double inside = 0.0;
  std::printf("\nshare of time:");
  for (std::size_t i = 0; i < kSimulationStages; ++i) {
    std::printf(" %s %.1f %%", std::string(toString(static_cast<SimulationStage>(i))).c_str(),
                share(counters.seconds[i]));
    inside += counters.seconds[i];
  }
  std::printf(" writing %.1f %%\n", share(std::max(0.0, loop_seconds - inside)));
  const EnergyAccount& energy = simulation.energy();
  std::printf("energy: mechanical %.9g J, at the start %.9g J, balance error %.3g J (%.2g %% of %.3g J)\n",
              energy.mechanical(), energy.initial, energy.balanceError(), 100.0 * energy.balanceShare(),
              energy.throughput());
  std::printf("largest depth %.3g m, largest drift of a quaternion's norm in a step %.2g\n",
              counters.largest_depth, counters.largest_quaternion_drift);
}

int statusOf(const Simulation& simulation) {
  if (simulation.status() != SimulationStatus::Ok) {
    std::cerr << "simulate: diverged at t = " << simulation.time() << " s\n";
    return kDiverged;
  }
  if (simulation.energyIsBalanced()) return 0;
  std::cerr << "simulate: the energy balance is off by " << simulation.energy().balanceError() << " J, "
            << 100.0 * simulation.energy().balanceShare() << " % of the energy that went through (allowed: "
            << 100.0 * simulation.settings().energy_tolerance
            << " %); make step_fraction smaller, then largest_step, or choose elastic_foundation for flat "
               "faces\n";
  return kUnbalanced;
}

int simulate(const CLI::App& app, const Options& options) {
  requireDistinctFiles(
      {{"the scene", options.scene}},
      {{"--output", options.output}, {"--contacts", options.contacts}, {"--niches", options.niches}});
  const Scene scene = load(options);
  Simulation simulation(scene, settingsOf(scene, app, options));
  printWarnings(simulation.warnings());
  tools::TrajectoryLog trajectory(options.output, simulation);
  std::unique_ptr<tools::ContactLog> contacts;
  std::unique_ptr<tools::NicheLog> niches;
  if (!options.contacts.empty()) contacts = std::make_unique<tools::ContactLog>(options.contacts);
  if (!options.niches.empty()) niches = std::make_unique<tools::NicheLog>(options.niches);
  const Clock::time_point start = Clock::now();
  Clock::time_point shown = start;
  const double duration = simulation.settings().duration;
  for (std::uint64_t line = 1;; ++line) {
    trajectory.write(simulation);
    if (contacts) contacts->write(simulation);
    if (niches) niches->write(simulation);
    if (options.progress && since(shown) > kProgressSeconds) {
      showProgress(simulation, start);
      shown = Clock::now();
    }
    if (simulation.time() >= duration || simulation.status() != SimulationStatus::Ok) break;
    simulation.advanceTo(std::min(duration, static_cast<double>(line) / simulation.settings().log_rate));
  }
  const double seconds = since(start);
  if (options.progress) {
    showProgress(simulation, start);
    std::fputc('\n', stderr);
  }
  trajectory.complete();
  if (contacts) contacts->complete();
  if (niches) niches->complete();
  trajectory.finish();
  if (contacts) contacts->finish();
  if (niches) niches->finish();
  summarise(simulation, seconds);
  const std::string slow = tools::whatHeldBack(simulation, seconds);
  if (!slow.empty()) std::cerr << "simulate: " << slow << '\n';
  return statusOf(simulation);
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app("Rigid bodies of a scene in contact over time. Metres, seconds, newtons.", "simulate");
  app.footer(
      "An empty cell was not computed.\n"
      "Exit status: 0 done, 1 a file is at fault, 2 the command line is, 3 the simulation diverged, 4 the "
      "error "
      "of the energy balance is above energy_tolerance.");
  app.set_version_flag("--version", versionsText());
  addOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return concave_distance::reportParseError(app, error);
  }
  return simulate(app, options);
}

}  // namespace

int main(int argc, char** argv) {
  return concave_distance::runTool("simulate", argc, argv, run);
}
