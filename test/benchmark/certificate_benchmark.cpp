// The proven distance beside FCL's, on the same meshes and poses, in one run and one thread: `cold` (no seed,
// at random poses); `near` (no seed, at instants along the pair's motion, where the bodies are close: the
// peg in its hole, the hooks in each other); `seeded` (begun with the last instant's closest triangles) and
// `front` (the same, and what the last instant's proof excluded is kept) along the pair's motion, sampled at
// several rates.
//
//   certificate_benchmark [--pairs name,name,...] [--poses 2000] [--steps 50,500,5000]
//                         [--output doc/results/certificate.csv]
//
// A row is a pair, a kind and a number of instants along the motion (5 s long: 50 is 10 Hz): median
// microseconds of FCL's plain distance, of FCL seeded with the distance of the last instant's closest
// triangles, of ours with its 99th percentile; FCL / ours (medians), seeded FCL / ours, and 99th percentile
// over 99th percentile; box bounds, leaf pairs and triangle distances of ours; the limit: triangle pairs that
// are as near as the minimum, which any proof that measures pairs one by one has to open, and their number
// times the kernel's time (medians of up to 200 of the poses); answers that differ from FCL's
// by more than 1e-9 of the bodies' size; answers without a full proof.
#include <CLI/CLI.hpp>
#include <chrono>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "benchmark/support/tied_pairs.h"
#include "distance/bound/certificate.h"

namespace concave_distance::benchmark {
namespace {

enum class Kind { Cold, Near, Seeded, Front };

bool isSeeded(Kind kind) {
  return kind == Kind::Seeded || kind == Kind::Front;
}

const char* nameOf(Kind kind) {
  switch (kind) {
    case Kind::Cold:
      return "cold";
    case Kind::Near:
      return "near";
    case Kind::Seeded:
      return "seeded";
    default:
      return "front";
  }
}

/// FCL's share of a row: measured once for both kinds along a motion.
struct Yardstick {
  std::vector<double> plain_us;
  std::vector<double> seeded_us;
  std::vector<double> distances;
};

/// Instants of a row at the most whose limit is looked at.
constexpr std::size_t kLimitPoses = 200;

/// Instants of a motion that are asked without a seed.
constexpr int kNearPoses = 500;

std::vector<Eigen::Isometry3d> posesAlong(const BenchmarkPair& pair, int count) {
  std::vector<Eigen::Isometry3d> motion;
  motion.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) motion.push_back(pair.motion(static_cast<double>(k) / (count - 1)));
  return motion;
}

struct Limit {
  std::vector<double> ties;
  std::vector<double> us;
};

Limit measureLimit(const BenchmarkPair& pair, const std::vector<Eigen::Isometry3d>& poses,
                   const Yardstick& yardstick) {
  Limit limit;
  const std::size_t stride = std::max<std::size_t>(1, poses.size() / kLimitPoses);
  for (std::size_t k = 0; k < poses.size(); k += stride) {
    if (yardstick.distances[k] <= 0.0) continue;
    CertificateWorkspace workspace;
    const double distance =
        certifyDistance(*pair.a, *pair.b, poses[k], nullptr, 0, CertificateRequest(), workspace).distance;
    const ProofLimit least = proofLimit(*pair.a, *pair.b, poses[k], distance);
    limit.ties.push_back(least.ties);
    limit.us.push_back(least.microseconds);
  }
  return limit;
}

struct Series {
  std::vector<double> us;
  std::vector<double> bounds;
  std::vector<double> leaves;
  std::vector<double> triangles;
  int different = 0;
  int not_proven = 0;
};

Series measure(const BenchmarkPair& pair, const std::vector<Eigen::Isometry3d>& poses, Kind kind,
               const Yardstick& yardstick, std::vector<TrianglePair>& closest) {
  Series series;
  CertificateWorkspace workspace;
  BoundCache front;
  const double size = std::max(pair.a->diameter(), pair.b->diameter());
  closest.clear();
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const bool seeded = isSeeded(kind) && k > 0;
    const TrianglePair seed = seeded ? closest.back() : TrianglePair{};
    const auto start = std::chrono::steady_clock::now();
    const DistanceCertificate ours =
        certifyDistance(*pair.a, *pair.b, poses[k], &seed, seeded ? 1 : 0, CertificateRequest(), workspace,
                        kind == Kind::Front ? &front : nullptr);
    const double taken = microsecondsSince(start);
    closest.push_back({ours.witness.triangle_a, ours.witness.triangle_b});
    if (isSeeded(kind) && !seeded) continue;
    series.us.push_back(taken);
    series.bounds.push_back(ours.cost.box_bounds);
    series.leaves.push_back(ours.cost.leaf_pairs);
    series.triangles.push_back(ours.cost.triangle_pairs);
    if (!yardstick.distances.empty()) {
      series.different +=
          std::abs(ours.distance - std::max(0.0, yardstick.distances[k])) > 1e-9 * size ? 1 : 0;
    }
    series.not_proven += ours.status == CertificateStatus::Proven ? 0 : 1;
  }
  return series;
}

Yardstick measureFcl(const BenchmarkPair& pair, const std::vector<Eigen::Isometry3d>& poses,
                     const std::vector<TrianglePair>& closest) {
  Yardstick yardstick;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    auto start = std::chrono::steady_clock::now();
    yardstick.distances.push_back(fclDistance(*pair.fcl_a, *pair.fcl_b, poses[k]).distance);
    yardstick.plain_us.push_back(microsecondsSince(start));
    if (k == 0 || closest.empty()) continue;
    start = std::chrono::steady_clock::now();
    (void)fclDistanceSeeded(*pair.fcl_a, *pair.fcl_b, poses[k], closest[k - 1].a, closest[k - 1].b);
    yardstick.seeded_us.push_back(microsecondsSince(start));
  }
  return yardstick;
}

void add(const std::string& name, Kind kind, const Yardstick& fcl, const Limit& limit, const Series& s,
         ResultTable& table) {
  const double plain = median(fcl.plain_us);
  const double seeded = isSeeded(kind) ? median(fcl.seeded_us) : std::nan("");
  const double ours = median(s.us);
  const double slow = percentile(s.us, 0.99);
  table.add(name, nameOf(kind), s.us.size(), plain, seeded, ours, slow, plain / ours, seeded / ours,
            percentile(fcl.plain_us, 0.99) / slow, median(s.bounds), median(s.leaves), median(s.triangles),
            median(limit.ties), median(limit.us), s.different, s.not_proven);
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("The proven distance beside FCL's, cold and tracked");
  std::vector<std::string> names = allPairs();
  std::size_t poses = 2000;
  std::vector<int> steps = {50, 500, 5000};
  std::string output;
  app.add_option("--pairs", names, "Pairs to run; all when left out")->delimiter(',');
  app.add_option("--poses", poses, "Random poses of the cold queries; 0: none");
  app.add_option("--steps", steps, "Instants along each motion")
      ->delimiter(',')
      ->check(CLI::Range(2, 1000000));
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  ResultTable table(output,
                    "pair,kind,queries,fcl_us,fcl_seeded_us,certified_us,certified_p99_us,fcl_over_certified,"
                    "fcl_seeded_over_certified,p99_over_p99,box_bounds,leaf_pairs,triangle_pairs,tied_pairs,"
                    "limit_us,different,not_proven");
  std::vector<TrianglePair> closest;
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    if (poses > 0) {
      const std::vector<Eigen::Isometry3d> random = randomPoses(pair, poses, 1);
      const Yardstick fcl = measureFcl(pair, random, {});
      add(name, Kind::Cold, fcl, measureLimit(pair, random, fcl),
          measure(pair, random, Kind::Cold, fcl, closest), table);
    }
    const std::vector<Eigen::Isometry3d> near = posesAlong(pair, kNearPoses);
    const Yardstick fcl_near = measureFcl(pair, near, {});
    add(name, Kind::Near, fcl_near, measureLimit(pair, near, fcl_near),
        measure(pair, near, Kind::Near, fcl_near, closest), table);
    for (const int count : steps) {
      const std::vector<Eigen::Isometry3d> motion = posesAlong(pair, count);
      measure(pair, motion, Kind::Seeded, {}, closest);  // for FCL's seeds
      const Yardstick fcl = measureFcl(pair, motion, closest);
      const Limit limit = measureLimit(pair, motion, fcl);
      for (const Kind kind : {Kind::Seeded, Kind::Front}) {
        add(name, kind, fcl, limit, measure(pair, motion, kind, fcl, closest), table);
      }
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark
