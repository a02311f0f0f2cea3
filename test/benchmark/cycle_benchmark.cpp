// Cycles with an end, as the node runs them, without ROS: how many are late, and how long lists wait.
//
//   cycle_benchmark [robot] [cell] [ROBOT.urdf[,ROBOT.srdf] ...] [--seconds 60] [--rate 50] [--share 0.8]
//   [--threads 1,2] [--pairs] [--output FILE]
//
// The arm of the demo scenes moves along its path; every joint of another robot sways. Poses follow each
// other by a period, but the program does not wait for it: a cycle is late when it takes longer. Every pair
// has all its niches. --share is the cycle's budget as a share of the period; 0: no end. A row is a number of
// threads: pairs of the scene and, a cycle, pairs within their cutoff; cycles, late ones; milliseconds of a
// cycle: mean, 99th percentile, longest; of the lists of pairs within their cutoff the share that is
// complete; of the cycles the share in which all are; how many cycles a pair was without a complete list at
// most. With --pairs, each pair that ever waited: its cycles, those without a complete list, its longest
// wait.
#include <urdf_parser/urdf_parser.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "concave_distance/base/error.h"
#include "concave_distance/kinematics/scene_kinematics.h"
#include "concave_distance/loading/load_scene.h"
#include "concave_distance/scene/scene_tracker.h"
#include "ros/demo/joint_path.h"
#include "ros/demo/swaying_joints.h"

namespace concave_distance::benchmark {
namespace {

using Clock = WorkLimit::Clock;
using Positions = std::map<std::string, double>;

std::string textOf(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A scene whose bodies move with one robot.
struct MovingScene {
  Scene scene;
  std::function<Positions(double)> joints;  ///< at a time, seconds
};

SceneLoadOptions loadOptions() {
  SceneLoadOptions options;
  options.package_locator = [](const std::string&) { return std::string(CONCAVE_DISTANCE_SOURCE_DIR); };
  return options;
}

MovingScene demoScene(const std::string& name) {
  const std::string folder = CONCAVE_DISTANCE_SOURCE_DIR;
  const std::string urdf = textOf(folder + "/urdf/wam.urdf");
  SceneLoadOptions options = loadOptions();
  options.descriptions["robot_description"] = urdf;
  const demo::NamedJointPath path = demo::readJointPath(folder + "/config/wam_path.csv");
  return {loadSceneFile(folder + "/config/" + name + ".yaml", options), [path](double time) {
            const Eigen::VectorXd at = path.path.at(time);
            Positions positions;
            for (std::size_t i = 0; i < path.joints.size(); ++i) {
              positions[path.joints[i]] = at[static_cast<Eigen::Index>(i)];
            }
            return positions;
          }};
}

/// A robot beside itself, as the node loads it without a scene file.
MovingScene ownRobot(const std::string& files) {
  const std::size_t comma = files.find(',');
  const std::string path = files.substr(0, comma);
  const std::string urdf = textOf(path);
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(urdf);
  if (!model) throw Error(path, "the URDF cannot be read", "name robot, cell or a file with a URDF");
  SceneLoadOptions options = loadOptions();
  options.mesh_search_path = {path};
  options.automatic_cutoff = true;
  if (comma != std::string::npos) {
    options.descriptions["robot_description_semantic"] = textOf(files.substr(comma + 1));
  }
  return {loadRobotScene(urdf, path, options), [joints = demo::swayingJoints(*model)](double time) {
            Positions positions;
            for (const demo::SwayingJoint& joint : joints) positions[joint.name] = joint.at(time);
            return positions;
          }};
}

/// Counts how the lists of one pair were over the cycles.
struct Waits {
  std::size_t lists = 0;
  std::size_t incomplete = 0;
  std::size_t now = 0;
  std::size_t longest = 0;

  bool add(const TrackedPair& pair) {
    if (!pair.solved()) {
      now = 0;
      return true;
    }
    const PairSolution& solution = pair.solution;
    const bool is_whole = solution.niches_complete || solution.niches_cut;
    ++lists;
    incomplete += is_whole ? 0 : 1;
    now = is_whole ? 0 : now + 1;
    longest = std::max(longest, now);
    return is_whole;
  }
};

struct Settings {
  double seconds = 60.0;
  double rate = 50.0;
  double share = 0.8;
  bool prints_pairs = false;
};

void measure(const MovingScene& moving, const std::string& name, std::uint32_t threads,
             const Settings& settings, ResultTable& table) {
  SceneTracker tracker({threads, nullptr, true});
  tracker.setScene(moving.scene);
  const SceneKinematics joints(moving.scene);
  const std::vector<std::string>& names = joints.positionNames();
  Eigen::VectorXd positions = joints.restPositions();
  SceneState state = joints.startState();
  const double period = 1.0 / settings.rate;
  const auto cycles = static_cast<std::size_t>(std::lround(settings.seconds * settings.rate));
  std::vector<Waits> waits(tracker.pairs().size());
  std::vector<double> milliseconds;
  std::size_t whole = 0;
  bool is_prepared = false;
  for (std::size_t cycle = 0; cycle < cycles;) {
    const double time = static_cast<double>(cycle) * period;
    const Positions at = moving.joints(time);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto named = at.find(names[i]);
      if (named != at.end()) positions[static_cast<Eigen::Index>(i)] = named->second;
    }
    joints.evaluate(positions, state);
    const Clock::time_point start = Clock::now();
    const std::chrono::duration<double> budget(settings.share * period);
    const Clock::time_point end =
        settings.share > 0.0 ? start + std::chrono::duration_cast<Clock::duration>(budget) : kNoCycleEnd;
    const CycleCounts counts = tracker.update(state.world_from_body, time, {true, true, true, false}, end);
    const double taken = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    if (!is_prepared && counts.unprepared > 0) {
      std::this_thread::sleep_for(std::chrono::duration<double>(period));
      continue;
    }
    is_prepared = true;
    ++cycle;
    milliseconds.push_back(taken);
    bool are_whole = true;
    for (std::size_t i = 0; i < waits.size(); ++i) {
      if (!waits[i].add(*tracker.pairs()[i])) are_whole = false;
    }
    whole += are_whole ? 1 : 0;
  }
  std::size_t lists = 0;
  std::size_t incomplete = 0;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < waits.size(); ++i) {
    lists += waits[i].lists;
    incomplete += waits[i].incomplete;
    longest = std::max(longest, waits[i].longest);
    if (!settings.prints_pairs || waits[i].incomplete == 0) continue;
    std::printf("%s: %zu of %zu lists incomplete, at most %zu in a row\n",
                tracker.pairs()[i]->origin->name.c_str(), waits[i].incomplete, waits[i].lists,
                waits[i].longest);
  }
  const auto late = std::count_if(milliseconds.begin(), milliseconds.end(),
                                  [&](double taken) { return taken > 1e3 * period; });
  const auto count = static_cast<double>(cycles);
  table.add(name, threads, waits.size(), static_cast<double>(lists) / count, cycles, late, mean(milliseconds),
            percentile(milliseconds, 0.99), percentile(milliseconds, 1.0),
            1.0 - static_cast<double>(incomplete) / static_cast<double>(std::max<std::size_t>(lists, 1)),
            static_cast<double>(whole) / count, longest);
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Cycles with an end: lateness and complete lists");
  std::vector<std::string> scenes{"robot", "cell"};
  std::string output;
  std::vector<std::uint32_t> threads{1, 2};
  Settings settings;
  app.add_option("scenes", scenes);
  app.add_option("--seconds", settings.seconds);
  app.add_option("--rate", settings.rate);
  app.add_option("--share", settings.share);
  app.add_option("--threads", threads)->delimiter(',');
  app.add_flag("--pairs", settings.prints_pairs);
  app.add_option("--output", output);
  CLI11_PARSE(app, argc, argv);
  ResultTable table(output,
                    "scene,threads,pairs,near,cycles,late,mean_ms,p99_ms,longest_ms,lists_complete,"
                    "cycles_complete,longest_wait");
  for (const std::string& scene : scenes) {
    const bool is_demo = scene == "robot" || scene == "cell";
    const MovingScene moving = is_demo ? demoScene(scene) : ownRobot(scene);
    const std::string name = std::filesystem::path(scene.substr(0, scene.find(','))).stem().string();
    for (const std::uint32_t count : threads) measure(moving, name, count, settings, table);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
