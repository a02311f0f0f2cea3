// Rows of constraints: their gradients beside differences of distances, and what fixed slots are worth to a
// solver that goes on from its last multipliers.
//
//   rows_benchmark gradients [--states 3334] [--distance 0.2]
//   rows_benchmark slots [--cycles 3000] [--sweeps 1] [--capacity 48] [--clear 0.09]
//
// `gradients` writes a line for each of three robots, in random states: rows and entries compared, entries
// where the niche changes its features within a step (compared on one side), entries where it does on both
// (not compared), rows of corners compared, one in eight (and not: of corners that brute force does not
// find), places nearer than 1 mm (not compared), and the worst difference as a share of its row's largest
// entry. `slots` moves the demo arm in its cell along its path, held back by a velocity damper for every row
// that keeps it `clear` metres away, with a solver of a few sweeps a cycle that begins with the multipliers
// of the cycle before: those of the slots, or of the rows in the order of their distance. It writes the
// largest and the mean jump of the commanded velocity (rad/s, norm) at cycles in which a row begins or ends
// and at the others, the least distance, how many rows have left their slot while their niche lived, and what
// making the rows takes.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <map>
#include <numeric>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "support/row_differences.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kPeriod = 0.01;  // s
constexpr double kGain = 2.0;     // 1/s

/// A projected Gauss-Seidel solver of: the velocities nearest to the wanted ones with J v >= bounds.
class DualSolver {
 public:
  DualSolver(std::size_t capacity, int sweeps)
      : multipliers_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(capacity))), sweeps_(sweeps) {}

  /// @param order the rows by the place of their multiplier; -1: none there
  Eigen::VectorXd solve(const Eigen::MatrixXd& gradients, const Eigen::VectorXd& bounds,
                        const std::vector<Eigen::Index>& order, const Eigen::VectorXd& wanted) {
    Eigen::VectorXd velocities = wanted;
    for (std::size_t i = 0; i < order.size(); ++i) {
      double& multiplier = multipliers_[static_cast<Eigen::Index>(i)];
      if (order[i] < 0) multiplier = 0.0;
      if (order[i] >= 0) velocities += multiplier * gradients.row(order[i]).transpose();
    }
    for (int sweep = 0; sweep < sweeps_; ++sweep) {
      for (std::size_t i = 0; i < order.size(); ++i) {
        if (order[i] < 0) continue;
        const auto gradient = gradients.row(order[i]);
        double& multiplier = multipliers_[static_cast<Eigen::Index>(i)];
        const double before = multiplier;
        const double squared = std::max(gradient.squaredNorm(), 1e-9);
        multiplier = std::max(0.0, before + (bounds[order[i]] - gradient.dot(velocities)) / squared);
        velocities += (multiplier - before) * gradient.transpose();
      }
    }
    return velocities;
  }

 private:
  Eigen::VectorXd multipliers_;
  int sweeps_;
};

struct Run {
  double largest_at_change = 0.0;
  double sum_at_change = 0.0;
  int changes = 0;
  double largest_else = 0.0;
  double sum_else = 0.0;
  int others = 0;
  double least_distance = 1e9;
  int moved_rows = 0;
  std::vector<double> update_us;  ///< of the rows alone, each cycle
  std::size_t rows = 0;           ///< of all cycles

  void print(const char* name) const {
    std::printf(
        "%s: cycles with a change %d, largest jump %.4f mean %.5f | others %d, largest %.4f mean %.5f\n",
        name, changes, largest_at_change, sum_at_change / std::max(1, changes), others, largest_else,
        sum_else / std::max(1, others));
    std::printf(
        "  least distance %.4f m, rows that left their slot %d, rows a cycle %.1f, us to make them: median "
        "%.1f, "
        "99th percentile %.1f\n",
        least_distance, moved_rows, static_cast<double>(rows) / static_cast<double>(update_us.size()),
        median(update_us), percentile(update_us, 0.99));
  }
};

struct Path {
  std::vector<std::vector<double>> rows;
  explicit Path(const std::string& file) {
    std::istringstream lines(test::packageFile(file));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream cells(line);
      rows.emplace_back(std::istream_iterator<double>(cells), std::istream_iterator<double>());
    }
  }
  Eigen::VectorXd at(double time) const {
    time = std::fmod(time, rows.back()[0]);
    std::size_t next = 1;
    while (next + 1 < rows.size() && rows[next][0] < time) ++next;
    const double share = (time - rows[next - 1][0]) / (rows[next][0] - rows[next - 1][0]);
    Eigen::VectorXd positions(static_cast<Eigen::Index>(rows[next].size() - 1));
    for (Eigen::Index i = 0; i < positions.size(); ++i) {
      const auto cell = static_cast<std::size_t>(i) + 1;
      positions[i] = rows[next - 1][cell] + share * (rows[next][cell] - rows[next - 1][cell]);
    }
    return positions;
  }
};

Run runCell(bool with_slots, int cycles, int sweeps, std::uint32_t capacity, double clear) {
  SceneLoadOptions options;
  options.package_locator = [](const std::string&) { return std::string(CONCAVE_DISTANCE_SOURCE_DIR); };
  options.descriptions["robot_description"] = test::packageFile("urdf/wam.urdf");
  const Scene scene = loadSceneFile(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/config/cell.yaml", options);
  const auto joints = std::make_shared<const SceneKinematics>(scene);
  const Path path("config/wam_path.csv");
  SceneTracker tracker;
  tracker.setScene(scene);
  ConstraintSettings settings;
  settings.distance = 0.25;  // the cutoff of the cell
  settings.capacity = capacity;
  ConstraintRows rows(joints, settings);
  SceneState state = joints->startState();
  Eigen::VectorXd positions = path.at(0.0);
  Eigen::VectorXd last = Eigen::VectorXd::Zero(positions.size());
  DualSolver solver(capacity, sweeps);
  Run run;
  std::map<std::tuple<std::uint64_t, std::uint64_t, std::uint64_t>, std::vector<std::size_t>> slots_of;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    const double time = cycle * kPeriod;
    joints->evaluate(positions, state);
    tracker.update(state.world_from_body, time);
    const auto start = std::chrono::steady_clock::now();
    rows.update(tracker.pairs(), state, time);
    run.update_us.push_back(microsecondsSince(start));
    const std::size_t count = rows.rows().size();
    Eigen::VectorXd bounds = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
    std::vector<Eigen::Index> order(count, -1);
    bool has_changed = false;
    decltype(slots_of) now;
    for (std::size_t slot = 0; slot < count; ++slot) {
      const ConstraintRow& row = rows.rows()[slot];
      has_changed = has_changed || (row.state == SlotState::Used && row.age == 0);
      if (row.state != SlotState::Used) continue;
      ++run.rows;
      order[slot] = static_cast<Eigen::Index>(slot);
      bounds[static_cast<Eigen::Index>(slot)] = -kGain * (row.value - clear);
      run.least_distance = std::min(run.least_distance, row.value);
      now[{row.pair->body_a->serial, row.pair->body_b->serial, row.niche_id}].push_back(slot);
    }
    for (const auto& [niche, before] : slots_of) {
      const auto found = now.find(niche);
      if (found == now.end()) {
        has_changed = true;
        continue;
      }
      // A niche that lives with as many rows keeps all of its slots.
      if (found->second.size() == before.size() && found->second != before) ++run.moved_rows;
    }
    slots_of = std::move(now);
    if (!with_slots) {
      std::sort(order.begin(), order.end(), [&](Eigen::Index l, Eigen::Index r) {
        if (l < 0 || r < 0) return l >= 0 && r < 0;
        return rows.rows()[static_cast<std::size_t>(l)].value <
               rows.rows()[static_cast<std::size_t>(r)].value;
      });
    }
    const Eigen::VectorXd wanted = (path.at(time + kPeriod) - positions) / 0.1;
    const Eigen::VectorXd velocities = solver.solve(rows.jacobian(), bounds, order, wanted);
    if (cycle > 0) {
      const double jump = (velocities - last).norm();
      (has_changed ? run.largest_at_change : run.largest_else) =
          std::max(has_changed ? run.largest_at_change : run.largest_else, jump);
      (has_changed ? run.sum_at_change : run.sum_else) += jump;
      ++(has_changed ? run.changes : run.others);
    }
    last = velocities;
    positions += kPeriod * velocities;
  }
  return run;
}

void compareGradients(int states, double distance) {
  for (const test::RowScene& given : test::rowScenes(distance)) {
    const test::RowDifferences found = test::differencesAtRandom(given, distance, states, 1);
    std::printf(
        "%-7s rows %zu entries %zu one-sided %zu unclear %zu corners %zu (%zu not) near %zu worst %.2e\n",
        given.name.c_str(), found.rows, found.entries, found.one_sided, found.unclear, found.corners,
        found.unknown, found.near, found.worst);
  }
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Rows of constraints: gradients, and jumps of commanded velocities");
  int states = 3334;
  double distance = 0.2;
  int cycles = 3000;
  int sweeps = 1;
  std::uint32_t capacity = 48;
  double clear = 0.09;
  CLI::App* gradients = app.add_subcommand("gradients");
  gradients->add_option("--states", states);
  gradients->add_option("--distance", distance);
  CLI::App* slots = app.add_subcommand("slots");
  slots->add_option("--cycles", cycles);
  slots->add_option("--sweeps", sweeps);
  slots->add_option("--capacity", capacity);
  slots->add_option("--clear", clear);
  app.require_subcommand(1);
  CLI11_PARSE(app, argc, argv);
  if (*gradients) compareGradients(states, distance);
  if (*slots) {
    runCell(true, cycles, sweeps, capacity, clear).print("slots");
    runCell(false, cycles, sweeps, capacity, clear).print("by distance");
  }
  return 0;
}

}  // namespace concave_distance::benchmark
