// Random scenes against FCL and brute force, for as long as it is told to: a nightly program, not a test.
//   differential [--seconds 3600] [--first SEED] [--count N] [--folder findings] [--stop-at-fcl]
// Every scene has a seed of its own. Brute force in 100 digits (exact_query.h) is the arbiter. The program
// stops with exit status 1 at the first answer of this package that is wrong: the certified distance or the
// brute force in double precision off by more than the stated bound, a lower bound above the truth, a niche
// closer than the truth. It writes the scene as files that distance_query replays. FCL's wrong answers (off
// by more than 1e-6 of the size) are counted and the first one is written, too. `missed` counts cold refined
// searches that found no pair as close as the truth, which no level but certified promises.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <exception>
#include <iostream>
#include <sstream>

#include "benchmark/support/fcl_distance.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/bound/certificate.h"
#include "fuzz/reproducer.h"
#include "support/body_pairs.h"
#include "support/enumeration.h"
#include "support/exact_query.h"
#include "support/query_bound.h"

namespace {

using namespace concave_distance;

/// FCL's own kernel is good for about 1e-7; what it is held to here.
constexpr double kFclTolerance = 1e-6;

struct Options {
  double seconds = 60.0;
  std::uint64_t first = 1;
  std::uint64_t count = ~std::uint64_t{0};
  std::string folder = "findings";
  bool stop_at_fcl = false;
};

struct Counts {
  std::uint64_t scenes = 0;
  std::uint64_t apart = 0;
  std::uint64_t fcl_wrong = 0;
  std::uint64_t missed = 0;
  double worst = 0.0;  ///< error of the certified distance, in stated bounds
};

double errorOf(double distance, const test::Wide& truth) {
  return static_cast<double>(boost::multiprecision::abs(truth - test::Wide(distance)));
}

/// What is wrong with this package's answers; empty when nothing is.
std::string complaint(const test::DifferentialScene& scene, const test::Wide& truth, double bound,
                      std::uint64_t seed, Counts& counts) {
  const auto a = test::makeBody(scene.a, 0.25 * scene.a.diameter());
  const auto b = test::makeBody(scene.b, 0.25 * scene.b.diameter());
  const Eigen::Isometry3d pose = scene.b_in_a.isometry();
  std::ostringstream wrong;
  wrong.precision(17);
  CertificateWorkspace workspace;
  const DistanceCertificate proof =
      certifyDistance(*a, *b, pose, nullptr, 0, CertificateRequest(), workspace);
  counts.worst = std::max(counts.worst, errorOf(proof.distance, truth) / bound);
  if (!(errorOf(proof.distance, truth) <= bound)) wrong << "certified: " << proof.distance << '\n';
  if (!(test::Wide(proof.lower_bound) <= truth)) wrong << "lower bound: " << proof.lower_bound << '\n';
  const double brute = std::sqrt(test::enumerateTrianglePairs(*a, *b, pose).squared_distance);
  if (!(errorOf(brute, truth) <= bound)) wrong << "brute force: " << brute << '\n';
  TrackerParameters parameters;
  parameters.seed = seed;
  parameters.keep_through_material = true;  // where a body is swallowed, too, the distance of the surfaces
  const PairSolution refined = solveOnce("differential", a, b, parameters, pose);
  const double surfaces =
      std::isfinite(refined.surface_distance) ? refined.surface_distance : refined.distance;
  if (!(test::Wide(surfaces) >= truth - test::Wide(bound))) wrong << "refined: " << surfaces << '\n';
  counts.missed += test::Wide(surfaces) > truth + test::Wide(bound) ? 1 : 0;
  return wrong.str();
}

std::string fclComplaint(const test::DifferentialScene& scene, const test::Wide& truth) {
  const auto a = benchmark::makeFclModel(scene.a);
  const auto b = benchmark::makeFclModel(scene.b);
  const double distance = std::max(0.0, benchmark::fclDistance(*a, *b, scene.b_in_a.isometry()).distance);
  const double size = scene.a.diameter() + scene.b.diameter();
  if (errorOf(distance, truth) <= kFclTolerance * size) return {};
  std::ostringstream wrong;
  wrong.precision(17);
  wrong << "FCL: " << distance << '\n';
  return wrong.str();
}

void report(const Counts& counts, std::uint64_t seed) {
  std::cout << "scenes " << counts.scenes << " (apart " << counts.apart << "), seed " << seed
            << ", worst error " << counts.worst << " of the bound, missed " << counts.missed << ", FCL wrong "
            << counts.fcl_wrong << std::endl;
}

int run(const Options& options) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point t) {
    return std::chrono::duration<double>(Clock::now() - t).count();
  };
  const Clock::time_point start = Clock::now();
  Clock::time_point last_report = start;
  Counts counts;
  std::uint64_t seed = options.first;
  for (; counts.scenes < options.count && since(start) < options.seconds; ++seed) {
    RandomEngine engine(streamSeed(seed, "differential", 0));
    const test::DifferentialScene scene = test::drawScene(engine);
    const test::Wide truth = test::exactSurfaceDistance(scene.a, scene.b, scene.b_in_a);
    const double bound =
        test::queryBound(scene.a, scene.b, scene.b_in_a.translation, static_cast<double>(truth));
    ++counts.scenes;
    counts.apart += truth > 0 ? 1 : 0;
    std::ostringstream facts;
    facts.precision(17);
    facts << "seed " << seed << ", true distance " << static_cast<double>(truth) << ", bound " << bound
          << '\n';
    const std::string ours = complaint(scene, truth, bound, seed, counts);
    if (!ours.empty()) {
      std::cout << "WRONG ANSWER OF THIS PACKAGE\n" << facts.str() << ours;
      std::cout << "replay: " << test::writeReproducer(scene, seed, facts.str() + ours, options.folder)
                << std::endl;
      return 1;
    }
    const std::string fcl = fclComplaint(scene, truth);
    if (!fcl.empty() && (counts.fcl_wrong++ == 0 || options.stop_at_fcl)) {
      std::cout << "wrong answer of FCL\n" << facts.str() << fcl;
      std::cout << "replay: " << test::writeReproducer(scene, seed, facts.str() + fcl, options.folder)
                << std::endl;
      if (options.stop_at_fcl) return 1;
    }
    if (since(last_report) > 10.0) {
      report(counts, seed);
      last_report = Clock::now();
    }
  }
  report(counts, seed);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    CLI::App app("Random scenes against FCL and brute force in 100 digits.", "differential");
    app.add_option("--seconds", options.seconds, "how long")->capture_default_str();
    app.add_option("--first", options.first, "seed of the first scene")->capture_default_str();
    app.add_option("--count", options.count, "scenes at the most");
    app.add_option("--folder", options.folder, "where reproducers are written")->capture_default_str();
    app.add_flag("--stop-at-fcl", options.stop_at_fcl, "stop at a wrong answer of FCL, too");
    CLI11_PARSE(app, argc, argv);
    return run(options);
  } catch (const std::exception& error) {
    std::cerr << "differential: " << error.what() << '\n';
    return 2;
  }
}
