#include <CLI/CLI.hpp>
#include <iostream>
#include <string>

#include "base/run_tool.h"
#include "distance_query_run.h"
#include "parameter_options.h"
#include "scene/pair_parameters.h"

namespace {

using concave_distance::AccuracyLevel;
using concave_distance::tools::addParameter;
using concave_distance::tools::DistanceQueryOptions;

constexpr const char* kToleranceOption = "--tolerance";

/// Stopping early only means something where a bound is proven.
void refuseOnUnprovenLevels(const CLI::App& app, const std::string& option, AccuracyLevel level) {
  if (app.count(option) == 0 || concave_distance::provesDistance(level)) return;
  throw CLI::ValidationError(option, "stops a proof early, and --accuracy " + std::string(toString(level)) +
                                         " proves no bound; leave it out or ask for --accuracy certified");
}

void addOptions(CLI::App& app, DistanceQueryOptions& options) {
  app.add_option("--mesh-a", options.mesh_a, "body A (.stl, .obj, .ply, .dae)")
      ->required()
      ->type_name("FILE");
  app.add_option("--mesh-b", options.mesh_b, "body B")->required()->type_name("FILE");
  app.add_option("--poses", options.poses,
                 "header t,x,y,z,qx,qy,qz,qw; a query a line: pose of B in A's frame")
      ->required()
      ->type_name("FILE");
  app.add_option("--scale-a", options.scale_a,
                 "factor on A's coordinates (0.001: the file is in millimetres)")
      ->capture_default_str();
  app.add_option("--scale-b", options.scale_b, "the same for B")->capture_default_str();
  const auto add = [&](const char* parameter, const char* name = "") {
    return addParameter(app, concave_distance::pairParameters(), parameter, options.settings, name);
  };
  add("accuracy");
  add("cutoff");
  app.add_flag(
      "--hidden", [&options](std::int64_t) { options.settings.tracker.hidden = true; },
      "list niches whose segment meets a surface too");
  add("least_prominence");
  add("prominence_limit");
  add("largest_niche_count");
  add("absolute_tolerance", kToleranceOption);
  add("relative_tolerance");
  add("time_budget");
  add("seed");
  app.add_option("--max-edge", options.max_edge_length,
                 "longest edge of the search grids, metres (automatic)")
      ->check(CLI::PositiveNumber);
  app.add_option("--cache", options.cache,
                 "folder that keeps what was prepared of a mesh for the next run, or off "
                 "($XDG_CACHE_HOME/concave_distance, ~/.cache/concave_distance)")
      ->type_name("DIR|off");
  app.add_flag("--tracking", options.tracking,
               "lines are successive instants of one motion: warm starts, persistent niche numbers");
  app.add_option(
         "--output", options.output,
         "index,distance,lower_bound,ax,ay,az,bx,by,bz,niche_count,status,time_us,triangle_a,triangle_b")
      ->required()
      ->type_name("FILE");
  app.add_option(
         "--niches-output", options.niches_output,
         "index,niche,distance,ax,ay,az,bx,by,bz,kind,extent,outward,visible,prominence; without it no "
         "niches are computed")
      ->type_name("FILE");
}

int run(int argc, char** argv) {
  DistanceQueryOptions options;
  CLI::App app("Distance and niches of two meshes at a list of poses. Metres, seconds; points in A's frame.",
               "distance_query");
  app.footer(
      "An empty cell was not computed. Status: ok, tolerance, budget, memory, penetrating, invalid_pose.\n"
      "Exit status: 0 done, 1 a file is at fault, 2 the command line is.");
  addOptions(app, options);
  try {
    app.parse(argc, argv);
    for (const std::string option : {kToleranceOption, "--relative-tolerance"}) {
      refuseOnUnprovenLevels(app, option, options.settings.tracker.accuracy);
    }
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : concave_distance::kWrongCommandLine;
  }
  runDistanceQuery(options, std::cerr);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return concave_distance::runTool("distance_query", argc, argv, run);
}
