#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "concave_distance/base/output_file.h"
#include "distance_query_run.h"

namespace {

using concave_distance::AccuracyLevel;
using concave_distance::tools::DistanceQueryOptions;

constexpr int kFileProblem = 1;
constexpr int kWrongCommandLine = 2;

struct CommandLine {
  DistanceQueryOptions options;
  std::string accuracy = "certified";
};

AccuracyLevel accuracyOf(const std::string& name) {
  if (name == "nodes") return AccuracyLevel::Nodes;
  if (name == "refined") return AccuracyLevel::Refined;
  if (name == "certified") return AccuracyLevel::Certified;
  if (name == "complete") return AccuracyLevel::Complete;
  throw CLI::ValidationError("--accuracy",
                             "'" + name + "' is none of the levels: nodes, refined, certified, complete");
}

/// Stopping early only means something where a bound is proven.
void refuseOnUnprovenLevels(const CLI::App& app, const char* option, const CommandLine& line) {
  if (app.count(option) == 0 || concave_distance::provesDistance(line.options.accuracy)) return;
  throw CLI::ValidationError(
      option, "stops a proof early, and --accuracy " + line.accuracy +
                  " proves no bound; leave it out or ask for --accuracy certified or complete");
}

void addOptions(CLI::App& app, CommandLine& line) {
  DistanceQueryOptions& options = line.options;
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
  app.add_option(
         "--accuracy", line.accuracy,
         "nodes: between the nodes of the search grids; refined: exact local minima over the triangles; "
         "certified: the distance with a proof; complete: every niche below the cutoff, with a proof")
      ->capture_default_str()
      ->type_name("LEVEL");
  app.add_option("--cutoff", options.cutoff, "niches farther than this are not listed, metres")
      ->check(CLI::PositiveNumber);
  app.add_option("--least-prominence", options.least_prominence,
                 "niches with less are part of their deeper neighbour")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--prominence-limit", options.prominence_limit,
                 "complete: prominences are measured up to this (0: none; inf: all below the cutoff, which "
                 "takes long)")
      ->check([](const std::string& text) -> std::string {
        double value = 0.0;
        const bool fits = CLI::detail::lexical_cast(text, value) && value >= 0.0;
        return fits ? "" : "'" + text + "' is no number from 0, nor inf";
      })
      ->capture_default_str();
  app.add_option("--tolerance", options.absolute_tolerance,
                 "certified, complete: the proven lower bound may stay this far below the distance, metres")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--relative-tolerance", options.relative_tolerance,
                 "the same as a share of the distance; the larger of the two counts")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--time-budget", options.time_budget,
                 "seconds after which a query ends with its results so far")
      ->check(CLI::PositiveNumber);
  app.add_option("--max-edge", options.max_edge_length,
                 "longest edge of the search grids, metres (automatic)")
      ->check(CLI::PositiveNumber);
  app.add_option("--cache", options.cache,
                 "folder that keeps what was prepared of a mesh for the next run, or off "
                 "($XDG_CACHE_HOME/concave_distance, ~/.cache/concave_distance)")
      ->type_name("DIR|off");
  app.add_flag("--tracking", options.tracking,
               "lines are successive instants of one motion: warm starts, persistent niche numbers");
  app.add_option("--seed", options.seed, "of the random streams: one seed, one answer")
      ->check([](const std::string& text) -> std::string {
        const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
        return digits ? "" : "'" + text + "' is not a whole number";
      })
      ->capture_default_str();
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
  CommandLine line;
  CLI::App app("Distance and niches of two meshes at a list of poses. Metres, seconds; points in A's frame.",
               "distance_query");
  app.footer(
      "An empty cell was not computed. Status: ok, tolerance, budget, memory, penetrating, invalid_pose.\n"
      "Exit status: 0 done, 1 a file is at fault, 2 the command line is.");
  addOptions(app, line);
  try {
    app.parse(argc, argv);
    line.options.accuracy = accuracyOf(line.accuracy);
    for (const char* option : {"--tolerance", "--relative-tolerance"}) {
      refuseOnUnprovenLevels(app, option, line);
    }
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kWrongCommandLine;
  }
  runDistanceQuery(line.options, std::cerr);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    concave_distance::ignoreClosedPipes();
    const int status = run(argc, argv);
    concave_distance::finishStandardOutput();
    return status;
  } catch (const std::exception& error) {
    std::cerr << "distance_query: " << error.what() << '\n';
    return kFileProblem;
  }
}
