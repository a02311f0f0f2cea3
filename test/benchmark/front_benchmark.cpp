// Measures what is saved over a motion by what the front of normal cones and the decider of niches keep from
// pose to pose, beside FCL's one distance, in one run and one thread.
//
//   front_benchmark [--pairs name,name,...] [--steps 500,5000] [--instants 100] [--windows 4] [--output FILE]
//                   [--files a.stl:b.stl,...]
//
// With --files, pairs of mesh files instead: the second body circles the first one as near as it can without
// touching it (at 32 instants), turning.
//
// A row is a pair and a number of instants along its motion (5 s long: 500 is 100 Hz). In windows spread over
// the motion consecutive instants are looked at: microseconds (medians) of FCL, of all cones from the roots,
// of the front (and its 99th percentile); pairs that the front keeps, that have expired, groups compared,
// features looked at, live pairs of features, minima and pairs of features that begin or cease to hold one
// (`events`; means); windows' instants at which the front was begun anew; local minima that only the cones
// from the roots (`missed`) or only the front (`more`) led to. Then the decider: microseconds (medians) of
// floods alone and of what is kept (and its 99th percentile); means of niches, of ripples settled by a known
// path, links of paths that were given other points, niches by a known border and by one that was mended,
// floods, cells flooded and border elements measured; instants at which the niches were others than those of
// floods (`other`).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/circling_pair.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "distance/kernels/witness_refinement.h"
#include "distance/minima/minima_candidates.h"
#include "distance/minima/minima_tracker.h"
#include "distance/niches/niche_decider.h"
#include "support/judged_niches.h"

namespace concave_distance::benchmark {
namespace {

using detail::MinimaTracker;
using detail::NicheDecider;
using test::nichesOf;

std::vector<WitnessPair> placesOf(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                                  const std::vector<MinimumCandidate>& candidates) {
  RefinementWorkspace workspace;
  std::vector<WitnessPair> places;
  places.reserve(candidates.size());
  for (const MinimumCandidate& candidate : candidates) {
    places.push_back(refineWitness(*pair.a, *pair.b, pose, candidate.a, candidate.b, workspace).witness);
  }
  return places;
}

/// Places of the one that are none of the other's.
std::size_t countOnly(const std::vector<WitnessPair>& of, const std::vector<WitnessPair>& others,
                      double tolerance) {
  std::size_t count = 0;
  for (const WitnessPair& place : of) {
    const bool is_known = std::any_of(others.begin(), others.end(), [&](const WitnessPair& other) {
      return (place.point_a_in_a - other.point_a_in_a).norm() +
                 (place.point_b_in_a - other.point_b_in_a).norm() <=
             tolerance;
    });
    count += is_known ? 0 : 1;
  }
  return count;
}

struct Sample {
  std::vector<double> fcl_us;
  std::vector<double> roots_us;
  std::vector<double> front_us;
  MinimaTracker::Counts sum;
  double kept = 0.0;
  double live = 0.0;
  double expired = 0.0;
  double groups = 0.0;
  double features = 0.0;
  int anew = 0;
  std::size_t missed = 0;
  std::size_t more = 0;
  std::size_t candidates = 0;
  std::vector<std::array<std::uint32_t, 4>> alive;  ///< features that hold minima at the last instant
  std::size_t events = 0;
  std::vector<double> floods_us;
  std::vector<double> judge_us;
  double niches = 0.0;
  double by_path = 0.0;
  double aimed = 0.0;
  double by_border = 0.0;
  double mended = 0.0;
  double floods = 0.0;
  double cells = 0.0;
  double measured = 0.0;
  int other = 0;
};

/// Features that begin or cease to hold a minimum: what no way to keep anything could spare.
void countEvents(const std::vector<MinimumCandidate>& candidates, bool first, Sample& sample) {
  std::vector<std::array<std::uint32_t, 4>> alive;
  for (const MinimumCandidate& candidate : candidates) {
    alive.push_back({candidate.a.value, candidate.b.value, static_cast<std::uint32_t>(candidate.feature_a),
                     static_cast<std::uint32_t>(candidate.feature_b)});
  }
  std::sort(alive.begin(), alive.end());
  if (!first) {
    std::vector<std::array<std::uint32_t, 4>> changed;
    std::set_symmetric_difference(alive.begin(), alive.end(), sample.alive.begin(), sample.alive.end(),
                                  std::back_inserter(changed));
    sample.events += changed.size();
  }
  sample.alive.swap(alive);
}

bool isSame(const std::vector<double>& l, const std::vector<double>& r, double tolerance) {
  return std::equal(l.begin(), l.end(), r.begin(), r.end(),
                    [&](double x, double y) { return std::abs(x - y) <= tolerance; });
}

void judge(const detail::PairFrame& frame, std::vector<MinimumCandidate> candidates, NicheDecider& decider,
           bool first, Sample& sample) {
  WorkLimit none;
  NicheDecider::Request request;
  auto start = std::chrono::steady_clock::now();
  decider.judge(frame, candidates, request, none);
  const double judge_us = microsecondsSince(start);
  request.is_tracked = false;
  NicheDecider alone;
  start = std::chrono::steady_clock::now();
  alone.judge(frame, candidates, request, none);
  const double floods_us = microsecondsSince(start);
  const std::vector<double> niches = nichesOf(decider);
  sample.other += isSame(niches, nichesOf(alone), 1e-9 * frame.size) ? 0 : 1;
  if (first) return;
  sample.judge_us.push_back(judge_us);
  sample.floods_us.push_back(floods_us);
  const NicheDecider::Counts& counts = decider.counts();
  sample.niches += static_cast<double>(niches.size());
  sample.by_path += counts.by_path;
  sample.aimed += counts.aimed;
  sample.by_border += counts.by_boundary;
  sample.mended += counts.mended;
  sample.floods += counts.searches;
  sample.cells += counts.visited_pairs;
  sample.measured += counts.measured;
}

void observe(const BenchmarkPair& pair, const Eigen::Isometry3d& pose, MinimaTracker& front,
             NicheDecider& decider, bool first, Sample& sample) {
  const double cutoff = std::numeric_limits<double>::infinity();
  WorkLimit none;
  auto start = std::chrono::steady_clock::now();
  fclDistance(*pair.fcl_a, *pair.fcl_b, pose);
  const double fcl_us = microsecondsSince(start);
  const detail::PairFrame frame = detail::PairFrame::withFacets(*pair.a, *pair.b, pose);
  std::vector<MinimumCandidate> from_roots;
  LocalMinimaCost cost;
  start = std::chrono::steady_clock::now();
  detail::collectConeCandidates(frame, NormalSides::Outside, cutoff, from_roots, cost, none);
  const double roots_us = microsecondsSince(start);
  std::vector<MinimumCandidate> from_front;
  start = std::chrono::steady_clock::now();
  front.collect(frame, NormalSides::Outside, cutoff, from_front, none);
  const double front_us = microsecondsSince(start);
  const auto of_roots = placesOf(pair, pose, from_roots);
  const auto of_front = placesOf(pair, pose, from_front);
  sample.missed += countOnly(of_roots, of_front, 1e-9 * frame.size);
  sample.more += countOnly(of_front, of_roots, 1e-9 * frame.size);
  judge(frame, from_front, decider, first, sample);
  countEvents(from_front, first, sample);
  if (first) return;
  sample.fcl_us.push_back(fcl_us);
  sample.roots_us.push_back(roots_us);
  sample.front_us.push_back(front_us);
  sample.candidates += of_roots.size();
  const MinimaTracker::Counts& counts = front.counts();
  sample.kept += counts.kept;
  sample.live += counts.live;
  sample.expired += counts.expired;
  sample.groups += counts.groups;
  sample.features += counts.features;
  sample.anew += counts.began_anew ? 1 : 0;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  std::vector<std::string> names = allPairs();
  std::vector<int> steps{500, 5000};
  int instants = 100;
  int windows = 4;
  std::vector<std::string> files;
  std::string output;
  CLI::App app("The front of normal cones over a motion");
  app.add_option("--pairs", names, "names")->delimiter(',');
  app.add_option("--steps", steps, "instants along the motion")->delimiter(',');
  app.add_option("--instants", instants, "consecutive instants of a window");
  app.add_option("--windows", windows, "windows along the motion");
  app.add_option("--files", files, "pairs of mesh files, a colon between two")->delimiter(',');
  app.add_option("--output", output, "CSV file");
  CLI11_PARSE(app, argc, argv);
  ResultTable table(
      output,
      "pair,steps,fcl_us,roots_us,front_us,front_99_us,front_over_fcl,kept,expired,groups,features,"
      "live,seeds,events,anew,missed,more,floods_us,judge_us,judge_99_us,niches,by_path,aimed,"
      "by_border,mended,floods,cells,measured,other");
  if (!files.empty()) names = files;
  for (const std::string& name : names) {
    const BenchmarkPair pair = files.empty() ? loadBenchmarkPair(name) : makeCirclingPair(name);
    for (const int count : steps) {
      Sample sample;
      for (int window = 0; window < windows; ++window) {
        MinimaTracker front;
        NicheDecider decider;
        const int begin = (count - instants) * (2 * window + 1) / (2 * windows);
        for (int i = 0; i < instants; ++i) {
          observe(pair, pair.motion(static_cast<double>(begin + i) / count), front, decider, i == 0, sample);
        }
      }
      const double n = static_cast<double>(sample.front_us.size());
      table.add(pair.name, count, median(sample.fcl_us), median(sample.roots_us), median(sample.front_us),
                percentile(sample.front_us, 0.99), median(sample.front_us) / median(sample.fcl_us),
                sample.kept / n, sample.expired / n, sample.groups / n, sample.features / n, sample.live / n,
                static_cast<double>(sample.candidates) / n, static_cast<double>(sample.events) / n,
                sample.anew, sample.missed, sample.more, median(sample.floods_us), median(sample.judge_us),
                percentile(sample.judge_us, 0.99), sample.niches / n, sample.by_path / n, sample.aimed / n,
                sample.by_border / n, sample.mended / n, sample.floods / n, sample.cells / n,
                sample.measured / n, sample.other);
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark
