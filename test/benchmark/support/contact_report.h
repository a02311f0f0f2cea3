#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <string>

#include "concave_distance/simulation/simulation.h"

namespace concave_distance::benchmark {

enum class RunEnd : std::uint8_t {
  Complete,
  Cut,    ///< by the wall clock
  Failed  ///< diverged, or a body went where nothing can be seen any more
};

/// How a simulation went; all of it empty where nothing was simulated.
struct RunFigures {
  double simulated = kNotComputed;  ///< seconds
  double processor = kNotComputed;  ///< seconds of its thread
  double wall = kNotComputed;       ///< seconds, with what else the machine did
  std::uint64_t steps = 0;
  double smallest_step = kNotComputed;  ///< seconds
  double balance_share = kNotComputed;  ///< largest error of the energy balance over the energy turned over
  std::array<double, kSimulationStages> shares{};  ///< of the wall time
  std::string limited_by;                          ///< what held back most steps, and how many
  std::string ended_by;
  RunEnd end = RunEnd::Complete;

  double realTimeFactor() const { return simulated / processor; }
};

/// What was found.
struct SceneFigure {
  std::string what;
  std::string unit;
  double found = kNotComputed;
};

/// A figure beside what it should be.
struct SceneRow {
  SceneFigure figure;
  std::string formula;  ///< what the expected value or the bound comes from, without commas
  double expected = kNotComputed;
  double bound = kNotComputed;  ///< of the error, in the figure's unit; NaN: the figure is only noted
  double error = kNotComputed;
  RunFigures run;

  /// "yes", "no", "cut" (nothing wrong so far, but the run did not reach its end); empty without a bound.
  std::string within() const;
};

/// Prints rows as they come, and writes them to a CSV file where one is named.
class SceneReport {
 public:
  /// @param wall_limit seconds that one simulation may take @throws Error when the file cannot be written
  SceneReport(const std::string& file, double wall_limit);

  double wallLimit() const { return wall_limit_; }
  void begin(const std::string& scene) { scene_ = scene; }

  /// |found - expected| is at most `bound`.
  void equals(const SceneFigure& figure, double expected, double bound, const std::string& formula,
              const RunFigures& run = {});
  /// |found| is at most `bound`.
  void atMost(const SceneFigure& figure, double bound, const std::string& formula,
              const RunFigures& run = {});
  /// An aim for speeds: the error is what is missing to it.
  void atLeast(const SceneFigure& figure, double least, const std::string& formula,
               const RunFigures& run = {});
  void note(const SceneFigure& figure, const RunFigures& run = {});
  void realTimeFactor(const RunFigures& run, double aim);  ///< NaN: only noted

 private:
  void add(const SceneRow& row);
  void print(const SceneRow& row) const;
  void write(const SceneRow& row);

  std::string scene_;
  double wall_limit_;
  std::ofstream csv_;
};

/// A simulation that is stepped up to its duration, as long as the wall clock allows.
class SceneRun {
 public:
  SceneRun(Simulation simulation, double duration, const SceneReport& report);

  /// One step, never beyond `until`. @return false when there is nothing left to do
  bool step(double until = std::numeric_limits<double>::infinity());
  /// @return false when the run ended before `time`
  bool advanceTo(double time);
  void stop(const std::string& why);    ///< what the scene was to show has been seen
  void giveUp(const std::string& why);  ///< it cannot be seen any more: the run has failed

  Simulation& simulation() { return simulation_; }
  const SimulatedBody& body(std::size_t index) const { return simulation_.bodies()[index]; }
  double time() const { return simulation_.time(); }
  double lastStep() const { return last_step_; }
  RunFigures figures() const;

 private:
  void observeEnergy();

  Simulation simulation_;
  double duration_;
  double wall_limit_;
  double wall_ = 0.0;
  double processor_ = 0.0;
  double last_step_ = 0.0;
  double largest_imbalance_ = 0.0;
  double energy_turned_over_ = 0.0;
  std::string ended_by_;
  RunEnd end_ = RunEnd::Cut;
};

}  // namespace concave_distance::benchmark
