#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bag_progress.h"
#include "bag_replay.h"
#include "bag_report.h"
#include "bag_transforms.h"
#include "base/number_text.h"
#include "base/output_file.h"
#include "base/run_tool.h"
#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "ros/node/node_parameter_table.h"
#include "ros/node/scene_loader.h"
#include "ros/tf/frame_report.h"
#include "ros/time_difference.h"
#include "scene/name_pattern.h"
#include "scene/pair_parameters.h"
#include "tools/description_option.h"
#include "tools/option_names.h"
#include "tools/parameter_options.h"

namespace concave_distance {
namespace {

constexpr int kInterrupted = 130;  // as a shell has it for Ctrl-C
constexpr std::size_t kMostListed = 10;
constexpr const char* kUsualDescription = "robot_description";
constexpr const char* kPlotProgram = "plot_distances.py";

std::atomic<bool> interrupted{false};

// A second Ctrl-C ends the program at once.
void endOnInterrupt() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

struct Options {
  BagSelection bags;
  NodeParameters node;
  std::string robot_description;
  std::vector<std::string> descriptions;  ///< NAME=FILE
  std::vector<std::string> pairs;         ///< patterns
  std::string output;
  std::string niches_output;
  std::string plot;
};

void addSceneOptions(CLI::App& app, Options& options) {
  app.add_option("--scene", options.node.scene_file, "scene file; without one, the robot alone")
      ->type_name("FILE");
  app.add_option("--robot-description", options.robot_description,
                 "URDF of the parameter robot_description: of the scene's robot, or of the robot alone")
      ->type_name("FILE");
  app.add_option("--description", options.descriptions,
                 "URDF or SRDF of another parameter that the scene file names; once for each")
      ->type_name("NAME=FILE");
  app.add_option("--mesh-search-path", options.node.mesh_search_folders,
                 "folder to search for meshes that are not found; once for each")
      ->type_name("DIR");
  app.add_option("--cache", options.node.cache,
                 "folder that keeps what was prepared of the meshes, or off "
                 "($XDG_CACHE_HOME/concave_distance, ~/.cache/concave_distance)")
      ->type_name("DIR|off");
  for (const char* parameter : {"reference_frame", "geometry", "skip_overlapping_pairs", "stale_after",
                                "tf_cache", "tf_future_tolerance", "threads"}) {
    tools::addParameter(app, nodeParameterTable(), parameter, options.node);
  }
  for (const Parameter<PairSettings>& parameter : pairParameters()) {
    if (parameter.info.is_expert || parameter.info.name == "time_budget") continue;
    tools::addParameter(app, parameter, options.node.pair);
  }
}

void addOptions(CLI::App& app, Options& options) {
  app.add_option("--bag", options.bags.paths, "bag; several are played as one, as by rosbag play")
      ->required()
      ->type_name("FILE");
  app.add_option("--start", options.bags.start, "seconds after the begin of the bags")->type_name("S");
  app.add_option("--duration", options.bags.duration, "seconds from there (to the end)")->type_name("S");
  app.add_option("--tf-topic", options.bags.moving_topics,
                 "topic of transforms that move; once for each (/tf)")
      ->type_name("NAME");
  app.add_option("--tf-static-topic", options.bags.fixed_topics,
                 "topic of transforms that stand; once for each (/tf_static)")
      ->type_name("NAME");
  addSceneOptions(app, options);
  app.add_option("--pairs", options.pairs,
                 "only pairs of this name or pattern, as 'gripper/*'; once for each")
      ->type_name("PATTERN");
  app.add_option("--output", options.output, BagReport::kColumns)->required()->type_name("FILE");
  app.add_option("--niches-output", options.niches_output,
                 std::string(BagReport::kNicheColumns) + "; without it no niches are computed")
      ->type_name("FILE");
  app.add_option("--plot", options.plot, "picture of the distances over time (.png, .pdf, .svg; matplotlib)")
      ->type_name("FILE");
}

/// Texts by the names of their parameters, and their folders as places to search for meshes.
std::map<std::string, std::string> readDescriptions(Options& options) {
  std::map<std::string, std::string> texts;
  const auto read = [&](const std::string& name, const std::string& path) {
    texts[name] = tools::readDescription(path);
    options.node.mesh_search_folders.push_back(path);
  };
  if (!options.robot_description.empty()) read(kUsualDescription, options.robot_description);
  for (const std::string& description : options.descriptions) {
    const auto [name, path] = tools::assignment("--description", description);
    read(name, path);
  }
  return texts;
}

Scene load(Options& options) {
  SceneRequest request;
  request.descriptions = readDescriptions(options);
  if (options.node.scene_file.empty()) {
    if (request.descriptions.count(kUsualDescription) == 0) {
      throw Error("--scene", "there is no scene file and no --robot-description", "give one of them");
    }
    options.node.robot_description = kUsualDescription;
  } else {
    for (const std::string& name : descriptionsOfSceneFile(options.node.scene_file)) {
      if (request.descriptions.count(name) != 0) continue;
      throw Error(options.node.scene_file, "it takes a robot from the parameter '" + name + "'",
                  name == kUsualDescription ? "give its URDF: --robot-description FILE"
                                            : "give its file: --description " + name + "=FILE");
    }
  }
  LoadProgress progress;
  progress.stopped_with = &interrupted;
  Scene scene = loadScene(options.node, request, progress);
  for (const std::string& warning : scene.warnings) std::cerr << "warning: " << warning << '\n';
  for (const SceneProblem& problem : scene.problems) {
    std::cerr << "not in the scene: " << problem.where << ": " << problem.message << '\n';
  }
  return scene;
}

void requireFiles(const Options& options) {
  std::vector<NamedPath> inputs = {{"--scene", options.node.scene_file},
                                   {"--robot-description", options.robot_description}};
  for (const std::string& path : options.bags.paths) inputs.push_back({"--bag", path});
  for (const std::string& description : options.descriptions) {
    inputs.push_back({"--description", tools::assignment("--description", description).second});
  }
  requireDistinctFiles(
      inputs,
      {{"--output", options.output}, {"--niches-output", options.niches_output}, {"--plot", options.plot}});
}

void checkOptions(const CLI::App& app, Options& options) {
  options.bags.are_topics_given = app.count("--tf-topic") + app.count("--tf-static-topic") > 0;
  if (app.count("--tf-topic") == 0 && app.count("--tf-static-topic") > 0) options.bags.moving_topics.clear();
  if (app.count("--tf-static-topic") == 0 && app.count("--tf-topic") > 0) options.bags.fixed_topics.clear();
  options.node.reference_frame = requireFrameName(options.node.reference_frame, "--reference-frame");
  options.node.automatic_cutoff = options.node.scene_file.empty() && app.count("--cutoff") == 0;
  for (const std::string& pattern : options.pairs) detail::requirePatternLength(pattern, "--pairs");
  if (options.bags.duration && !(*options.bags.duration > 0.0)) {
    throw Error("--duration", "it is " + numberText(*options.bags.duration) + " s", "give seconds above 0");
  }
  if (!(options.bags.start >= 0.0)) {
    throw Error("--start", "it is " + numberText(options.bags.start) + " s", "give seconds from 0 on");
  }
}

/// What a reader of the rows should know.
void printProblems(const BagReplay& replay, const Scene& scene, const std::string& reference_frame) {
  const ReplayCounts& counts = replay.counts();
  for (const auto& [name, reason] : counts.reasons)
    std::cerr << "warning: " << tools::inOptions(reason) << '\n';
  if (counts.refused > counts.reasons.size()) {
    std::cerr << "warning: " << counts.refused << " transforms were refused in all\n";
  }
  if (counts.rows == 0) std::cerr << "warning: no pair comes within its cutoff\n";
  const std::map<std::string, std::string> unanswered = replay.unanswered();
  std::size_t listed = 0;
  for (const auto& [name, problem] : unanswered) {
    if (++listed > kMostListed) break;
    std::cerr << "warning: no answer of pair " << name << ": " << tools::inOptions(problem) << '\n';
  }
  if (unanswered.size() > kMostListed) {
    std::cerr << "warning: " << unanswered.size() << " pairs have no answer in all\n";
  }
  const std::string missing = describeMissingFrames(*replay.transforms().current(), scene, reference_frame);
  if (!missing.empty()) std::cerr << "warning: at the end " << tools::inOptions(missing) << '\n';
}

[[noreturn]] void throwWithoutAnswer(const BagReplay& replay, const Scene& scene, const Options& options) {
  const std::string where = joinedText(options.bags.paths, ", ");
  const std::string missing =
      describeMissingFrames(*replay.transforms().current(), scene, options.node.reference_frame);
  if (!missing.empty()) {
    throw Error(where, "no pair has an answer: " + tools::inOptions(missing),
                "the bag's frames: " + replay.transforms().current()->allFramesAsString());
  }
  const auto unanswered = replay.unanswered();
  throw Error(where,
              "no pair has an answer" +
                  (unanswered.empty() ? "" : ": " + tools::inOptions(unanswered.begin()->second)),
              "check --pairs, --start and --duration, and that the scene has pairs");
}

std::filesystem::path plotProgram() {
  std::error_code failure;
  return std::filesystem::read_symlink("/proc/self/exe", failure).parent_path() / kPlotProgram;
}

void requirePlotProgram(const std::string& plot) {
  if (plot.empty() || std::filesystem::exists(plotProgram())) return;
  throw Error("--plot", "there is no " + plotProgram().string(),
              "install the whole package; nothing was written");
}

void drawPlot(const Options& options) {
  const std::string program = plotProgram().string();
  const pid_t child = fork();
  if (child == 0) {
    execl(program.c_str(), program.c_str(), options.output.c_str(), "--output", options.plot.c_str(),
          nullptr);
    std::perror(program.c_str());
    _exit(kFileProblem);
  }
  int status = -1;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
    throw Error(options.plot, "the plot could not be drawn; the rows are complete",
                "see above, then: rosrun concave_distance " + std::string(kPlotProgram) + " " +
                    options.output + " --output " + options.plot);
  }
}

/// @return whether it was played to its end
bool play(const Options& options, BagTransforms& bags, BagReplay& replay, BagReport& report) {
  BagProgress progress(bags.begin(), bags.end());
  ros::Time now = bags.begin();
  for (BagMessage message; !interrupted && bags.next(message);) {
    now = message.time;
    replay.take(message);
    if (progress.show(now)) report.check();
  }
  if (!interrupted) replay.finish();
  progress.finish();
  const ReplayCounts& counts = replay.counts();
  std::fprintf(
      stderr, "%s: %.1f s in %.1f s, real-time factor %.2f; %llu stamps, %llu rows, %llu distances\n",
      joinedText(options.bags.paths, ", ").c_str(), secondsBetween(bags.begin(), now), progress.seconds(),
      progress.realTimeFactor(now), static_cast<unsigned long long>(counts.stamps),
      static_cast<unsigned long long>(counts.rows), static_cast<unsigned long long>(counts.answers));
  if (interrupted) {
    std::fprintf(stderr, "distance_bag: interrupted after %.1f of %.1f s; the files end there\n",
                 secondsBetween(bags.begin(), now), secondsBetween(bags.begin(), bags.end()));
  }
  return !interrupted;
}

int replayBags(Options options) {
  requireFiles(options);
  requirePlotProgram(options.plot);
  BagTransforms bags(options.bags);
  const Scene scene = load(options);
  BagReport report(options.output, options.niches_output);
  ReplayOptions replay_options;
  replay_options.cycle = {options.node.reference_frame, options.node.stale_after, options.node.threads,
                          &interrupted};
  replay_options.limits = {options.node.tf_cache, options.node.tf_future_tolerance};
  replay_options.niches = !options.niches_output.empty();
  replay_options.patterns = options.pairs;
  BagReplay replay(scene, replay_options, [&](const BagAnswer& answer) { report.write(answer); });
  const bool is_whole = play(options, bags, replay, report);
  if (is_whole && !replay.hasAnswer()) throwWithoutAnswer(replay, scene, options);
  report.finish();
  printProblems(replay, scene, options.node.reference_frame);
  if (!is_whole) return kInterrupted;
  if (!options.plot.empty()) drawPlot(options);
  return 0;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Distances of a scene's pairs at every transform of a bag, as the node would give them. Metres, "
      "seconds; "
      "points in the reference frame.",
      "distance_bag");
  app.footer(
      "An empty cell was not computed. Status: ok, tolerance, memory, penetrating, beyond_cutoff, "
      "missing_transform, stale_transform, invalid_pose, not_found; what has no distance says why in "
      "message.\n"
      "Exit status: 0 done, 1 a file is at fault, 2 the command line is, 130 interrupted: the files end "
      "there.");
  addOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kWrongCommandLine;
  }
  checkOptions(app, options);
  endOnInterrupt();
  return replayBags(std::move(options));
}

}  // namespace
}  // namespace concave_distance

int main(int argc, char** argv) {
  return concave_distance::runTool("distance_bag", argc, argv, concave_distance::run);
}
