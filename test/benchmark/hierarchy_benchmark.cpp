// Bounding volumes and widths compared: the same plain proof of the distance (support/volume_tree.h) over the
// same triangle trees with other volumes around their nodes, cold, at the same random poses; and the proof
// that is shipped. All in double precision, one thread.
//
//   hierarchy_benchmark [--pairs name,name,...] [--poses 100] [--output doc/results/hierarchy.csv]
//
// `frame`: boxes along the body frame's axes, all turned alike (AABB); `principal`: oriented boxes along the
// principal axes of what they hold; `fitted`: the shipped choice of axes; `sphere`; `swept`: a rectangle
// swept by a sphere (RSS), FCL's. A row is a pair, a volume and a width (children of a node): median
// microseconds, mean number of volumes bounded, pairs of leaves (four triangles each), triangle distances,
// and the answers that differ from the shipped one's by more than the error of a proof. The last rows are
// geometric means over the pairs, relative to `fitted` with width 4.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "benchmark/support/volume_tree.h"

namespace concave_distance::benchmark {
namespace {

struct Row {
  double us = 0.0;
  double bounds = 0.0;
  double leaves = 0.0;
  double triangles = 0.0;
  int different = 0;
};

using Poses = std::vector<Eigen::Isometry3d>;

/// @param answer distance at a pose; @param cost of the last answer
template <typename Answer, typename Cost>
Row measure(const Poses& poses, const std::vector<double>& expected, const std::vector<double>& errors,
            const Answer& answer, const Cost& cost) {
  Row row;
  std::vector<double> us;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const auto start = std::chrono::steady_clock::now();
    const double distance = answer(poses[k]);
    us.push_back(microsecondsSince(start));
    row.bounds += cost().box_bounds;
    row.leaves += cost().leaf_pairs;
    row.triangles += cost().triangle_pairs;
    row.different += std::abs(distance - expected[k]) > errors[k] ? 1 : 0;
  }
  const auto count = static_cast<double>(poses.size());
  row.us = median(us);
  row.bounds /= count;
  row.leaves /= count;
  row.triangles /= count;
  return row;
}

class Table {
 public:
  explicit Table(const std::string& path) {
    if (path.empty()) return;
    csv_.open(path);
    csv_ << "pair,volume,width,us,volume_bounds,leaf_pairs,triangle_pairs,different\n";
  }
  void add(const std::string& pair, const std::string& volume, int width, const Row& row) {
    print(pair, volume, width, row);
    if (csv_) {
      csv_ << pair << ',' << volume << ',' << width << ',' << row.us << ',' << row.bounds << ',' << row.leaves
           << ',' << row.triangles << ',' << row.different << '\n';
    }
    rows_[{volume, width}].push_back(row);
  }
  void printMeans() const {
    const std::vector<Row>& reference = rows_.at({"fitted", 4});
    for (const auto& [key, rows] : rows_) {
      Row sum;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        sum.us += std::log(rows[i].us / reference[i].us);
        // One more of each: a proof may need none.
        sum.bounds += std::log((rows[i].bounds + 1.0) / (reference[i].bounds + 1.0));
        sum.leaves += std::log((rows[i].leaves + 1.0) / (reference[i].leaves + 1.0));
        sum.triangles += std::log((rows[i].triangles + 1.0) / (reference[i].triangles + 1.0));
        sum.different += rows[i].different;
      }
      const auto count = static_cast<double>(rows.size());
      for (double* value : {&sum.us, &sum.bounds, &sum.leaves, &sum.triangles}) {
        *value = std::exp(*value / count);
      }
      std::printf("%-18s %-9s %5d %10.2f %10.2f %9.2f %9.2f %5d\n", "geometric mean", key.first.c_str(),
                  key.second, sum.us, sum.bounds, sum.leaves, sum.triangles, sum.different);
    }
  }

 private:
  static void print(const std::string& pair, const std::string& volume, int width, const Row& row) {
    std::printf("%-18s %-9s %5d %10.1f %10.0f %9.1f %9.1f %5d\n", pair.c_str(), volume.c_str(), width, row.us,
                row.bounds, row.leaves, row.triangles, row.different);
    std::fflush(stdout);
  }
  std::ofstream csv_;
  std::map<std::pair<std::string, int>, std::vector<Row>> rows_;
};

template <typename Volume, int W>
void addPlain(const BenchmarkPair& pair, const char* volume, const Poses& poses,
              const std::vector<double>& expected, const std::vector<double>& errors, Table& table) {
  PlainProof<Volume, W> proof(*pair.a, *pair.b);
  table.add(pair.name, volume, W,
            measure(
                poses, expected, errors, [&](const Eigen::Isometry3d& pose) { return proof.run(pose); },
                [&]() -> const CertificateCost& { return proof.cost(); }));
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Bounding volumes and widths compared");
  std::vector<std::string> names = allPairs();
  std::size_t count = 100;
  std::string output;
  app.add_option("--pairs", names, "Pairs to run; all when left out")->delimiter(',');
  app.add_option("--poses", count, "Random poses of each pair");
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  Table table(output);
  std::printf("%-18s %-9s %5s %10s %10s %9s %9s %5s\n", "pair", "volume", "width", "us", "bounds", "leaves",
              "tri", "diff");
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    const Poses poses = randomPoses(pair, count, 1);
    CertificateWorkspace workspace;
    DistanceCertificate shipped;
    const auto certify = [&](const Eigen::Isometry3d& pose) {
      shipped = certifyDistance(*pair.a, *pair.b, pose, nullptr, 0, CertificateRequest(), workspace);
      return shipped.distance;
    };
    std::vector<double> expected;
    std::vector<double> errors;
    for (const Eigen::Isometry3d& pose : poses) {
      expected.push_back(certify(pose));
      errors.push_back(kProofError * proofScale(*pair.a, *pair.b, pose));
    }
    using Frame = BoxVolume<detail::BoxAxes::Frame>;
    using Principal = BoxVolume<detail::BoxAxes::Principal>;
    using Fitted = BoxVolume<detail::BoxAxes::Fitted>;
    addPlain<Frame, 2>(pair, "frame", poses, expected, errors, table);
    addPlain<Frame, 4>(pair, "frame", poses, expected, errors, table);
    addPlain<Frame, 8>(pair, "frame", poses, expected, errors, table);
    addPlain<Principal, 4>(pair, "principal", poses, expected, errors, table);
    addPlain<Fitted, 2>(pair, "fitted", poses, expected, errors, table);
    addPlain<Fitted, 4>(pair, "fitted", poses, expected, errors, table);
    addPlain<Fitted, 8>(pair, "fitted", poses, expected, errors, table);
    addPlain<SphereVolume, 4>(pair, "sphere", poses, expected, errors, table);
    addPlain<SweptRectangleVolume, 2>(pair, "swept", poses, expected, errors, table);
    addPlain<SweptRectangleVolume, 4>(pair, "swept", poses, expected, errors, table);
    table.add(name, "shipped", 4, measure(poses, expected, errors, certify, [&]() -> const CertificateCost& {
                return shipped.cost;
              }));
  }
  table.printMeans();
  return 0;
}

}  // namespace concave_distance::benchmark
