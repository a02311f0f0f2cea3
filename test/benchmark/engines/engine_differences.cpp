// The same scenes in our simulation and in independent engines: trajectories side by side and closed forms.
#include "benchmark/engines/differences_summary.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "benchmark/engines/engine_table.h"
#include "benchmark/support/benchmark_main.h"
#include "concave_distance/base/error.h"

namespace concave_distance::benchmark {
namespace {

constexpr std::size_t kLineEvery = 5;  // samples to a line of the CSV file

std::vector<Run> runsOf(const ComparedScene& scene) {
  std::vector<Run> runs;
  runs.push_back({"concave_distance", runOwn(scene, kRate)});
  runs.push_back({"simbody", runSimbody(scene, kRate)});
  runs.push_back({"ode", runOde(scene, kRate)});
  OwnOptions finer;
  finer.step_scale = 0.5;
  runs.push_back({"concave_distance, half steps", runOwn(scene, kRate, finer), true});
  if (scene.shape == ComparedShape::Box) {
    ComparedScene regularised = scene;
    regularised.scene.pairs.edit(0).settings.effects.friction.model = FrictionModel::RegularisedCoulomb;
    runs.push_back({"concave_distance, regularised", runOwn(regularised, kRate), true});
  }
  if (scene.shape == ComparedShape::Sphere) {
    OwnOptions turned;
    turned.turned = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 0.5).normalized());
    runs.push_back({"concave_distance, ball turned", runOwn(scene, kRate, turned), true});
  }
  SimbodyOptions as_is;
  as_is.convert = false;
  runs.push_back({"simbody, numbers as they are", runSimbody(scene, kRate, as_is), true});
  if (scene.shape != ComparedShape::Sphere) {
    ComparedScene fine = scene;
    fine.spring_spacing *= 0.5;
    runs.push_back({"simbody, springs twice as dense", runSimbody(fine, kRate), true});
  }
  OdeOptions coarse;
  coarse.step = 1e-3;
  runs.push_back({"ode, steps of 1 ms", runOde(scene, kRate, coarse), true});
  return runs;
}

void printDifferences(const ComparedScene& scene, const std::vector<Run>& runs) {
  const Trajectory& own = runs[0].trajectory;
  const double energy_scale =
      std::abs(mechanicalEnergy(scene, own.front()) - mechanicalEnergy(scene, own.back()));
  std::printf("  %-32s %14s %14s %14s %14s %18s\n", "largest differences from ours", "place, mm",
              "speed, m/s", "pitch, rad", "energy, J", "energy gained, J");
  for (const Run& run : runs) {
    double place = 0.0;
    double speed = 0.0;
    double pitch = 0.0;
    double energy = 0.0;
    double gained = 0.0;
    double least = mechanicalEnergy(scene, run.trajectory.front());
    for (std::size_t i = 0; i < own.size(); ++i) {
      const EngineSample& there = run.trajectory[i];
      place = std::max(place, (there.centre - own[i].centre).norm());
      speed = std::max(speed, (there.velocity - own[i].velocity).norm());
      pitch = std::max(pitch, std::abs(there.pitch() - own[i].pitch()));
      const double now = mechanicalEnergy(scene, there);
      energy = std::max(energy, std::abs(now - mechanicalEnergy(scene, own[i])));
      gained = std::max(gained, now - mechanicalEnergy(scene, run.trajectory.front()));
      least = std::min(least, now);
    }
    std::printf("  %-32s %14.4f %14.4g %14.4g %14.4g %18.3g\n", run.engine.c_str(), 1e3 * place, speed, pitch,
                energy, gained);
  }
  std::printf("  energy that ours has lost at the end: %.4g J\n\n", energy_scale);
}

void writeLines(std::ofstream& csv, const ComparedScene& scene, const Run& run) {
  char line[512];
  for (std::size_t i = 0; i < run.trajectory.size(); i += kLineEvery) {
    const EngineSample& s = run.trajectory[i];
    std::snprintf(line, sizeof line, "%s,%s,%.4g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.7g\n",
                  scene.name.c_str(), run.engine.c_str(), s.time, s.centre.x(), s.centre.y(), s.centre.z(),
                  s.velocity.x(), s.velocity.y(), s.velocity.z(), s.pitch(), s.angular_velocity.y(),
                  mechanicalEnergy(scene, s));
    csv << line;
  }
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Our simulation beside independent engines on the same scenes");
  std::string output;
  std::string table;
  std::vector<std::string> names;
  app.add_option("--table", table, "CSV file for the table of contact scenes; runs that table alone");
  app.add_option("--output", output, "CSV file to write");
  app.add_option("--scenes", names, "Some of the scenes; default: all")->delimiter(',');
  CLI11_PARSE(app, argc, argv);
  if (!table.empty()) {
    compareInTable(names, table);
    return 0;
  }
  std::ofstream csv;
  if (!output.empty()) {
    csv.open(output);
    if (!csv) throw Error(output, "cannot be written", "name a file in a folder that is there");
    csv << "scene,engine,time,x,y,z,vx,vy,vz,pitch,pitch_rate,energy\n";
  }
  for (const ComparedScene& scene : comparedScenes()) {
    if (!names.empty() && std::find(names.begin(), names.end(), scene.name) == names.end()) continue;
    const std::vector<Run> runs = runsOf(scene);
    std::printf("%s\n", scene.name.c_str());
    switch (scene.shape) {
      case ComparedShape::Sphere:
        printBall(scene, runs);
        break;
      case ComparedShape::Box:
        printSlope(scene, runs);
        break;
      case ComparedShape::Mesh:
        printFeet(scene, runs);
        break;
    }
    printDifferences(scene, runs);
    std::fflush(stdout);
    for (const Run& run : runs) {
      if (csv.is_open() && !run.variant) writeLines(csv, scene, run);
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark
