// Shows what the genetic search does by default, at level `certified`: the same cycles with it and without
// it, in turns, in one run and one thread.
//
//   generation_benchmark [--pairs name,name,...] [--steps 500] [--robot FOLDER]
//                        [--output doc/results/generations.csv]
//
// A row is a benchmark pair along its motion (5 s long: 500 steps are 100 Hz); with --robot, after them all
// 35 pairs of config/robot.yaml together along config/wam_path.csv at 50 Hz, FOLDER being the package.
// Columns: cycles solved after the first; those that `moved`; of these `beyond`, where the proof put
// everything beyond the cutoff, the one exception here; generations for each other cycle that moved
// (`per_cycle`, 1 expected); of these cycles the shares with a child of two parents (`bred`) and, where a
// niche was known, with an individual that inherited (`inherited`, both 1 expected); mean individuals
// inherited and children (`heirs`, `children`); new niches that the search has proposed and missed
// (`evolved`, `missed`); microseconds (medians) of a cycle that moved, without and with the search
// (`without_us`, `with_us`), and of its stage `propose` (`propose_us`, its 99th percentile `propose_p99_us`);
// time of the stage as a share of all time (`share`); cycles in which it took more than 30 % and more than 5
// us (`above`); the same share of the first cycle (`first_share`); cycles whose answer is another one without
// the search (`other`, 0 expected; ids, origins and cost do not count) and whose list is not proven complete
// though nothing cut it (`incomplete`, 0 expected).
#include <CLI/CLI.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "concave_distance/kinematics/scene_kinematics.h"
#include "concave_distance/loading/load_scene.h"
#include "concave_distance/scene/scene_tracker.h"
#include "concave_distance/tracking/pair_tracker.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kMicroseconds = 1e6;
constexpr double kLargestShare = 0.3;
constexpr double kLeastOfLimit = 5.0;  // microseconds
constexpr double kRobotRate = 50.0;

TrackerParameters withShare(TrackerParameters parameters, bool searches) {
  if (!searches) parameters.search_share = 0.0;
  return parameters;
}

bool isSameNiche(const TrackedNiche& l, const TrackedNiche& r) {
  return l.distance == r.distance && l.point_a_in_a == r.point_a_in_a && l.point_b_in_a == r.point_b_in_a &&
         l.kind == r.kind && l.extent == r.extent && l.outward == r.outward && l.visible == r.visible;
}

bool isSameAnswer(const PairSolution& l, const PairSolution& r) {
  return l.status == r.status && l.distance == r.distance && l.lower_bound == r.lower_bound &&
         l.niches_complete == r.niches_complete && l.niches_cut == r.niches_cut &&
         std::equal(l.niches.begin(), l.niches.end(), r.niches.begin(), r.niches.end(), isSameNiche);
}

class Row {
 public:
  /// @param knew_niches in the cycle before
  void add(const PairSolution& with, const PairSolution& without, bool moved, bool knew_niches,
           double cutoff) {
    other_ += isSameAnswer(with, without) ? 0 : 1;
    incomplete_ += with.niches_complete || with.niches_cut ? 0 : 1;
    const double propose = with.stages[SolveStage::Propose];
    if (!with.warm) {
      first_seconds_ += with.solve_seconds;
      first_propose_ += propose;
      return;
    }
    ++cycles_;
    for (const TrackedNiche& niche : with.niches) {
      evolved_ += niche.origin == NicheOrigin::Evolved ? 1 : 0;
      missed_ += niche.origin == NicheOrigin::FromCones || niche.origin == NicheOrigin::Proven ? 1 : 0;
    }
    if (!moved) return;
    ++moved_;
    seconds_ += with.solve_seconds;
    propose_seconds_ += propose;
    with_us_.push_back(kMicroseconds * with.solve_seconds);
    without_us_.push_back(kMicroseconds * without.solve_seconds);
    propose_us_.push_back(kMicroseconds * propose);
    above_ += propose > kLargestShare * with.solve_seconds && kMicroseconds * propose > kLeastOfLimit ? 1 : 0;
    if (with.lower_bound > cutoff) {
      ++beyond_;
      return;
    }
    generations_ += with.cost.generations;
    bred_ += with.cost.children > 0 ? 1 : 0;
    knew_ += knew_niches ? 1 : 0;
    inherited_ += knew_niches && with.cost.inherited > 0 ? 1 : 0;
    heirs_ += with.cost.inherited;
    children_ += with.cost.children;
  }

  static constexpr const char* kColumns =
      "pair,cycles,moved,beyond,per_cycle,bred,inherited,heirs,children,evolved,missed,without_us,"
      "with_us,propose_us,propose_p99_us,share,above,first_share,other,incomplete";

  /// Cells without a value are empty: those of a pair that never moves.
  void addTo(ResultTable& table, const std::string& name) const {
    const double due = moved_ - beyond_;
    table.add(name, cycles_, moved_, beyond_, generations_ / due, bred_ / due, inherited_ / knew_,
              heirs_ / due, children_ / due, evolved_, missed_, median(without_us_), median(with_us_),
              median(propose_us_), percentile(propose_us_, 0.99), propose_seconds_ / seconds_, above_,
              first_propose_ / first_seconds_, other_, incomplete_);
  }

 private:
  double cycles_ = 0.0, moved_ = 0.0, beyond_ = 0.0, generations_ = 0.0, bred_ = 0.0, knew_ = 0.0;
  double inherited_ = 0.0, heirs_ = 0.0, children_ = 0.0, evolved_ = 0.0, missed_ = 0.0, above_ = 0.0;
  double seconds_ = 0.0, propose_seconds_ = 0.0, first_seconds_ = 0.0, first_propose_ = 0.0;
  double other_ = 0.0, incomplete_ = 0.0;
  std::vector<double> with_us_, without_us_, propose_us_;
};

Row runPair(const BenchmarkPair& pair, int steps) {
  Row row;
  PairTracker searching(pair.name, pair.a, pair.b, withShare({}, true));
  PairTracker plain(pair.name, pair.a, pair.b, withShare({}, false));
  for (PairTracker* tracker : {&searching, &plain}) tracker->prepare({pair.motion(0.0)});
  PairSolution with;
  PairSolution without;
  Eigen::Isometry3d last = Eigen::Isometry3d::Identity();
  for (int k = 0; k < steps; ++k) {
    const double t = static_cast<double>(k) / (steps - 1);
    const Eigen::Isometry3d pose = pair.motion(t);
    const bool knew_niches = !with.niches.empty();
    // Who comes second finds the bodies in the processor's caches.
    if (k % 2 == 0) searching.update(pose, 5.0 * t, with);
    plain.update(pose, 5.0 * t, without);
    if (k % 2 != 0) searching.update(pose, 5.0 * t, with);
    row.add(with, without, pose.matrix() != last.matrix(), knew_niches,
            std::numeric_limits<double>::infinity());
    last = pose;
  }
  return row;
}

std::string textOf(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Joint positions j1 to j7 over time, between the lines of a file.
class JointPath {
 public:
  explicit JointPath(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      for (char& c : line) c = c == ',' ? ' ' : c;
      std::istringstream cells(line);
      std::vector<double> row{std::istream_iterator<double>(cells), {}};
      if (!row.empty()) rows_.push_back(std::move(row));
    }
  }
  double duration() const { return rows_.back()[0]; }
  Eigen::VectorXd at(double time, std::size_t joints) const {
    std::size_t next = 1;
    while (next + 1 < rows_.size() && rows_[next][0] < time) ++next;
    const std::vector<double>& from = rows_[next - 1];
    const std::vector<double>& to = rows_[next];
    const double share = (time - from[0]) / (to[0] - from[0]);
    Eigen::VectorXd positions = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(joints));
    for (std::size_t j = 0; j < joints && j + 1 < from.size(); ++j) {
      positions[static_cast<Eigen::Index>(j)] = from[j + 1] + share * (to[j + 1] - from[j + 1]);
    }
    return positions;
  }

 private:
  std::vector<std::vector<double>> rows_;
};

Row runRobot(const std::string& folder) {
  SceneLoadOptions options;
  options.package_locator = [&](const std::string&) { return folder; };
  options.strict = true;
  const std::string urdf = textOf(folder + "/urdf/wam.urdf");
  options.descriptions["robot_description"] = urdf;
  Scene scene = loadSceneFile(folder + "/config/robot.yaml", options);
  scene.pairs = allPairs(scene);
  Scene plain = scene;
  PairList pairs;
  for (const ScenePair& pair : scene.pairs) {
    ScenePair without = pair;
    without.settings.tracker = withShare(pair.settings.tracker, false);
    pairs.push_back(without);
  }
  plain.pairs = pairs;
  const SceneKinematics joints(scene);
  SceneState state = joints.startState();
  const JointPath path(folder + "/config/wam_path.csv");
  SceneTracker searching({1, nullptr});
  SceneTracker idle({1, nullptr});
  searching.setScene(scene);
  idle.setScene(plain);
  Row row;
  std::vector<bool> knew(scene.pairs.size(), false);
  std::vector<Eigen::Isometry3d> last(scene.pairs.size(), Eigen::Isometry3d::Identity());
  for (int k = 0; k < kRobotRate * path.duration(); ++k) {
    const double time = k / kRobotRate;
    joints.evaluate(path.at(time, joints.positionNames().size()), state);
    searching.update(state.world_from_body, time);
    idle.update(state.world_from_body, time);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const TrackedPair& pair = *searching.pairs()[i];
      if (pair.solved() && !pair.repeated) {
        row.add(pair.solution, idle.pairs()[i]->solution, pair.input.a_from_b.matrix() != last[i].matrix(),
                knew[i], pair.settings.tracker.cutoff);
      }
      knew[i] = pair.solved() && !pair.solution.niches.empty();
      last[i] = pair.input.a_from_b;
    }
  }
  return row;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Cycles with the genetic search and without it, in one run and one thread");
  std::vector<std::string> names = allPairs();
  int steps = 500;
  std::string robot;
  std::string output;
  app.add_option("--pairs", names, "Pairs to run; all when left out")->delimiter(',');
  app.add_option("--steps", steps, "Instants along each motion")->check(CLI::Range(2, 1000000));
  app.add_option("--robot", robot, "The package's folder: the robot scene as well");
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  ResultTable table(output, Row::kColumns);
  for (const std::string& name : names) runPair(loadBenchmarkPair(name), steps).addTo(table, name);
  if (!robot.empty()) runRobot(robot).addTo(table, "robot");
  return 0;
}

}  // namespace concave_distance::benchmark
