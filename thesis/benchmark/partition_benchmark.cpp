// The dynamic comparison of Carretero, ch. 6: the battery follows its manoeuvre into the fixture (20 s at 10
// Hz, 200 solves) by convex partition with quadratic programming (6.4)-(6.6), cold and warm, by GJK on the
// same pieces, by the hybrid of the conclusions, by the thesis's search and by this package's tracker; and
// the number of sub-pairs from which the search is cheaper than the partition, by batteries with more hole
// facets and fixtures with more protrusions.
//
//   partition_benchmark [--family FOLDER --hole-facets 6,12,20,40 --protrusions 1,4,8,16,32] [--repeats 2]
//                       [--output doc/results/partition.csv] [--curves-output doc/results/manoeuvre.csv]
//
// FOLDER is what scripts/generate_geometry.py partition wrote. A row is a method on a pair: hole facets and
// protrusions; sub-pairs of the partition; mean and largest error against the certified distance, metres;
// microseconds of processor time a step (mean, median, the first step's; the fastest of the repeats at every
// step); of the quadratic programs, the mean iterations of one at the first step and at the others, and the
// most that one took; sub-pairs solved a step; sub-pairs a step whose solver was not good enough; Mflop a
// step by the thesis's rules (26 a node pair, 2221 a QP iteration). The curves' file has six of the methods
// instant by instant: seconds, metres, microseconds; the thesis's figures 6.6 and 6.7.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/statistics.h"
#include "concave_distance/base/error.h"
#include "distance/bound/certificate.h"
#include "loading/query_poses.h"
#include "thesis/benchmark/support/manoeuvre_curves.h"
#include "thesis/benchmark/support/manoeuvre_methods.h"
#include "thesis/src/partition/convex_partition.h"
#include "thesis/test/support/read_pieces.h"

namespace concave_distance::benchmark {
namespace {

/// The thesis's grid (sec. 6.3.1), metres.
constexpr double kGrid = 0.05;

struct Row {
  std::string method;
  std::string partition;
  std::size_t sub_pairs_in_all = 0;
  std::vector<double> errors;
  std::vector<double> times_us;  ///< of every step, the fastest repeat
  double first_iterations = 0.0;
  double later_iterations = 0.0;
  std::size_t most_iterations = 0;
  double sub_pairs = 0.0;
  double finished = 0.0;
  double flops = 0.0;
};

std::vector<double> certifiedDistances(const PartitionedPair& pair, const std::vector<TimedPose>& poses) {
  std::vector<double> distances;
  CertificateWorkspace workspace;
  for (const TimedPose& pose : poses) {
    const DistanceCertificate proof = certifyDistance(*pair.a, *pair.b, pose.pose, nullptr, 0, {}, workspace);
    if (proof.status != CertificateStatus::Proven) {
      throw Error(pair.name, "the manoeuvre is not collision free", "generate fewer protrusions");
    }
    distances.push_back(proof.distance);
  }
  return distances;
}

/// Every step of a method, with the time of its fastest repeat.
std::vector<MethodStep> stepsOf(const PartitionedPair& pair, std::size_t number, bool automatic, int repeats,
                                const std::vector<TimedPose>& poses) {
  std::vector<MethodStep> steps;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const Method method = manoeuvreMethods(pair, automatic)[number];
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const MethodStep step = method.step(poses[k].pose, poses[k].time);
      if (repeat == 0) steps.push_back(step);
      steps[k].time_us = std::min(steps[k].time_us, step.time_us);
    }
  }
  return steps;
}

Row rowOf(const PartitionedPair& pair, const Method& method, const std::vector<MethodStep>& steps,
          const std::vector<double>& certified) {
  Row row;
  row.method = method.name;
  row.partition = method.partition;
  const auto count = static_cast<double>(steps.size());
  double later_pairs = 0.0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const MethodStep& step = steps[k];
    row.times_us.push_back(step.time_us);
    row.errors.push_back(std::abs(step.distance - certified[k]));
    const auto solved = static_cast<double>(step.sub_pairs);
    if (k == 0 && solved > 0.0) row.first_iterations = step.iterations / solved;
    if (k > 0) {
      row.later_iterations += step.iterations;
      later_pairs += solved;
    }
    row.most_iterations = std::max(row.most_iterations, step.most_iterations);
    row.sub_pairs += solved / count;
    row.finished += static_cast<double>(step.finished) / count;
    row.flops += step.flops / count;
  }
  if (later_pairs > 0.0) row.later_iterations /= later_pairs;
  if (row.partition == "hand") {
    row.sub_pairs_in_all = pair.hand_a->pieces.size() * pair.hand_b->pieces.size();
  } else if (row.partition == "automatic") {
    row.sub_pairs_in_all = pair.automatic_a->pieces.size() * pair.automatic_b->pieces.size();
  }
  return row;
}

void print(const Row& row, int hole_facets, int protrusions, std::ofstream& csv) {
  const double largest = percentile(row.errors, 1.0);
  std::printf("%-25s %-9s %6zu %9.2e %9.2e %9.1f %9.1f %9.1f %6.2f %6.2f %4zu %8.1f %6.2f %8.4f\n",
              row.method.c_str(), row.partition.c_str(), row.sub_pairs_in_all, mean(row.errors), largest,
              mean(row.times_us), median(row.times_us), row.times_us.front(), row.first_iterations,
              row.later_iterations, row.most_iterations, row.sub_pairs, row.finished, 1e-6 * row.flops);
  std::fflush(stdout);
  if (!csv.is_open()) return;
  csv << hole_facets << ',' << protrusions << ",\"" << row.method << "\"," << row.partition << ','
      << row.sub_pairs_in_all << ',' << mean(row.errors) << ',' << largest << ',' << mean(row.times_us) << ','
      << median(row.times_us) << ',' << row.times_us.front() << ',' << row.first_iterations << ','
      << row.later_iterations << ',' << row.most_iterations << ',' << row.sub_pairs << ',' << row.finished
      << ',' << 1e-6 * row.flops << std::endl;
}

const std::vector<std::string>& searches() {
  static const std::vector<std::string> names = {"nodes", "refined", "certified", "certified, distance only",
                                                 "hybrid: nodes + QP"};
  return names;
}

const std::vector<std::string>& partitions() {
  static const std::vector<std::string> names = {"QP, warm", "GJK", "GJK, culled"};
  return names;
}

/// One pair's mean microseconds a step of every method on the partition by hand.
struct PairTimes {
  std::size_t sub_pairs = 0;
  std::map<std::string, double> mean_us;
};

/// Where the search is cheaper than the partition: on which side of every pair's count of sub-pairs.
void printCrossing(std::vector<PairTimes> pairs) {
  std::sort(pairs.begin(), pairs.end(),
            [](const PairTimes& l, const PairTimes& r) { return l.sub_pairs < r.sub_pairs; });
  std::printf(
      "sub-pairs with the partition cheaper (up to) and with the search cheaper (from), of %zu pairs:\n",
      pairs.size());
  for (const std::string& search : searches()) {
    for (const std::string& partition : partitions()) {
      std::size_t last_cheaper_partition = 0;
      std::size_t first_cheaper_search = 0;
      for (const PairTimes& pair : pairs) {
        if (pair.mean_us.at(partition) < pair.mean_us.at(search)) {
          last_cheaper_partition = pair.sub_pairs;
        } else if (first_cheaper_search == 0) {
          first_cheaper_search = pair.sub_pairs;
        }
      }
      std::printf("  %-25s against %-12s %6zu %6zu\n", search.c_str(), partition.c_str(),
                  last_cheaper_partition, first_cheaper_search);
    }
  }
}

PartitionedPair loadPair(const std::string& folder, const std::string& fixture, const std::string& battery) {
  PartitionedPair pair;
  pair.name = fixture + "/" + battery;
  pair.a = loadBody(folder, fixture, kGrid);
  pair.b = loadBody(folder, battery, kGrid);
  const auto pieces = [&folder](const std::string& name) {
    return std::make_shared<const ConvexPartition>(test::readPieces(folder + "/" + name + "_pieces.obj"));
  };
  pair.hand_a = pieces(fixture);
  pair.hand_b = pieces(battery);
  return pair;
}

void partitionAutomatically(PartitionedPair& pair) {
  const auto partition = [](const BodyMesh& body) {
    PartitionedBody parts = partitionMesh(body.surface(), body.name());
    std::printf("%s: %zu pieces, %zu reflex edges, %.3f s\n", body.name().c_str(),
                parts.partition.pieces.size(), parts.report.reflex_edges, parts.report.seconds);
    return std::make_shared<const ConvexPartition>(std::move(parts.partition));
  };
  pair.automatic_a = partition(*pair.a);
  pair.automatic_b = partition(*pair.b);
}

PairTimes runPair(PartitionedPair& pair, int hole_facets, int protrusions, bool automatic, int repeats,
                  std::ofstream& csv, ManoeuvreCurves* curves) {
  const std::vector<TimedPose> poses =
      readPosePath(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/meshes/thesis/manoeuvre_200.csv");
  std::printf("%s: %d hole facets, %d protrusions; %zu x %zu pieces by hand\n", pair.name.c_str(),
              hole_facets, protrusions, pair.hand_b->pieces.size(), pair.hand_a->pieces.size());
  if (automatic) partitionAutomatically(pair);
  std::printf("%-25s %-9s %6s %9s %9s %9s %9s %9s %6s %6s %4s %8s %6s %8s\n", "method", "partition", "pairs",
              "error", "largest", "us", "median", "first us", "it. 1", "iter.", "most", "solved", "fin.",
              "Mflop");
  const std::vector<double> certified = certifiedDistances(pair, poses);
  const std::vector<double> best_nodes =
      curves != nullptr ? bestNodeDistances(pair, poses) : std::vector<double>();
  const std::vector<Method> methods = manoeuvreMethods(pair, automatic);
  PairTimes times;
  times.sub_pairs = pair.hand_a->pieces.size() * pair.hand_b->pieces.size();
  for (std::size_t k = 0; k < methods.size(); ++k) {
    const std::vector<MethodStep> steps = stepsOf(pair, k, automatic, repeats, poses);
    if (curves != nullptr) curves->add(methods[k], poses, steps, certified, best_nodes);
    const Row row = rowOf(pair, methods[k], steps, certified);
    print(row, hole_facets, protrusions, csv);
    if (row.partition != "automatic") times.mean_us[row.method] = mean(row.times_us);
  }
  return times;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Convex partition and the search along the insertion of the battery");
  std::string family;
  std::vector<int> hole_facets = {6, 12, 20, 40};
  std::vector<int> protrusions = {1, 4, 8, 16, 32};
  int repeats = 2;
  std::string output;
  std::string curves_output;
  app.add_option("--family", family, "Folder with batteries and fixtures of more pieces");
  app.add_option("--hole-facets", hole_facets, "Batteries of the family")->delimiter(',');
  app.add_option("--protrusions", protrusions, "Fixtures of the family")->delimiter(',');
  app.add_option("--repeats", repeats, "Runs of each; the fastest counts")->check(CLI::PositiveNumber);
  app.add_option("--output", output, "CSV file to write");
  app.add_option("--curves-output", curves_output, "CSV file to write the thesis's pair to, step by step");
  CLI11_PARSE(app, argc, argv);

  std::ofstream csv;
  if (!output.empty()) {
    csv.open(output);
    csv << "hole_facets,protrusions,method,partition,sub_pairs,mean_error,largest_error,mean_us,median_us,"
           "first_us,"
           "first_iterations,later_iterations,most_iterations,solved,finished,mflop\n";
  }
  PartitionedPair thesis =
      loadPair(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/meshes/thesis", "fixture", "battery");
  std::optional<ManoeuvreCurves> curves;
  if (!curves_output.empty()) curves.emplace(curves_output);
  std::vector<PairTimes> times = {runPair(thesis, 6, 8, true, repeats, csv, curves ? &*curves : nullptr)};
  if (family.empty()) return 0;
  for (const int facets : hole_facets) {
    for (const int count : protrusions) {
      PartitionedPair pair =
          loadPair(family, "fixture_" + std::to_string(count), "battery_" + std::to_string(facets));
      times.push_back(runPair(pair, facets, count, false, repeats, csv, nullptr));
    }
  }
  printCrossing(std::move(times));
  return 0;
}

}  // namespace concave_distance::benchmark
