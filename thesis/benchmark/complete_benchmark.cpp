// Recall and precision of the shipped search, cold and tracked, against all niches, and what these cost anew.
//
//   complete_benchmark [--pairs ...] [--steps 200] [--windows 4] [--window 10] [--cold-runs 20]
//                      [--list-misses 0] [--accuracy refined] [--output doc/results/complete.csv]
//
// A pair is tracked at every instant of its motion; in windows of consecutive instants, spread evenly, every
// visible niche of prominence >= 1e-2 is found by findLocalMinima(), with a cutoff of 5 times the distance or
// a quarter of the smaller body's diameter, whichever is larger. Which true niche a reported one belongs to
// is decided by the same flood: exactly, over all triangle pairs.
//   niches   true niches at an instant
//   tracked  share of them that the tracker reports in the same cycle, summed over the instants observed
//   cold     the same for fresh solves with other seeds in the middle of each window
//   own      share of the tracker's niches below the cutoff that are the only ones in a true niche
//   double   share that lie in a true niche which another reported one is nearer to the bottom of
//   false    share that belong to no visible niche of the list at all
//   complete, cold, cycle: milliseconds, means; one thread. Complete leaves out the indices, built once.
// Reasons for what the cold solves missed: `grid`, no local minimum of the grids is refined to it; `unmet`,
// one is.
#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/niches/local_minima.h"
#include "mesh/trees/normal_cone_tree.h"
#include "search/grid/body_grid.h"
#include "search/local_descent.h"
#include "support/enumeration.h"
#include "thesis/benchmark/support/flood_recall.h"

namespace concave_distance::benchmark {
namespace {

struct Options {
  int steps = 200;
  int windows = 4;
  int window = 10;
  int cold_runs = 20;
  std::size_t list_misses = 0;
  TrackerParameters tracker;
};

double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// A niche that cold solves missed.
struct Miss {
  int instant;
  int times;
  double share_of_cutoff;
  LocalMinimum niche;
  const char* reason;  ///< of the first time
};

struct Tally {
  RecallShares tracked;
  RecallShares cold;
  std::vector<double> complete_ms;
  std::vector<double> cold_ms;
  std::vector<double> cycle_ms;
  double index_ms = 0.0;
  int observed = 0;
  double niches = 0.0;
  std::map<std::string, int> missed;  ///< by reason
  std::uint64_t met_by_flood = 0;
  std::vector<Miss> misses;
};

class Comparison {
 public:
  Comparison(const BenchmarkPair& pair, const Options& options)
      : pair_(pair), options_(options), start_(std::chrono::steady_clock::now()) {
    pair.a->normalCones(NormalSides::Outside);
    pair.b->normalCones(NormalSides::Outside);
    pair.a->adjacency();
    pair.b->adjacency();
    tally_.index_ms = millisecondsSince(start_);
  }

  Tally run() {
    PairTracker tracker(pair_.name, pair_.a, pair_.b, options_.tracker);
    PairSolution solution;
    for (int k = 0; k < options_.steps; ++k) {
      const double t = options_.steps > 1 ? static_cast<double>(k) / (options_.steps - 1) : 0.0;
      const Eigen::Isometry3d pose = pair_.motion(t);
      tracker.update(pose, 5.0 * t, solution);
      if (k > 0) tally_.cycle_ms.push_back(1e3 * solution.solve_seconds);
      const int place = placeInWindow(k);
      if (place < 0) continue;
      const double cutoff = floodCutoff(pair_, pose);
      timeComplete(pose, cutoff);
      const LocalMinima truth = compare(pose, cutoff, solution, tally_.tracked);
      ++tally_.observed;
      tally_.niches += static_cast<double>(truth.niches.size());
      if (place == options_.window / 2) tryCold(pose, cutoff, k);
    }
    return tally_;
  }

 private:
  /// Instant k's place in its window; -1 outside.
  int placeInWindow(int k) const {
    for (int window = 0; window < options_.windows; ++window) {
      const int first =
          static_cast<int>((window + 0.5) * options_.steps / options_.windows) - options_.window / 2;
      if (k >= first && k < first + options_.window) return k - first;
    }
    return -1;
  }

  LocalMinima compare(const Eigen::Isometry3d& pose, double cutoff, const PairSolution& solution,
                      RecallShares& shares) {
    FloodComparison comparison = compareWithFlood(pair_, pose, cutoff, solution, shares);
    missed_ = std::move(comparison.missed);
    return std::move(comparison.truth);
  }

  void timeComplete(const Eigen::Isometry3d& pose, double cutoff) {
    const auto start = std::chrono::steady_clock::now();
    LocalMinimaRequest request;
    request.cutoff = cutoff;
    tally_.met_by_flood += findLocalMinima(*pair_.a, *pair_.b, pose, request).cost.met_by_search;
    tally_.complete_ms.push_back(millisecondsSince(start));
  }

  void tryCold(const Eigen::Isometry3d& pose, double cutoff, int instant) {
    const int runs = std::max(1, options_.cold_runs / options_.windows);
    std::set<std::size_t> led_to;
    bool grid_known = false;
    for (int run = 0; run < runs; ++run) {
      TrackerParameters parameters = options_.tracker;
      parameters.seed = 1000 * static_cast<std::uint64_t>(run) + static_cast<std::uint64_t>(instant) + 1;
      const auto start = std::chrono::steady_clock::now();
      const PairSolution fresh = solveOnce(pair_.name, pair_.a, pair_.b, parameters, pose);
      tally_.cold_ms.push_back(millisecondsSince(start));
      const LocalMinima truth = compare(pose, cutoff, fresh, tally_.cold);
      if (missed_.empty()) continue;
      if (!grid_known) led_to = gridLeadsTo(pose, cutoff);
      grid_known = true;
      for (const std::size_t i : missed_) {
        if (Miss* known = knownMiss(instant, truth.niches[i])) {
          ++known->times;
          ++tally_.missed[known->reason];
          continue;
        }
        const char* reason = led_to.count(i) == 0 ? "grid" : "unmet";
        ++tally_.missed[reason];
        tally_.misses.push_back({instant, 1, truth.niches[i].distance / cutoff, truth.niches[i], reason});
      }
    }
  }

  /// The miss of this niche by another run at the same instant, or null.
  Miss* knownMiss(int instant, const LocalMinimum& niche) {
    for (Miss& miss : tally_.misses) {
      if (miss.instant == instant && std::abs(miss.niche.distance - niche.distance) < 1e-12) return &miss;
    }
    return nullptr;
  }

  /// The true niches that refinements of the grids' own local minima end in.
  std::set<std::size_t> gridLeadsTo(const Eigen::Isometry3d& pose, double cutoff) {
    FloodStarts starts;
    const double slack = gridOf(*pair_.a).nodes().max_edge_length + gridOf(*pair_.b).nodes().max_edge_length;
    for (const test::NodeNiche& niche :
         test::enumerateNodeNiches(*pair_.a, *pair_.b, pose, cutoff + slack, 0.0)) {
      starts.emplace_back(gridOf(*pair_.a).nodes().originalTriangle(niche.node_a),
                          gridOf(*pair_.b).nodes().originalTriangle(niche.node_b));
    }
    const LocalMinima truth = trueNiches(pair_, pose, cutoff, starts);
    std::set<std::size_t> owners(truth.owners.begin(), truth.owners.end());
    return owners;
  }

  const BenchmarkPair& pair_;
  Options options_;
  std::chrono::steady_clock::time_point start_;
  Tally tally_;
  std::vector<std::size_t> missed_;  ///< of the last comparison
};

void list(std::vector<Miss> misses, std::size_t count) {
  std::sort(misses.begin(), misses.end(),
            [](const Miss& l, const Miss& r) { return l.niche.prominence > r.niche.prominence; });
  for (std::size_t i = 0; i < std::min(count, misses.size()); ++i) {
    const LocalMinimum& niche = misses[i].niche;
    const bool measured = std::isfinite(niche.prominence);
    const char* kind = niche.kind == NicheKind::Point     ? "point"
                       : niche.kind == NicheKind::Segment ? "segment"
                                                          : "patch";
    std::printf("    instant %3d, %d times: distance %.6f (%.2f of the cutoff), prominence %s%.4f, %s, %s\n",
                misses[i].instant, misses[i].times, niche.distance, misses[i].share_of_cutoff,
                measured ? "" : ">= ", measured ? niche.prominence : kProminentNiche, kind, misses[i].reason);
  }
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Recall and precision against the niches found from scratch");
  std::vector<std::string> names = allPairs();
  Options options;
  std::string output;
  app.add_option("--pairs", names, "Pairs to run; all when left out")->delimiter(',');
  app.add_option("--steps", options.steps, "Instants along each motion")->check(CLI::PositiveNumber);
  app.add_option("--windows", options.windows, "Windows that are observed")->check(CLI::PositiveNumber);
  app.add_option("--window", options.window, "Instants of each")->check(CLI::PositiveNumber);
  app.add_option("--cold-runs", options.cold_runs, "Cold solves of each pair")->check(CLI::PositiveNumber);
  app.add_option("--list-misses", options.list_misses,
                 "Of what the cold solves missed, list the most prominent");
  options.tracker.largest_niche_count = 2000;
  app.add_option("--accuracy", options.tracker.accuracy, "level of the tracker")
      ->transform(CLI::CheckedTransformer(std::map<std::string, AccuracyLevel>{
          {"refined", AccuracyLevel::Refined}, {"certified", AccuracyLevel::Certified}}));
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  ResultTable table(
      output,
      "pair,triangles_a,triangles_b,observed,niches_mean,tracked_recall,tracked_prominent_recall,"
      "cold_recall,cold_prominent_recall,tracked_own,tracked_double,tracked_false,cold_own,"
      "cold_double,cold_false,missed_grid,missed_unmet,index_ms,complete_ms,complete_max_ms,cold_ms,"
      "cycle_ms,met_by_flood");
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    Tally t = Comparison(pair, options).run();
    const auto share_of_tracked = [&](double part) { return RecallShares::share(part, t.tracked.reported); };
    const auto share_of_cold = [&](double part) { return RecallShares::share(part, t.cold.reported); };
    table.add(name, pair.a->surface().triangleCount(), pair.b->surface().triangleCount(), t.observed,
              t.niches / t.observed, t.tracked.recall(), t.tracked.prominentRecall(), t.cold.recall(),
              t.cold.prominentRecall(), share_of_tracked(t.tracked.own), share_of_tracked(t.tracked.doubled),
              share_of_tracked(t.tracked.none), share_of_cold(t.cold.own), share_of_cold(t.cold.doubled),
              share_of_cold(t.cold.none), t.missed["grid"], t.missed["unmet"], t.index_ms,
              mean(t.complete_ms), *std::max_element(t.complete_ms.begin(), t.complete_ms.end()),
              mean(t.cold_ms), mean(t.cycle_ms), t.met_by_flood);
    list(t.misses, options.list_misses);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
