// Scenes of contact, each beside its closed form or bound.
//
//   contact_scenes [--scenes NAME,NAME] [--output FILE.csv] [--wall 60] [--list]
//
// A row is one figure of a scene. `error`: |found - expected| in the row's unit, or what is missing to a
// least value; `within`: whether that is at most `bound`: `no` also where the run failed, `cut` where nothing
// is wrong but the run did not reach its end, empty where the figure is only noted. `formula` names the
// closed form, or what the bound comes from. Where a simulation ran: simulated over processor time, steps,
// the smallest one in seconds, what held back most of them, the largest error of the energy balance over the
// energy turned over (kinetic plus all works), the shares of the wall time by stage, and what ended it. A
// simulation that takes longer than `--wall` seconds is cut. Materials, forces and steps are the defaults
// unless a row or the scene's source says otherwise. Times compare within one machine only.
#include "benchmark/contact_scenes.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "benchmark/support/benchmark_main.h"
#include "concave_distance/base/error.h"

namespace concave_distance::benchmark {
namespace {

ContactScenes allScenes() {
  ContactScenes all;
  for (const auto& group : {overlapScenes(), impactScenes(), restScenes(), frictionScenes(), rollingScenes(),
                            elasticScenes(), balanceScenes(), untouchedScenes(), speedScenes()}) {
    all.insert(all.end(), group.begin(), group.end());
  }
  return all;
}

/// @throws Error for a name that no scene has
ContactScenes selected(const std::vector<std::string>& names) {
  ContactScenes all = allScenes();
  if (names.empty()) return all;
  ContactScenes some;
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&name](const ContactScene& scene) { return scene.name == name; });
    if (found == all.end()) throw Error("--scenes", "there is no scene '" + name + "'", "see --list");
    some.push_back(*found);
  }
  return some;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Scenes of contact beside their closed forms and bounds");
  std::vector<std::string> names;
  std::string output;
  double wall_limit = 60.0;
  bool list = false;
  app.add_option("--scenes", names, "Some of the scenes; default: all")->delimiter(',');
  app.add_option("--output", output, "CSV file to write");
  app.add_option("--wall", wall_limit, "Seconds that one simulation may take")->check(CLI::PositiveNumber);
  app.add_flag("--list", list, "Name the scenes and end");
  CLI11_PARSE(app, argc, argv);
  const ContactScenes scenes = selected(names);
  if (list) {
    for (const ContactScene& scene : scenes)
      std::printf("%-30s %s\n", scene.name.c_str(), scene.about.c_str());
    return 0;
  }
  SceneReport report(output, wall_limit);
  for (const ContactScene& scene : scenes) {
    report.begin(scene.name);
    scene.run(report);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
