#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>

#include "base/output_file.h"
#include "base/run_together.h"
#include "base/run_tool.h"
#include "base/versions.h"
#include "concave_distance/loading/load_body_mesh.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "loading/query_poses.h"
#include "parameter_options.h"
#include "query_report.h"
#include "scene/pair_parameters.h"
#include "tracking/tracker_parameter_table.h"

namespace concave_distance::tools {
namespace {

/// The tool's defaults: more niches than any scene of rigid bodies has shown; a cut is logged.
PairSettings querySettings() {
  PairSettings settings;
  settings.tracker.largest_niche_count = 1000;
  return settings;
}

struct DistanceQueryOptions {
  std::string mesh_a;
  std::string mesh_b;
  std::string poses;
  double scale_a = 1.0;
  double scale_b = 1.0;
  PairSettings settings = querySettings();
  std::optional<double> max_edge_length;  ///< metres; grid of the search, both bodies
  bool tracking = false;
  std::string output;
  std::string niches_output;  ///< empty: niches are not asked for
};

/// Keys the random streams: fixed, so that an answer depends on the meshes, the pose and the seed alone.
constexpr const char* kPairName = "distance_query";

std::shared_ptr<const BodyMesh> loadBody(const std::string& path, double scale,
                                         const LoadMeshOptions& options, std::ostream& log) {
  LoadedBodyMesh loaded = loadBodyMesh(path, scale, options);
  if (const std::string summary = loaded.repair.summary(); !summary.empty()) {
    log << path << ": " << summary << '\n';
  }
  return std::move(loaded.mesh);
}

struct LoadedBodies {
  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
};

LoadedBodies loadBodies(const DistanceQueryOptions& options, std::ostream& log) {
  LoadMeshOptions load_options;
  load_options.body.max_edge_length = options.max_edge_length;
  LoadedBodies bodies;
  std::ostringstream log_b;  // both at once, what they say one after the other
  runTogether({[&] { bodies.a = loadBody(options.mesh_a, options.scale_a, load_options, log); },
               [&] { bodies.b = loadBody(options.mesh_b, options.scale_b, load_options, log_b); }});
  log << log_b.str();
  requireMargin("--margin-a", options.settings.tracker.margin_a, *bodies.a);
  requireMargin("--margin-b", options.settings.tracker.margin_b, *bodies.b);
  return bodies;
}

/// Solves pose after pose; without tracking each as if it were the first.
class Solver {
 public:
  Solver(const DistanceQueryOptions& options, std::ostream& log)
      : tracker_(makeTracker(options, loadBodies(options, log))), tracking_(options.tracking) {}

  /// Microseconds of the query alone: everything between the loaded bodies and the answer.
  double solve(const Eigen::Isometry3d& pose, double time) {
    const auto start = std::chrono::steady_clock::now();
    if (tracking_) {
      tracker_.update(pose, time, solution_);
    } else {
      tracker_.solve(pose, solution_);
    }
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  }

  const PairSolution& solution() const { return solution_; }

 private:
  static PairTracker makeTracker(const DistanceQueryOptions& options, const LoadedBodies& bodies) {
    TrackerParameters parameters = options.settings.tracker;
    parameters.niches_wanted = !options.niches_output.empty();
    return {kPairName, bodies.a, bodies.b, parameters};
  }

  PairTracker tracker_;
  bool tracking_;
  PairSolution solution_;
};

/// Answers every line of `poses`; what was found while loading goes to `log`.
/// @throws Error naming the file, for tracking also the line, that is at fault
void runDistanceQuery(const DistanceQueryOptions& options, std::ostream& log) {
  requireDistinctFiles(
      {{"--mesh-a", options.mesh_a}, {"--mesh-b", options.mesh_b}, {"--poses", options.poses}},
      {{"--output", options.output}, {"--niches-output", options.niches_output}});
  const std::vector<QueryPose> poses = readQueryPoses(options.poses);
  Solver solver(options, log);
  const bool with_margins = options.settings.tracker.margin() > 0.0;
  AnswerWriter answers(options.output, with_margins);
  std::unique_ptr<NicheWriter> niches;
  if (!options.niches_output.empty())
    niches = std::make_unique<NicheWriter>(options.niches_output, with_margins);
  std::size_t cut_lists = 0;
  for (std::size_t index = 0; index < poses.size(); ++index) {
    QueryAnswer answer;
    const std::optional<Eigen::Isometry3d> pose = poseOf(poses[index]);
    if (!pose) {
      answer.status = toString(SolveStatus::InvalidPose);
      answers.write(index, answer);
      continue;
    }
    const double time_us = solver.solve(*pose, poses[index].time);
    const PairSolution& solution = solver.solution();
    answer = answerOf(solution, niches != nullptr);
    answer.time_us = time_us;
    if (answer.niche_count) {
      cut_lists += solution.niches_cut ? 1 : 0;
      std::uint64_t rank = 0;
      for (const TrackedNiche& niche : solution.niches) {
        niches->write(index, options.tracking ? niche.id : rank, niche,
                      options.settings.tracker.accuracy != AccuracyLevel::Nodes);
        ++rank;
      }
    }
    answers.write(index, answer);
  }
  answers.complete();
  if (niches) niches->complete();
  answers.finish();
  if (niches) niches->finish();
  if (cut_lists > 0) {
    log << cut_lists << " queries have more niches than the " << options.settings.tracker.largest_niche_count
        << " that are listed; give a --cutoff or --largest-niche-count\n";
  }
}

constexpr const char* kToleranceOption = "--tolerance";

/// Stopping early only means something where a bound is proven.
void refuseOnUnprovenLevels(const CLI::App& app, const std::string& option, AccuracyLevel level) {
  if (app.count(option) == 0 || provesDistance(level)) return;
  throw CLI::ValidationError(option, "stops a proof early, and --accuracy " + std::string(toString(level)) +
                                         " proves no bound; leave it out or ask for --accuracy certified");
}

void addOptions(CLI::App& app, DistanceQueryOptions& options) {
  app.add_option("--mesh-a", options.mesh_a, "body A (.stl, .obj, .ply, .dae)")
      ->required()
      ->type_name("FILE");
  app.add_option("--mesh-b", options.mesh_b, "body B")->required()->type_name("FILE");
  app.add_option("--poses", options.poses,
                 std::string("header t,x,y,z,qx,qy,qz,qw or ") + kMatrixPoseHeader +
                     "; a query a line: pose of B in A's frame")
      ->required()
      ->type_name("FILE");
  app.add_option("--scale-a", options.scale_a,
                 "factor on A's coordinates (0.001: the file is in millimetres)")
      ->capture_default_str();
  app.add_option("--scale-b", options.scale_b, "the same for B")->capture_default_str();
  for (const char* margin : {"margin_a", "margin_b"}) {
    addParameter(app, marginParameters(), margin, options.settings.tracker);
  }
  const auto add = [&](const char* parameter, const char* name = "") {
    return addParameter(app, pairParameters(), parameter, options.settings, name);
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
  app.add_flag("--tracking", options.tracking,
               "lines are successive instants of one motion: warm starts, persistent niche numbers");
  app.add_option(
         "--output", options.output,
         "index,distance,lower_bound,ax,ay,az,bx,by,bz,niche_count,status,time_us,triangle_a,triangle_b; "
         "with margins and signed_distance")
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
  app.set_version_flag("--version", versionsText());
  addOptions(app, options);
  try {
    app.parse(argc, argv);
    for (const std::string option : {kToleranceOption, "--relative-tolerance"}) {
      refuseOnUnprovenLevels(app, option, options.settings.tracker.accuracy);
    }
  } catch (const CLI::ParseError& error) {
    return reportParseError(app, error);
  }
  runDistanceQuery(options, std::cerr);
  return 0;
}

}  // namespace
}  // namespace concave_distance::tools

int main(int argc, char** argv) {
  return concave_distance::runTool("distance_query", argc, argv, concave_distance::tools::run);
}
