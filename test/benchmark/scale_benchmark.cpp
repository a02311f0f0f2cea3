// How costs grow with the size of the meshes: two bumpy rings of 1k, 10k, 100k and 1M triangles each, one
// passing close by the other.
//
//   scale_benchmark [--sizes 1000,10000,100000,1000000] [--steps 200] [--output doc/results/scale.csv]
//
// A row is a size: triangles of each body; seconds to make both bodies ready, with all threads and with
// one; median microseconds of the proven distance cold, seeded and with a front, of FCL's plain distance, and
// of a warm cycle with all niches at level `certified` (seeded and front along 200 steps of a tenth of a
// diameter in all); the greatest memory the process has used so far, megabytes.
#include <sys/resource.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <chrono>

#include "base/run_together.h"
#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/fcl_distance.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/shapes.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/bound/certificate.h"

namespace concave_distance::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

double peakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

template <typename Query>
double medianMicroseconds(int steps, Query query) {
  std::vector<double> taken;
  for (int k = 0; k < steps; ++k) {
    const Eigen::Isometry3d pose = ringPassingBy(static_cast<double>(k) / steps);
    const Clock::time_point start = Clock::now();
    query(pose, k);
    taken.push_back(microsecondsSince(start));
  }
  return median(taken);
}

using Body = std::shared_ptr<const BodyMesh>;

/// Seconds.
double buildBoth(const SurfaceMesh& surface, const BodyMeshOptions& options, Body& a, Body& b) {
  const Clock::time_point start = Clock::now();
  runTogether({[&] { a = std::make_shared<const BodyMesh>("a", surface, options); },
               [&] { b = std::make_shared<const BodyMesh>("b", surface, options); }});
  return 1e-6 * microsecondsSince(start);
}

struct BuildTimes {
  double parallel;
  double serial;
};

BuildTimes timeBuilds(const SurfaceMesh& surface) {
  BuildTimes times{};
  const auto time_one = [&](const BodyMeshOptions& options) {
    Body a;
    Body b;
    return buildBoth(surface, options, a, b);
  };
  {
    const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
    times.serial = time_one({});
  }
  times.parallel = time_one({});
  return times;
}

void run(std::size_t size, int steps, ResultTable& table) {
  const SurfaceMesh surface = makeBumpyRing(size);
  const BuildTimes build = timeBuilds(surface);
  Body a;
  Body b;
  buildBoth(surface, BodyMeshOptions(), a, b);

  CertificateWorkspace workspace;
  TrianglePair closest{};
  const auto prove = [&](const Eigen::Isometry3d& pose, std::size_t seeds, BoundCache* front) {
    const DistanceCertificate found =
        certifyDistance(*a, *b, pose, &closest, seeds, CertificateRequest(), workspace, front);
    closest = {found.witness.triangle_a, found.witness.triangle_b};
  };
  const double cold = medianMicroseconds(steps, [&](const auto& pose, int) { prove(pose, 0, nullptr); });
  const double seeded =
      medianMicroseconds(steps, [&](const auto& pose, int k) { prove(pose, k > 0 ? 1 : 0, nullptr); });
  BoundCache front;
  const double kept =
      medianMicroseconds(steps, [&](const auto& pose, int k) { prove(pose, k > 0 ? 1 : 0, &front); });
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Certified;
  PairTracker tracker("rings", a, b, parameters);
  PairSolution solution;
  const double tracked =
      medianMicroseconds(steps, [&](const auto& pose, int k) { tracker.update(pose, 0.01 * k, solution); });
  const double peak = peakMegabytes();
  const std::shared_ptr<FclModel> fcl_model = makeFclModel(surface);
  const double fcl = medianMicroseconds(
      steps, [&](const auto& pose, int) { (void)fclDistance(*fcl_model, *fcl_model, pose); });

  table.add(surface.triangleCount(), build.parallel, fcl, cold, seeded, kept, tracked, peak, build.serial);
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("How costs grow with the number of triangles");
  std::vector<std::size_t> sizes = {1000, 10000, 100000, 1000000};
  int steps = 200;
  std::string output;
  app.add_option("--sizes", sizes, "Triangles of each body")
      ->delimiter(',')
      ->check(CLI::Range(100, 10000000));
  app.add_option("--steps", steps, "Instants along the motion")->check(CLI::PositiveNumber);
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);
  ResultTable table(output,
                    "triangles,build_s,fcl_us,cold_us,seeded_us,front_us,"
                    "tracked_us,peak_mb,build_serial_s");
  for (const std::size_t size : sizes) run(size, steps, table);
  return 0;
}

}  // namespace concave_distance::benchmark
