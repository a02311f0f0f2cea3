#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/csv_table.h"
#include "base/csv_writer.h"
#include "base/number_text.h"
#include "base/output_file.h"
#include "base/run_tool.h"
#include "base/versions.h"
#include "concave_distance/base/error.h"
#include "concave_distance/kinematics/clearance.h"
#include "concave_distance/loading/load_scene.h"
#include "scene_options.h"

namespace concave_distance::tools {
namespace {

constexpr const char* kPoseHeader = "t,x,y,z,qx,qy,qz,qw";

struct ClearanceQueryOptions {
  std::string scene;
  std::vector<std::string> descriptions;  ///< NAME=FILE
  std::vector<std::string> positions;     ///< JOINT=VALUE
  std::string motion;
  std::string body;
  std::string output;
  std::string pairs_output;
  std::string niches_output;
  ClearanceParameters parameters;
  bool shows_progress = false;
};

Scene load(const ClearanceQueryOptions& options) {
  SceneLoadOptions load_options;
  load_options.package_locator = packagePathFromEnvironment;
  readDescriptions(options.descriptions, load_options.descriptions, load_options.mesh_search_path);
  Scene scene = loadSceneFile(options.scene, load_options);
  for (const SceneProblem& problem : scene.problems) {
    std::cerr << "not in the scene: " << problem.where << ": " << problem.message << '\n';
  }
  for (const std::string& warning : scene.warnings) std::cerr << "warning: " << warning << '\n';
  return scene;
}

/// Every joint at rest, but for those that the command line gives.
SceneState startState(const SceneKinematics& joints, const ClearanceQueryOptions& options) {
  Eigen::VectorXd positions = joints.restPositions();
  for (const std::string& given : options.positions) {
    const auto [name, text] = assignment("--position", given);
    const auto& names = joints.positionNames();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw Error("--position", "no robot of the scene has the joint '" + name + "'",
                  "the scene's joints are " + joinedText(names, ", "));
    }
    const std::optional<double> value = parseNumber(text);
    if (!value) throw Error("--position " + name, "it is '" + text + "'", "write a number, rad or m");
    positions[found - names.begin()] = *value;
  }
  SceneState state = joints.startState();
  joints.evaluate(positions, state);
  return state;
}

PoseMotion readPoses(const CsvTable& table, const std::string& body) {
  PoseMotion motion;
  motion.body = body;
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const auto cell = [&](std::size_t column) { return table.at(row, column); };
    motion.times.push_back(cell(0));
    motion.positions.emplace_back(cell(1), cell(2), cell(3));
    motion.rotations.emplace_back(cell(7), cell(4), cell(5), cell(6));
  }
  return motion;
}

JointMotion readJoints(const CsvTable& table) {
  JointMotion motion;
  motion.joints.assign(table.columns.begin() + 1, table.columns.end());
  const auto rows = static_cast<Eigen::Index>(table.rowCount());
  motion.positions.resize(rows, static_cast<Eigen::Index>(motion.joints.size()));
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    motion.times.push_back(table.at(row, 0));
    for (std::size_t column = 0; column < motion.joints.size(); ++column) {
      motion.positions(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          table.at(row, column + 1);
    }
  }
  return motion;
}

ClearanceResult answer(const Scene& scene, const ClearanceQueryOptions& options) {
  const CsvTable table = readCsv(options.motion);
  if (table.columns.empty() || table.columns.front() != "t") {
    throw Error(options.motion, "its first column is no time",
                std::string("the header is t and the names of joints, or ") + kPoseHeader);
  }
  const bool is_path = joinedText(table.columns, ",") == kPoseHeader;
  if (is_path == options.body.empty()) {
    throw Error(options.motion,
                is_path ? "it is a path of poses, and no --body is named"
                        : "--body is named, but it is no path of poses",
                is_path ? "name the body that takes the path" : std::string("the header is ") + kPoseHeader);
  }
  const SceneKinematics joints(scene);
  const SceneState state = startState(joints, options);
  if (is_path) return findClearance(scene, joints, state, readPoses(table, options.body), options.parameters);
  return findClearance(scene, joints, state, readJoints(table), options.parameters);
}

std::string cellText(std::string name) {
  std::replace(name.begin(), name.end(), ',', ';');
  return name;
}

void writeAnswer(const Scene& scene, const ClearanceResult& result, CsvFile& file) {
  CsvWriter& cells = file.cells();
  const bool has_distance = !std::isnan(result.distance);
  const auto name = [&](bool is_known, std::size_t body) {
    return is_known ? cellText(scene.bodies[body].name) : std::string();
  };
  const FirstBelow first = result.first_below.value_or(FirstBelow());
  const bool has_first = !std::isnan(first.time);
  cells << toString(result.status) << result.distance << result.lower_bound << result.time
        << name(has_distance, result.body_a) << name(has_distance, result.body_b) << result.point_a
        << result.point_b << first.proven_until << first.time << name(has_first, first.body_a)
        << name(has_first, first.body_b) << result.queries << result.box_queries << result.seconds;
  cells.endLine();
}

void writePairs(const Scene& scene, std::vector<PairClearance> pairs, CsvFile& file) {
  std::stable_sort(pairs.begin(), pairs.end(), [](const PairClearance& left, const PairClearance& right) {
    return left.lower_bound < right.lower_bound;
  });
  for (const PairClearance& pair : pairs) {
    file.cells() << cellText(scene.bodies[pair.body_a].name) << cellText(scene.bodies[pair.body_b].name)
                 << pair.lower_bound << pair.distance << pair.time;
    file.cells().endLine();
  }
}

void writeNiches(const ClearanceResult& result, CsvFile& file) {
  if (!result.solution) return;
  std::size_t rank = 0;
  for (const TrackedNiche& niche : result.solution->niches) {
    file.cells() << rank++ << niche.distance << result.world_from_a * niche.point_a_in_a
                 << result.world_from_a * niche.point_b_in_a;
    file.cells().endLine();
  }
}

void summarise(const Scene& scene, const ClearanceResult& result) {
  const auto pair = [&](std::size_t a, std::size_t b) {
    return scene.bodies[a].name + " and " + scene.bodies[b].name;
  };
  std::printf("%s", std::string(toString(result.status)).c_str());
  if (!std::isnan(result.distance)) {
    std::printf(": %.9g m between %s at t = %.9g s, proven %.9g m", result.distance,
                pair(result.body_a, result.body_b).c_str(), result.time, result.lower_bound);
  }
  std::printf("\n%zu pairs, %llu distances and %llu bounds by boxes in %.3f s\n", result.pairs.size(),
              static_cast<unsigned long long>(result.queries),
              static_cast<unsigned long long>(result.box_queries), result.seconds);
  if (result.first_below) {
    const FirstBelow& first = *result.first_below;
    std::printf("proven not below until t = %.9g s", first.proven_until);
    if (!std::isnan(first.time)) {
      std::printf(", below at t = %.9g s: %s", first.time, pair(first.body_a, first.body_b).c_str());
    }
    std::printf("\n");
  }
  for (const std::size_t body : result.not_located) {
    std::cerr << "nothing is proven of '" << scene.bodies[body].name << "': nobody says where '"
              << scene.bodies[body].frame << "' is in the world\n";
  }
  for (const std::string& joint : result.outside_limits) {
    std::cerr << "joint '" << joint << "' leaves the range that its URDF gives\n";
  }
}

void showProgress(const ClearanceProgress& progress) {
  std::fprintf(stderr, "\rproven %5.1f %%, least distance in [%.6g, %.6g] m, %llu distances ",
               100.0 * progress.fraction, progress.lower_bound, progress.distance,
               static_cast<unsigned long long>(progress.queries));
  std::fflush(stderr);
}

void runClearanceQuery(ClearanceQueryOptions options) {
  requireDistinctFiles({{"--scene", options.scene}, {"--motion", options.motion}},
                       {{"--output", options.output},
                        {"--pairs-output", options.pairs_output},
                        {"--niches-output", options.niches_output}});
  const Scene scene = load(options);
  std::vector<std::unique_ptr<CsvFile>> files;
  const auto open = [&](const std::string& path, const char* header) -> CsvFile* {
    if (path.empty()) return nullptr;
    return files.emplace_back(std::make_unique<CsvFile>(path, header)).get();
  };
  CsvFile* const answers =
      open(options.output,
           "status,distance,lower_bound,time,body_a,body_b,ax,ay,az,bx,by,bz,proven_until,"
           "first_time,first_a,first_b,queries,box_queries,seconds");
  CsvFile* const pairs = open(options.pairs_output, "body_a,body_b,lower_bound,distance,time");
  CsvFile* const niches = open(options.niches_output, "niche,distance,ax,ay,az,bx,by,bz");
  options.parameters.niches = niches != nullptr;
  if (options.shows_progress) options.parameters.progress = showProgress;
  const ClearanceResult result = answer(scene, options);
  if (options.shows_progress) std::fputc('\n', stderr);
  if (answers != nullptr) writeAnswer(scene, result, *answers);
  if (pairs != nullptr) writePairs(scene, result.pairs, *pairs);
  if (niches != nullptr) writeNiches(result, *niches);
  for (const auto& file : files) file->complete();
  for (const auto& file : files) file->finish();
  summarise(scene, result);
}

void addOptions(CLI::App& app, ClearanceQueryOptions& options) {
  app.add_option("--scene", options.scene, "scene file")->required()->type_name("FILE");
  addDescriptionOption(app, options.descriptions, "URDF of a description");
  app.add_option("--motion", options.motion,
                 "header t and the names of joints, or t,x,y,z,qx,qy,qz,qw; a waypoint a line")
      ->required()
      ->type_name("FILE");
  app.add_option("--body", options.body, "body that takes a path of poses, in the world")->type_name("NAME");
  app.add_option("--position", options.positions,
                 "where a joint stays that the motion does not name, rad or m; else at 0")
      ->type_name("JOINT=VALUE");
  ClearanceParameters& parameters = options.parameters;
  app.add_option("--tolerance", parameters.tolerance,
                 "metres that the proven bound may stay below the distance")
      ->capture_default_str();
  app.add_option("--threshold", parameters.threshold, "metres: when is a pair below it first?");
  app.add_option("--time-budget", parameters.time_budget, "seconds (none)");
  app.add_option("--sample-limit", parameters.sample_limit, "pairs at one time that are looked at")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--each-pair", parameters.each_pair, "prove the least distance of every pair");
  app.add_option("--threads", parameters.threads, "0: one per core")->capture_default_str();
  app.add_option("--output", options.output,
                 "status,distance,lower_bound,time,body_a,body_b,ax,ay,az,bx,by,bz,proven_until,first_time,"
                 "first_a,first_b,queries,box_queries,seconds")
      ->type_name("FILE");
  app.add_option("--pairs-output", options.pairs_output,
                 "body_a,body_b,lower_bound,distance,time; a pair a line, the nearest first")
      ->type_name("FILE");
  app.add_option("--niches-output", options.niches_output,
                 "niche,distance,ax,ay,az,bx,by,bz; of the nearest pair at the least time, world frame")
      ->type_name("FILE");
  app.add_flag("--progress", options.shows_progress, "show what is proven on the way");
}

int run(int argc, char** argv) {
  ClearanceQueryOptions options;
  CLI::App app(
      "Least distance over a whole motion, proven between its waypoints too. Metres, seconds, radians.",
      "clearance_query");
  app.footer(
      "An empty cell was not computed. Status: ok, penetrating, budget_exhausted, no_pairs.\n"
      "Exit status: 0 done, 1 a file is at fault, 2 the command line is.");
  app.set_version_flag("--version", versionsText());
  addOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return reportParseError(app, error);
  }
  runClearanceQuery(options);
  return 0;
}

}  // namespace
}  // namespace concave_distance::tools

int main(int argc, char** argv) {
  return concave_distance::runTool("clearance_query", argc, argv, concave_distance::tools::run);
}
