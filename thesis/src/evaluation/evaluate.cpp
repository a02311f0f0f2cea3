// Runs experiments: the tables and figures of the thesis, and of any other experiment file.
//
//   evaluate thesis/experiments/table_5_9.yaml [more ...] [--size quick|full] [--runs N] [--shard i/n]
//            [--output build/evaluation] [--meshes meshes/thesis]
//
// Results: a line a run in <output>/<experiment>.csv; an evaluation that was interrupted goes on where it
// ended. Shards share no file when each has a folder of its own; scripts/report.sh joins them.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "base/run_tool.h"
#include "concave_distance/base/error.h"
#include "run_experiment.h"

namespace {

using concave_distance::evaluation::EvaluationOptions;
using concave_distance::evaluation::Experiment;

/// i/n: 0 <= i < n.
void readShard(const std::string& text, EvaluationOptions& options) {
  unsigned shard = 0;
  unsigned count = 0;
  char end = 0;
  if (std::sscanf(text.c_str(), "%u/%u%c", &shard, &count, &end) != 2 || count == 0 || shard >= count) {
    throw CLI::ValidationError("--shard", "is " + text + "; give i/n with i from 0 to n - 1, e.g. 0/8");
  }
  options.shard = shard;
  options.shard_count = count;
}

/// A bar on a terminal, a line for every tenth elsewhere.
class ProgressBar {
 public:
  explicit ProgressBar(std::string name) : name_(std::move(name)), start_(Clock::now()) {}

  void show(std::uint64_t done, std::uint64_t all) {
    if (all == 0) return;
    if (last_ == kNever) first_ = done;
    const double share = static_cast<double>(done) / static_cast<double>(all);
    const auto tenth = static_cast<int>(share * 10.0);
    const bool terminal = isatty(STDERR_FILENO) != 0;
    if (!terminal && last_ == tenth) return;
    last_ = tenth;
    const double taken = std::chrono::duration<double>(Clock::now() - start_).count();
    const double left =
        done > first_ ? taken * static_cast<double>(all - done) / static_cast<double>(done - first_) : 0.0;
    const std::string bar(static_cast<std::size_t>(share * 30.0), '#');
    std::fprintf(stderr, "%s%-28s [%-30s] %llu of %llu runs, %.0f s left%s", terminal ? "\r" : "",
                 name_.c_str(), bar.c_str(), static_cast<unsigned long long>(done),
                 static_cast<unsigned long long>(all), left, terminal && done < all ? "   " : "   \n");
    std::fflush(stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int kNever = -1;
  std::string name_;
  Clock::time_point start_;
  std::uint64_t first_ = 0;
  int last_ = kNever;
};

int run(int argc, char** argv) {
  CLI::App app("Runs experiments, many seeded runs of search algorithms");
  std::vector<std::string> files;
  EvaluationOptions options;
  options.meshes = "meshes/thesis";
  options.output = "build/evaluation";
  std::string size = "quick";
  std::string shard = "0/1";
  app.add_option("experiments", files, "Experiment files")->required()->check(CLI::ExistingFile);
  app.add_option("--size", size, "Counts of runs as in the files")->check(CLI::IsMember({"quick", "full"}));
  app.add_option("--runs", options.runs, "Runs of every row on every scene, instead of the file's");
  app.add_option("--shard", shard, "i/n: do the i-th of n parts of the work");
  app.add_option("--output", options.output, "Folder of the results")->capture_default_str();
  app.add_option("--meshes", options.meshes, "Folder of the meshes and poses")->capture_default_str();
  try {
    app.parse(argc, argv);
    readShard(shard, options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  const std::uint32_t asked = options.runs;
  for (const std::string& file : files) {
    const Experiment experiment = concave_distance::evaluation::loadExperiment(file);
    options.runs = asked > 0 ? asked : size == "full" ? experiment.full_runs : experiment.quick_runs;
    ProgressBar bar(experiment.name);
    concave_distance::evaluation::runExperiment(
        experiment, options, [&bar](std::uint64_t done, std::uint64_t all) { bar.show(done, all); });
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return concave_distance::runTool("evaluate", argc, argv, run);
}
