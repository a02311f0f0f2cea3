#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bag_options.h"
#include "bag_progress.h"
#include "bag_replay.h"
#include "bag_report.h"
#include "base/number_text.h"
#include "base/run_tool.h"
#include "base/short_text.h"
#include "base/versions.h"
#include "concave_distance/base/error.h"
#include "kinematics/wording.h"
#include "ros/node/scene_loader.h"
#include "ros/tf/frame_report.h"
#include "ros/time_difference.h"
#include "tools/option_names.h"
#include "tools/scene_options.h"

namespace concave_distance {
namespace {

constexpr int kInterrupted = 130;  // as a shell has it for Ctrl-C
constexpr std::size_t kMostListed = 10;
constexpr const char* kPlotProgram = "plot_distances.py";
constexpr FrameRemedies kFrameRemedies{
    "record /tf_static too, from the robot's start, play further bags, or check that the scene is of this "
    "robot",
    "play the bag or topic that has the transform between the two, as /tf_static of the robot's start"};

std::atomic<bool> interrupted{false};

// A second Ctrl-C ends the program at once.
void endOnInterrupt() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

/// Texts by the names of their parameters, and their folders as places to search for meshes.
std::map<std::string, std::string> readDescriptions(BagOptions& options) {
  std::map<std::string, std::string> texts;
  if (!options.robot_description.empty()) {
    texts[kUsualDescription] = tools::readDescription(options.robot_description);
    options.node.mesh_search_folders.push_back(options.robot_description);
  }
  tools::readDescriptions(options.descriptions, texts, options.node.mesh_search_folders);
  return texts;
}

Scene load(BagOptions& options) {
  SceneRequest request;
  request.clouds = false;
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
  for (const std::string& warning : scene.warnings) {
    std::cerr << "warning: " << tools::inOptions(warning) << '\n';
  }
  for (const SceneProblem& problem : scene.problems) {
    std::cerr << "not in the scene: " << problem.where << ": " << tools::inOptions(problem.message) << '\n';
  }
  return scene;
}

/// Prints what a reader of the rows should know.
void printProblems(const BagReplay& replay, const Scene& scene, const std::string& reference_frame) {
  const BagRefusals& refusals = replay.moments().refusals();
  for (const auto& [name, reason] : refusals.reasons)
    std::cerr << "warning: " << tools::inOptions(reason) << '\n';
  if (refusals.count > refusals.reasons.size()) {
    std::cerr << "warning: " << refusals.count << " transforms were refused in all\n";
  }
  if (replay.counts().rows == 0) std::cerr << "warning: no pair comes within its cutoff\n";
  const std::map<std::string, std::string> unanswered = replay.rows().unanswered();
  std::size_t listed = 0;
  for (const auto& [name, problem] : unanswered) {
    if (++listed > kMostListed) break;
    std::cerr << "warning: no answer of pair " << name << ": " << tools::inOptions(problem) << '\n';
  }
  if (unanswered.size() > kMostListed) {
    std::cerr << "warning: " << unanswered.size() << " pairs have no answer in all\n";
  }
  const std::string missing =
      describeMissingFrames(*replay.moments().buffer().current(), scene, reference_frame, kFrameRemedies);
  if (!missing.empty()) std::cerr << "warning: at the end " << tools::inOptions(missing) << '\n';
}

[[noreturn]] void throwWithoutAnswer(const BagReplay& replay, const Scene& scene, const BagOptions& options) {
  const std::string where = joinedText(options.bags.paths, ", ");
  const tf2::BufferCore& frames = *replay.moments().buffer().current();
  const std::string missing =
      describeMissingFrames(frames, scene, options.node.reference_frame, kFrameRemedies);
  if (!missing.empty()) {
    std::vector<std::string> names;
    frames._getFrameStrings(names);
    std::sort(names.begin(), names.end());
    throw Error(where, "no pair has an answer: " + tools::inOptions(missing),
                "the bag's frames: " + shortText(detail::listed(names, kMostListed * 10)));
  }
  const auto unanswered = replay.rows().unanswered();
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

void drawPlot(const BagOptions& options) {
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
bool play(const BagOptions& options, BagTransforms& bags, BagReplay& replay, BagReport& report) {
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

int replayBags(BagOptions options) {
  requireDistinctFiles(options);
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
  BagOptions options;
  CLI::App app(
      "Distances of a scene's pairs at every transform of a bag, as the node would give them. Metres, "
      "seconds; "
      "points in the reference frame.",
      "distance_bag");
  app.set_version_flag("--version", versionsText());
  app.footer(
      "An empty cell was not computed. Status: ok, tolerance, memory, penetrating, beyond_cutoff, "
      "missing_transform, stale_transform, invalid_pose, not_found; what has no distance says why in "
      "message.\n"
      "Exit status: 0 done, 1 a file is at fault, 2 the command line is, 130 interrupted: the files end "
      "there.");
  addBagOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return reportParseError(app, error);
  }
  checkBagOptions(app, options);
  endOnInterrupt();
  return replayBags(std::move(options));
}

}  // namespace
}  // namespace concave_distance

int main(int argc, char** argv) {
  return concave_distance::runTool("distance_bag", argc, argv, concave_distance::run);
}
