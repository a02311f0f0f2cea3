#include "benchmark/support/contact_report.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "benchmark/support/stopwatch.h"
#include "concave_distance/base/error.h"

namespace concave_distance::benchmark {
namespace {

std::string largestLimit(const SimulationCounters& counters) {
  const auto largest = std::max_element(counters.limited_by.begin(), counters.limited_by.end());
  if (counters.steps == 0) return {};
  const auto limit = static_cast<StepLimit>(largest - counters.limited_by.begin());
  const double share = static_cast<double>(*largest) / static_cast<double>(counters.steps);
  return std::string(toString(limit)) + " " + std::to_string(std::lround(100.0 * share)) + " %";
}

void writeCell(std::ofstream& csv, double value) {
  csv << ',';
  if (!std::isnan(value)) csv << value;
}

}  // namespace

std::string SceneRow::within() const {
  if (std::isnan(bound)) return {};
  if (error > bound || run.end == RunEnd::Failed) return "no";
  if (run.end == RunEnd::Cut) return "cut";
  return std::isnan(error) ? "no" : "yes";
}

SceneReport::SceneReport(const std::string& file, double wall_limit) : wall_limit_(wall_limit) {
  std::printf("%-30s %-46s %-6s %12s %10s %12s %10s %-6s %9s %8s %9s %8s %s\n", "scene", "what", "unit",
              "expected", "bound", "found", "error", "within", "real time", "steps", "smallest", "balance",
              "ended by");
  if (file.empty()) return;
  csv_.open(file);
  if (!csv_) throw Error(file, "cannot be written", "name a file in a folder that is there");
  csv_ << "scene,what,unit,formula,expected,bound,found,error,within,real_time_factor,steps,smallest_step,"
          "limited_by,balance_share";
  for (std::size_t stage = 0; stage < kSimulationStages; ++stage) {
    csv_ << ',' << toString(static_cast<SimulationStage>(stage)) << "_share";
  }
  csv_ << ",wall,ended_by\n";
}

void SceneReport::equals(const SceneFigure& figure, double expected, double bound, const std::string& formula,
                         const RunFigures& run) {
  add({figure, formula, expected, bound, std::abs(figure.found - expected), run});
}

void SceneReport::atMost(const SceneFigure& figure, double bound, const std::string& formula,
                         const RunFigures& run) {
  equals(figure, 0.0, bound, formula, run);
}

void SceneReport::atLeast(const SceneFigure& figure, double least, const std::string& formula,
                          const RunFigures& run) {
  add({figure, formula, least, 0.0, std::max(0.0, least - figure.found), run});
}

void SceneReport::note(const SceneFigure& figure, const RunFigures& run) {
  add({figure, "", kNotComputed, kNotComputed, kNotComputed, run});
}

void SceneReport::realTimeFactor(const RunFigures& run, double aim) {
  const SceneFigure figure{"real-time factor", "1", run.realTimeFactor()};
  if (std::isnan(aim)) {
    note(figure, run);
  } else {
    atLeast(figure, aim, "aim", run);
  }
}

void SceneReport::add(const SceneRow& row) {
  print(row);
  if (csv_.is_open()) write(row);
}

void SceneReport::print(const SceneRow& row) const {
  std::printf("%-30s %-46s %-6s %12.6g %10.3g %12.6g %10.3g %-6s", scene_.c_str(), row.figure.what.c_str(),
              row.figure.unit.c_str(), row.expected, row.bound, row.figure.found, row.error,
              row.within().c_str());
  if (row.run.steps > 0) {
    std::printf(" %9.3g %8llu %9.2g %8.1g %s", row.run.realTimeFactor(),
                static_cast<unsigned long long>(row.run.steps), row.run.smallest_step, row.run.balance_share,
                row.run.ended_by.c_str());
  }
  std::printf("\n");
  std::fflush(stdout);
}

void SceneReport::write(const SceneRow& row) {
  csv_ << scene_ << ',' << row.figure.what << ',' << row.figure.unit << ',' << row.formula;
  for (const double value : {row.expected, row.bound, row.figure.found, row.error}) writeCell(csv_, value);
  csv_ << ',' << row.within();
  writeCell(csv_, row.run.realTimeFactor());
  csv_ << ',';
  if (row.run.steps > 0) csv_ << row.run.steps;
  writeCell(csv_, row.run.smallest_step);
  csv_ << ',' << row.run.limited_by;
  writeCell(csv_, row.run.balance_share);
  for (const double share : row.run.shares) writeCell(csv_, row.run.steps > 0 ? share : kNotComputed);
  writeCell(csv_, row.run.wall);
  csv_ << ',' << row.run.ended_by << '\n';
  csv_.flush();
}

SceneRun::SceneRun(Simulation simulation, double duration, const SceneReport& report)
    : simulation_(std::move(simulation)), duration_(duration), wall_limit_(report.wallLimit()) {}

bool SceneRun::step(double until) {
  if (!ended_by_.empty()) return false;
  if (simulation_.time() >= duration_) {
    stop("duration");
    return false;
  }
  if (wall_ > wall_limit_) {
    char text[64];
    std::snprintf(text, sizeof text, "cut at %.4g s of %.4g s", simulation_.time(), duration_);
    ended_by_ = text;
    return false;
  }
  const auto start = std::chrono::steady_clock::now();
  const double processor_start = processorMicroseconds();
  last_step_ = simulation_.step(std::min(until, duration_));
  processor_ += 1e-6 * (processorMicroseconds() - processor_start);
  wall_ += 1e-6 * microsecondsSince(start);
  observeEnergy();
  if (simulation_.status() == SimulationStatus::Ok) return true;
  giveUp("diverged");
  return false;
}

bool SceneRun::advanceTo(double time) {
  while (simulation_.time() < time) {
    if (!step(time)) return false;
  }
  return true;
}

void SceneRun::stop(const std::string& why) {
  ended_by_ = why;
  end_ = RunEnd::Complete;
}

void SceneRun::giveUp(const std::string& why) {
  ended_by_ = why;
  end_ = RunEnd::Failed;
}

void SceneRun::observeEnergy() {
  const EnergyAccount& energy = simulation_.energy();
  largest_imbalance_ = std::max(largest_imbalance_, std::abs(energy.balanceError()));
  energy_turned_over_ = std::max(
      energy_turned_over_, energy.kinetic + std::abs(energy.normal_work) + std::abs(energy.friction_work) +
                               std::abs(energy.load_work) + std::abs(energy.drive_work) + energy.drive_loss);
}

RunFigures SceneRun::figures() const {
  const SimulationCounters& counters = simulation_.counters();
  RunFigures figures;
  figures.simulated = simulation_.time();
  figures.processor = processor_;
  figures.wall = wall_;
  figures.steps = counters.steps;
  figures.smallest_step = counters.smallest_step;
  figures.balance_share = largest_imbalance_ / energy_turned_over_;
  for (std::size_t i = 0; i < kSimulationStages; ++i) figures.shares[i] = counters.seconds[i] / wall_;
  figures.limited_by = largestLimit(counters);
  figures.ended_by = ended_by_;
  figures.end = end_;
  return figures;
}

}  // namespace concave_distance::benchmark
