// Contact scenes with a closed form, in our simulation and in independent engines: error and time.
//
//   engine_table [--scenes name,name,...] [--output doc/results/engine_table.csv]
#include "benchmark/engines/engine_table.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "benchmark/support/benchmark_main.h"
#include "concave_distance/base/error.h"

namespace concave_distance::benchmark {
namespace {

std::vector<TableEngine> allEngines() {
  std::vector<TableEngine> all = {{"concave_distance", runOwnTable}};
  for (const auto& engines : {simbodyEngines(), odeEngines(), bulletEngines()}) {
    all.insert(all.end(), engines.begin(), engines.end());
  }
  return all;
}

void writeLine(std::ofstream& csv, const TableScene& scene, const std::string& engine, const TableRun& run,
               double found) {
  csv << scene.name << ',' << scene.what << ',' << scene.unit << ',' << scene.formula << ',' << engine << ','
      << scene.expected << ',';
  if (std::isnan(found)) {
    csv << ',';
  } else {
    csv << found << ',' << std::abs(found - scene.expected);
  }
  csv << ',' << run.seconds / run.bodies.front().back().time << ',' << (run.complete ? "yes" : "no") << '\n';
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Our simulation beside independent engines on the same scenes");
  std::vector<std::string> names;
  std::string output;
  app.add_option("--scenes", names, "Some of the scenes; default: all")->delimiter(',');
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);
  std::ofstream csv;
  if (!output.empty()) {
    csv.open(output);
    if (!csv) throw Error(output, "cannot be written", "name a file in a folder that is there");
    csv << "scene,what,unit,formula,engine,expected,found,error,seconds_per_second,complete\n";
  }
  std::printf("%-16s %-46s %-6s %-22s %12s %12s %12s %18s\n", "scene", "what", "unit", "engine", "expected",
              "found", "error", "seconds a second");
  for (const TableScene& scene : tableScenes()) {
    if (!names.empty() && std::find(names.begin(), names.end(), scene.name) == names.end()) continue;
    for (const TableEngine& engine : allEngines()) {
      const TableRun run = engine.run(scene);
      const double found = scene.figure(run);
      const double simulated = run.bodies.front().back().time;
      std::printf("%-16s %-46s %-6s %-22s %12.6g %12.6g %12.3g %18.3g%s\n", scene.name.c_str(),
                  scene.what.c_str(), scene.unit.c_str(), engine.name.c_str(), scene.expected, found,
                  std::abs(found - scene.expected), run.seconds / simulated,
                  run.complete ? "" : " (not finished)");
      std::fflush(stdout);
      if (csv.is_open()) writeLine(csv, scene, engine.name, run, found);
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark
