// The proven distance beside FCL's, on the same meshes and poses, in one run and one thread: cold (no seed,
// at random poses) and tracked (seeded with the last instant's closest triangles, along the pair's motion).
//
//   certificate_benchmark [--pairs name,name,...] [--poses 200] [--steps 500] [--output
//   doc/results/certificate.csv]
//
// A row is a pair: median microseconds of FCL's plain distance, of FCL seeded with the distance of the last
// instant's closest triangles, of ours; FCL / ours (median over instants, and at the slower of ours: 99th
// percentile over 99th percentile); box bounds and triangle distances of ours; instants where ours and FCL's
// differ by more than 1e-9 of the bodies' size.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/statistics.h"
#include "concave_distance/base/error.h"
#include "concave_distance/distance/certificate.h"

namespace concave_distance::benchmark {
namespace {

double microseconds(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

constexpr int kPasses = 3;  // the fastest of so many counts

struct Series {
  std::vector<double> fcl_us;
  std::vector<double> seeded_fcl_us;
  std::vector<double> ours_us;
  std::vector<double> bounds;
  std::vector<double> leaves;
  std::vector<double> triangles;
  int different = 0;
  int not_proven = 0;
};

class Run {
 public:
  explicit Run(const BenchmarkPair& pair) : pair_(pair) {}

  void measure(const Eigen::Isometry3d& pose, bool tracked, Series& series) {
    double fcl_us = 1e300;
    double seeded_us = 1e300;
    double ours_us = 1e300;
    FclAnswer exact{};
    DistanceCertificate ours;
    const TrianglePair seed{last_.witness.triangle_a, last_.witness.triangle_b};
    const bool seeded = tracked && std::isfinite(last_.distance);
    for (int pass = 0; pass < kPasses; ++pass) {
      auto start = std::chrono::steady_clock::now();
      exact = fclDistance(*pair_.fcl_a, *pair_.fcl_b, pose);
      fcl_us = std::min(fcl_us, microseconds(start));
      if (seeded) {
        start = std::chrono::steady_clock::now();
        (void)fclDistanceSeeded(*pair_.fcl_a, *pair_.fcl_b, pose, seed.a, seed.b);
        seeded_us = std::min(seeded_us, microseconds(start));
      }
      start = std::chrono::steady_clock::now();
      ours =
          certifyDistance(*pair_.a, *pair_.b, pose, &seed, seeded ? 1 : 0, CertificateRequest(), workspace_);
      ours_us = std::min(ours_us, microseconds(start));
    }
    last_ = ours;
    series.fcl_us.push_back(fcl_us);
    if (seeded) series.seeded_fcl_us.push_back(seeded_us);
    series.ours_us.push_back(ours_us);
    series.bounds.push_back(ours.cost.box_bounds);
    series.leaves.push_back(ours.cost.leaf_pairs);
    series.triangles.push_back(ours.cost.triangle_pairs);
    const double size = std::max(pair_.a->diameter(), pair_.b->diameter());
    series.different += std::abs(ours.distance - std::max(0.0, exact.distance)) > 1e-9 * size ? 1 : 0;
    series.not_proven += ours.status == CertificateStatus::Proven ? 0 : 1;
  }

 private:
  const BenchmarkPair& pair_;
  CertificateWorkspace workspace_;
  DistanceCertificate last_;
};

void print(const char* kind, const std::string& name, const Series& s, std::ofstream& csv) {
  const double fcl = median(s.fcl_us);
  const double seeded = s.seeded_fcl_us.empty() ? 0.0 : median(s.seeded_fcl_us);
  const double ours = median(s.ours_us);
  const double tail = percentile(s.fcl_us, 0.99) / percentile(s.ours_us, 0.99);
  std::printf("%-20s %-8s %9.1f %9.1f %8.2f %8.2f %7.1f %7.1f %7.1f %8.0f %7.0f %7.0f %5d %5d\n",
              name.c_str(), kind, fcl, seeded, ours, percentile(s.ours_us, 0.99), fcl / ours, seeded / ours,
              tail, median(s.bounds), median(s.leaves), median(s.triangles), s.different, s.not_proven);
  std::fflush(stdout);
  if (csv) {
    csv << name << ',' << kind << ',' << fcl << ',' << seeded << ',' << ours << ','
        << percentile(s.ours_us, 0.99) << ',' << fcl / ours << ',' << seeded / ours << ',' << tail << ','
        << median(s.bounds) << ',' << median(s.leaves) << ',' << median(s.triangles) << ',' << s.different
        << ',' << s.not_proven << ',' << s.ours_us.size() << '\n';
  }
}

int main(int argc, char** argv) {
  CLI::App app("The proven distance beside FCL's, cold and tracked");
  std::vector<std::string> names = allPairs();
  std::size_t poses = 200;
  int steps = 500;
  std::string output;
  app.add_option("--pairs", names, "Pairs to run; all when left out")->delimiter(',');
  app.add_option("--poses", poses, "Random poses of the cold queries");
  app.add_option("--steps", steps, "Instants along each motion")->check(CLI::PositiveNumber);
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  std::ofstream csv;
  if (!output.empty()) {
    csv.open(output);
    csv << "pair,kind,fcl_us,fcl_seeded_us,certified_us,certified_p99_us,fcl_over_certified,"
           "seeded_over_certified,p99_over_p99,box_bounds,leaf_pairs,triangle_pairs,different,not_proven,"
           "queries\n";
  }
  std::printf("%-20s %-8s %9s %9s %8s %8s %7s %7s %7s %8s %7s %7s %5s %5s\n", "pair", "kind", "FCL us",
              "seeded us", "ours us", "p99 us", "FCL/", "seeded/", "p99/", "boxes", "leaves", "tri", "diff",
              "unprv");
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    Run run(pair);
    if (poses > 0) {
      Series cold;
      for (const Eigen::Isometry3d& pose : randomPoses(pair, poses, 1)) run.measure(pose, false, cold);
      print("cold", name, cold, csv);
    }
    Series tracked;
    for (int k = 0; k < steps; ++k) {
      const double t = steps > 1 ? static_cast<double>(k) / (steps - 1) : 0.0;
      run.measure(pair.motion(t), true, tracked);
    }
    print("tracked", name, tracked, csv);
  }
  return 0;
}

}  // namespace
}  // namespace concave_distance::benchmark

int main(int argc, char** argv) {
  try {
    return concave_distance::benchmark::main(argc, argv);
  } catch (const concave_distance::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
