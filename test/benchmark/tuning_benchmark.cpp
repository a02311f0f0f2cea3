// Which parameters the shipped ones should be: recall first, then time, chosen on some pairs and checked on
// the others.
//
//   tuning_benchmark [--part search|tracked|refined] [--steps 120] [--observed 12] [--seeds 4]
//                    [--output doc/results/tuning.csv]
//
// The pairs are dealt out by turns: every second one of allPairs() for tuning, the rest for checking; both
// halves have pairs of every family. A line is one variant of the shipped parameters: recall of the true
// niches, of the prominent ones, and time as a multiple of the shipped parameters' in the same run, pair by
// pair in turns; means over pairs (geometric of the times); `own`, the share of the reported niches
// that are the only ones in a true one; `births`, new ids a cycle.
//   search   level `nodes`, cold: the genetic search alone. Truth: the flood of the product graph, prominence
//            >= 1e-2. `recall` counts every local minimum met, `prominent` those of the final population,
//            `nearest` the share of runs that met the nearest niche.
//   tracked  level `certified` along the motion, where the search decides nothing but the time. Truth: the
//            proven list at instants spread over it; `nearest` is the share of all instants whose distance is
//            not above FCL's.
//   refined  the same at level `refined`, where no proof mends what the search has missed.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <regex>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/flood_recall.h"
#include "benchmark/support/search_trial.h"
#include "benchmark/support/tuning_variants.h"
#include "concave_distance/tracking/pair_tracker.h"

namespace concave_distance::benchmark {
namespace {

// FCL's own rounding, metres.
constexpr double kSameDistance = 1e-6;

struct Options {
  int steps = 120;
  int observed = 12;
  std::uint64_t seeds = 4;
};

/// One variant's figures on one pair.
struct Figures {
  double recall = 0.0;
  double prominent = 0.0;
  double nearest = 1.0;
  double own = 1.0;     ///< share of the reported niches that are the only ones in a true one
  double births = 0.0;  ///< new ids a cycle
  double seconds = 0.0;
};
using Part = std::vector<Figures> (*)(const BenchmarkPair&, const std::vector<TuningVariant>&,
                                      const Options&);

TrackerParameters shippedForMeasuring() {
  TrackerParameters parameters;
  parameters.largest_niche_count = 2000;
  return parameters;
}

std::vector<Figures> trySearchVariants(const BenchmarkPair& pair, const std::vector<TuningVariant>& variants,
                                       const Options& options) {
  const std::vector<SearchScene> scenes = searchScenes(pair, 3, kLeastTrueProminence);
  std::vector<Figures> figures(variants.size());
  for (Figures& f : figures) f.nearest = 0.0;
  for (const SearchScene& scene : scenes) {  // brings the meshes into the caches
    trySearch(pair, scene, {"warm-up", TrackerParameters().cold}, 1.0, 0, kLeastTrueProminence);
  }
  for (std::uint64_t seed = 0; seed < options.seeds; ++seed) {
    for (std::size_t i = 0; i < variants.size(); ++i) {
      TrackerParameters parameters;
      variants[i].change(parameters);
      for (const SearchScene& scene : scenes) {
        const SearchOutcome outcome =
            trySearch(pair, scene, {variants[i].name, parameters.cold}, 1.0, seed, kLeastTrueProminence);
        const double n = static_cast<double>(options.seeds * scenes.size());
        figures[i].recall += outcome.archive_recall / n;
        figures[i].prominent += outcome.population_recall / n;
        figures[i].nearest += outcome.nearest / n;
        figures[i].seconds += 1e-6 * outcome.microseconds;
      }
    }
  }
  return figures;
}

void setShares(const std::vector<RecallShares>& shares, std::vector<Figures>& figures) {
  for (std::size_t i = 0; i < shares.size(); ++i) {
    figures[i].recall = shares[i].recall();
    figures[i].prominent = shares[i].prominentRecall();
    figures[i].own = RecallShares::share(shares[i].own, shares[i].reported);
  }
}

std::ptrdiff_t births(const PairSolution& solution) {
  return std::count_if(solution.events.begin(), solution.events.end(),
                       [](const NicheEvent& event) { return event.kind == NicheEvent::Kind::Birth; });
}

template <AccuracyLevel level>
std::vector<Figures> tryCycleVariants(const BenchmarkPair& pair, const std::vector<TuningVariant>& variants,
                                      const Options& options) {
  std::vector<Figures> figures(variants.size());
  std::vector<RecallShares> shares(variants.size());
  std::vector<PairTracker> trackers;
  for (const TuningVariant& variant : variants) {
    TrackerParameters parameters = shippedForMeasuring();
    parameters.accuracy = level;
    variant.change(parameters);
    trackers.emplace_back(pair.name, pair.a, pair.b, parameters).prepare();
  }
  PairSolution solution;
  const int stride = std::max(1, options.steps / options.observed);
  for (int k = 0; k < options.steps; ++k) {
    const double t = static_cast<double>(k) / std::max(1, options.steps - 1);
    const Eigen::Isometry3d pose = pair.motion(t);
    const bool observed = k % stride == stride - 1;
    const double cutoff = observed ? floodCutoff(pair, pose) : 0.0;
    const double nearest = fclDistance(*pair.fcl_a, *pair.fcl_b, pose).distance;
    for (std::size_t i = 0; i < variants.size(); ++i) {
      // Whoever comes first finds the meshes out of the caches: by turns.
      const std::size_t turn = (i + static_cast<std::size_t>(k)) % variants.size();
      trackers[turn].update(pose, 5.0 * t, solution);
      if (k > 0) {
        figures[turn].seconds += solution.solve_seconds;
        figures[turn].births += static_cast<double>(births(solution)) / (options.steps - 1);
      }
      figures[turn].nearest -= solution.distance > nearest + kSameDistance ? 1.0 / options.steps : 0.0;
      if (observed) compareWithFlood(pair, pose, cutoff, solution, shares[turn]);
    }
  }
  setShares(shares, figures);
  return figures;
}

class Report {
 public:
  Report(const std::string& part, const std::string& file) : part_(part) {
    if (file.empty()) return;
    csv_.open(file, std::ios::app);
    if (csv_.tellp() == 0)
      csv_ << "part,variant,pair,used_for,recall,prominent,nearest,own,births,time_ratio\n";
  }

  void add(const std::vector<TuningVariant>& variants, const BenchmarkPair& pair, bool tuning,
           const std::vector<Figures>& figures) {
    sums_.resize(variants.size());
    for (std::size_t i = 0; i < variants.size(); ++i) {
      const double ratio = figures[i].seconds / figures.front().seconds;
      Sum& sum = tuning ? sums_[i].tuning : sums_[i].check;
      sum.pairs += 1.0;
      sum.recall += figures[i].recall;
      sum.prominent += figures[i].prominent;
      sum.nearest += figures[i].nearest;
      sum.own += figures[i].own;
      sum.births += figures[i].births;
      sum.log_ratio += std::log(ratio);
      if (csv_) {
        csv_ << part_ << ",\"" << variants[i].name << "\"," << pair.name << ','
             << (tuning ? "tuning" : "check") << ',' << figures[i].recall << ',' << figures[i].prominent
             << ',' << figures[i].nearest << ',' << figures[i].own << ',' << figures[i].births << ',' << ratio
             << '\n'
             << std::flush;
      }
    }
  }

  void print(const std::vector<TuningVariant>& variants) const {
    std::printf("%s\n%-34s | %-47s | check\n%-34s |", part_.c_str(), "", "tuning", "");
    for (int half = 0; half < 2; ++half) {
      std::printf(" %7s %9s %7s %6s %6s %6s%s", "recall", "prominent", "nearest", "own", "births", "time",
                  half == 0 ? " |" : "\n");
    }
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      std::printf("%-34s |", variants[i].name.c_str());
      sums_[i].tuning.print();
      std::printf(" |");
      sums_[i].check.print();
      std::printf("\n");
    }
  }

 private:
  struct Sum {
    double pairs = 0.0, recall = 0.0, prominent = 0.0, nearest = 0.0, own = 0.0, births = 0.0,
           log_ratio = 0.0;
    void print() const {
      std::printf(" %7.4f %9.4f %7.4f %6.3f %6.3f %6.3f", recall / pairs, prominent / pairs, nearest / pairs,
                  own / pairs, births / pairs, std::exp(log_ratio / pairs));
    }
  };
  struct Halves {
    Sum tuning, check;
  };
  std::string part_;
  std::ofstream csv_;
  std::vector<Halves> sums_;
};

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Variants of the shipped parameters: recall and time, on pairs for tuning and on others");
  const std::map<std::string, std::pair<Part, std::vector<TuningVariant> (*)()>> parts = {
      {"search", {trySearchVariants, searchVariants}},
      {"tracked", {tryCycleVariants<AccuracyLevel::Certified>, shareVariants}},
      {"refined", {tryCycleVariants<AccuracyLevel::Refined>, cycleVariants}}};
  Options options;
  std::vector<std::string> wanted = {"search", "tracked", "refined"};
  std::vector<std::string> names = allPairs();
  std::string output;
  app.add_option("--part", wanted, "What to compare")->delimiter(',')->check(CLI::IsMember(parts));
  app.add_option("--pairs", names, "Pairs to run; all when left out")->delimiter(',');
  std::string only;
  app.add_option("--variants", only, "Only variants whose name matches this regular expression");
  app.add_option("--steps", options.steps, "Instants along each motion")->check(CLI::PositiveNumber);
  app.add_option("--observed", options.observed, "Instants compared with the truth")
      ->check(CLI::PositiveNumber);
  app.add_option("--seeds", options.seeds, "Runs of a cold search at each pose")->check(CLI::PositiveNumber);
  app.add_option("--output", output, "CSV file that rows are added to");
  CLI11_PARSE(app, argc, argv);

  const std::vector<std::string> order = allPairs();
  for (const std::string& part : wanted) {
    const auto& [run, variants_of] = parts.at(part);
    std::vector<TuningVariant> variants = variants_of();
    variants.erase(
        std::remove_if(variants.begin() + 1, variants.end(),
                       [&](const TuningVariant& v) { return !std::regex_search(v.name, std::regex(only)); }),
        variants.end());
    Report report(part, output);
    for (const std::string& name : names) {
      const auto place = std::find(order.begin(), order.end(), name) - order.begin();
      const BenchmarkPair pair = loadBenchmarkPair(name);
      report.add(variants, pair, place % 2 == 0, run(pair, variants, options));
      std::fprintf(stderr, "%s: %s\n", part.c_str(), name.c_str());
    }
    report.print(variants);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
