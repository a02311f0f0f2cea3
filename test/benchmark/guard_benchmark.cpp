// A velocity guard in a closed loop: 200 runs of the demo arm in its cell, of the same arm with its hand in
// the crate, of a mobile base between three walls and of a base among obstacles that move.
//
//   guard_benchmark [--runs 200] [--output guard.csv] [--joints together|alone] [--guards niches,nearest,...]
//                   [--margin 0.03] [--tilt 0.1] [--tasks arm,crate,narrow,crossing] [--only 6]
//
// Each run has the same start, goal and driver with every guard. In each cycle of 10 ms the scene is tracked,
// rows are made and the guard gives a scale; the scaled command reaches the robot 50 ms later, and each of
// its joints follows with a limited acceleration, all of them together in the time that the slowest needs, or
// each alone. Guards: `niches`, all rows; `nearest`, the same law with the nearest row alone; `distance_...`,
// the scale of MoveIt Servo's threshold_distance, exp(-ln(0.001) (distance / threshold - 1)), whatever the
// direction; `none`. Contact is judged every 2 ms by code that shares nothing with the package: FCL's
// collision of triangles along the URDF's chain, separating axes of rectangles. A run that touches ends. A
// line of the table sums up the runs of a task with a guard: contacts, arrivals, the mean and the largest
// time of those that arrive with every guard that arrives in at least half of the runs.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <deque>
#include <map>
#include <sstream>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/guard_tasks.h"
#include "benchmark/support/result_table.h"
#include "concave_distance/base/error.h"
#include "concave_distance/kinematics/velocity_guard.h"

namespace concave_distance::benchmark {
namespace {

using Eigen::VectorXd;

constexpr double kPeriod = 0.01;    // s, of a cycle
constexpr double kStep = 0.002;     // s, of the robot and of the judge
constexpr std::size_t kDelay = 25;  // steps until a command reaches the robot

/// A robot that follows commands late and with limited accelerations.
class DelayedRobot {
 public:
  DelayedRobot(VectorXd positions, double acceleration, bool together)
      : positions_(std::move(positions)),
        velocities_(VectorXd::Zero(positions_.size())),
        pending_(kDelay, velocities_),
        acceleration_(acceleration),
        together_(together) {}
  void step(const VectorXd& command) {
    pending_.push_back(command);
    const VectorXd change = pending_.front() - velocities_;
    pending_.pop_front();
    const double most = acceleration_ * kStep;
    const double largest = change.cwiseAbs().maxCoeff();
    if (together_) velocities_ += largest > most ? VectorXd(change * (most / largest)) : change;
    if (!together_) velocities_ += change.cwiseMax(-most).cwiseMin(most);
    positions_ += kStep * velocities_;
  }
  const VectorXd& positions() const { return positions_; }

 private:
  VectorXd positions_;
  VectorXd velocities_;
  std::deque<VectorXd> pending_;
  double acceleration_;
  bool together_;
};

struct Run {
  bool has_touched = false;
  bool has_arrived = false;
  double seconds = 0.0;  ///< to its end
  double mean_scale = 0.0;
  double still_share = 0.0;  ///< of the cycles, with a scale below 0.01
};

/// One closed loop of tracker, rows, guard and robot.
class Loop {
 public:
  Loop(GuardTask& task, bool together, double margin, double tilt)
      : task_(task), together_(together), margin_(margin), tilt_(tilt) {
    joints_ = std::make_shared<const SceneKinematics>(task.scene());
    tracker_.setScene(task.scene());
  }

  Run run(const std::string& guard, std::uint64_t number) {
    DelayedRobot robot(task_.begin(number), task_.acceleration(), together_);
    tracker_.restart();
    ConstraintRows rows(joints_, {task_.rowDistance(), 256, tilt_});
    GuardSettings settings;
    settings.margin = margin_;
    settings.reaction_time = kDelay * kStep + kPeriod;
    settings.deceleration = 1e3;  // the joints decide
    settings.joint_deceleration = task_.acceleration();
    VelocityGuard law(settings);
    SceneState state = joints_->startState();
    Run run;
    const int cycles = static_cast<int>(task_.timeLimit() / kPeriod);
    int cycle = 0;
    for (; cycle < cycles && !run.has_touched && !run.has_arrived; ++cycle) {
      const double time = cycle * kPeriod;
      joints_->evaluate(robot.positions(), state);
      task_.placeObstacles(state);
      tracker_.update(state.world_from_body, time);
      rows.update(tracker_.pairs(), state, time);
      const VectorXd wanted = task_.command(time, robot.positions());
      const double scale = scaleOf(guard, rows, law, wanted, time);
      run.mean_scale += scale;
      run.still_share += scale < 0.01 ? 1.0 : 0.0;
      for (int i = 0; i < static_cast<int>(std::lround(kPeriod / kStep)) && !run.has_touched; ++i) {
        robot.step(scale * wanted);
        task_.moveObstacles(kStep, robot.positions());
        run.has_touched = task_.touches(robot.positions());
      }
      run.has_arrived = !run.has_touched && task_.hasArrived(robot.positions());
    }
    run.seconds = cycle * kPeriod;
    run.mean_scale /= cycle;
    run.still_share /= cycle;
    return run;
  }

 private:
  double scaleOf(const std::string& guard, const ConstraintRows& rows, VelocityGuard& law,
                 const VectorXd& wanted, double time) {
    if (guard == "none") return 1.0;
    if (guard == "niches") return law.decide(rows, wanted, time, time).scale;
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < rows.rows().size(); ++i) {
      const ConstraintRow& row = rows.rows()[i];
      if (row.state != SlotState::Used) continue;
      if (!nearest || row.value < rows.rows()[*nearest].value) nearest = i;
    }
    if (guard == "nearest") {
      places_.clear();
      if (nearest) {
        GuardPlace& place = places_.emplace_back();
        place.value = rows.rows()[*nearest].value;
        place.closing = -rows.jacobian().row(static_cast<Eigen::Index>(*nearest)).dot(wanted);
        place.drift = rows.rows()[*nearest].drift;
      }
      return law.decide(places_, wanted.cwiseAbs().maxCoeff() / task_.acceleration(), time, time).scale;
    }
    const double threshold = std::stod(guard.substr(std::string("distance_").size()));
    const double distance = nearest ? rows.rows()[*nearest].value : threshold;
    return distance <= 0.0 ? 0.0 : std::min(1.0, std::exp(-std::log(0.001) * (distance / threshold - 1.0)));
  }

  GuardTask& task_;
  bool together_;
  double margin_;
  double tilt_;
  std::shared_ptr<const SceneKinematics> joints_;
  SceneTracker tracker_;
  std::vector<GuardPlace> places_;
};

using Runs = std::map<std::string, std::vector<Run>>;  ///< by guard

void sumUp(const std::string& task, const Runs& runs) {
  std::vector<bool> is_counted(runs.begin()->second.size(), true);
  for (const auto& [guard, all] : runs) {
    const auto arrived =
        std::count_if(all.begin(), all.end(), [](const Run& run) { return run.has_arrived; });
    if (2 * static_cast<std::size_t>(arrived) < all.size()) continue;
    for (std::size_t i = 0; i < all.size(); ++i) is_counted[i] = is_counted[i] && all[i].has_arrived;
  }
  for (const auto& [guard, all] : runs) {
    std::size_t contacts = 0;
    std::size_t arrivals = 0;
    std::size_t counted = 0;
    double sum = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      contacts += all[i].has_touched ? 1 : 0;
      arrivals += all[i].has_arrived ? 1 : 0;
      if (!is_counted[i] || !all[i].has_arrived) continue;
      ++counted;
      sum += all[i].seconds;
      largest = std::max(largest, all[i].seconds);
    }
    std::printf(
        "%-9s %-14s runs %3zu contacts %3zu arrived %3zu; of %3zu in common: mean %6.2f s, largest %6.2f s\n",
        task.c_str(), guard.c_str(), all.size(), contacts, arrivals, counted,
        sum / std::max<double>(1.0, static_cast<double>(counted)), largest);
  }
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("A velocity guard in a closed loop: contacts, and the time to leave");
  std::size_t runs = 200;
  std::string output;
  std::string joints = "together";
  std::string guards = "niches,nearest,distance_0.05,distance_0.2,none";
  std::string tasks = "arm,crate,narrow,crossing";
  app.add_option("--runs", runs, "of all tasks together");
  app.add_option("--output", output);
  app.add_option("--joints", joints)->check(CLI::IsMember({"together", "alone"}));
  app.add_option("--guards", guards);
  app.add_option("--tasks", tasks);
  double margin = 0.03;
  double tilt = 0.1;
  app.add_option("--margin", margin, "metres, of the guards niches and nearest");
  app.add_option("--tilt", tilt, "radians, of the rows");
  std::size_t only = static_cast<std::size_t>(-1);
  app.add_option("--only", only, "the run of this number alone");
  CLI11_PARSE(app, argc, argv);
  ResultTable table(output, "task,run,guard,contact,arrived,seconds,mean_scale,still_share");
  const std::vector<std::pair<std::string, std::unique_ptr<GuardTask> (*)()>> makers{
      {"arm", makeArmTask},
      {"crate", makeCrateTask},
      {"narrow", makeNarrowTask},
      {"crossing", makeCrossingTask}};
  std::map<std::string, Runs> all;
  for (std::size_t k = 0; k < makers.size(); ++k) {
    const auto& [name, make] = makers[k];
    if (("," + tasks + ",").find("," + name + ",") == std::string::npos) continue;
    const std::size_t count = runs * (k + 1) / makers.size() - runs * k / makers.size();
    const std::unique_ptr<GuardTask> task = make();
    Loop loop(*task, joints == "together", margin, tilt);
    std::istringstream list(guards);
    for (std::string guard; std::getline(list, guard, ',');) {
      for (std::size_t i = 0; i < count; ++i) {
        if (only != static_cast<std::size_t>(-1) && i != only) continue;
        const Run run = loop.run(guard, i);
        all[name][guard].push_back(run);
        table.add(name, i, guard, run.has_touched ? 1 : 0, run.has_arrived ? 1 : 0, run.seconds,
                  run.mean_scale, run.still_share);
      }
    }
  }
  for (const auto& [name, of_task] : all) sumUp(name, of_task);
  return 0;
}

}  // namespace concave_distance::benchmark
