// Is the proven distance right? Random poses of every pair, half of them anywhere around each other and half
// near the pair's motion (inside holes, between teeth), against an independent hierarchy whose contenders,
// everything within 1e-10 of the scene's scale of the least, are evaluated in 100 digits.
//
//   exactness_benchmark [--pairs name,name,...] [--poses 7000] [--output doc/results/exactness.csv]
//
// A row is a pair: poses; of them penetrating; the largest |distance - truth| and the least distance between
// truth and lower bound (negative: a bound above the truth), both relative to the scene's scale; the largest
// gap between distance and lower bound; answers off by more than 1e-12 of the scale; bounds above the truth;
// poses where one of both says penetrating and the other does not. The last line sums them up; the exit code
// is 1 when any is wrong.
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <mutex>

#include "base/random_engine.h"
#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/sphere_tree.h"
#include "distance/bound/certificate.h"
#include "support/exact_query.h"

namespace concave_distance::benchmark {
namespace {

using test::ExactTriangle;
using test::ExactVector;
using test::GivenPose;
using test::Wide;

constexpr double kContenderMargin = 1e-10;
constexpr double kPrefilterMargin = 1e-7;
constexpr double kAllowedError = 1e-12;

ExactTriangle<Wide> cornersOf(const SurfaceMesh& surface, std::uint32_t triangle, const GivenPose& pose) {
  std::vector<Eigen::Vector3d> corners;
  for (int k = 0; k < 3; ++k) corners.push_back(surface.corner(TriangleIndex{triangle}, k));
  const auto moved = test::exactlyMoved(corners, pose, Eigen::Vector3d::Zero());
  return {moved[0], moved[1], moved[2]};
}

TrianglePoints pointsOf(const SurfaceMesh& surface, std::uint32_t triangle, const Eigen::Isometry3d& pose) {
  TrianglePoints points;
  for (std::size_t k = 0; k < 3; ++k) {
    points[k] = pose * surface.corner(TriangleIndex{triangle}, static_cast<int>(k));
  }
  return points;
}

ExactTriangle<long double> inLongDouble(const TrianglePoints& t) {
  const auto corner = [](const Eigen::Vector3d& p) {
    return ExactVector<long double>(static_cast<long double>(p.x()), static_cast<long double>(p.y()),
                                    static_cast<long double>(p.z()));
  };
  return {corner(t[0]), corner(t[1]), corner(t[2])};
}

/// The distance of the surfaces in 100 digits, given that it is no more than what is claimed (else infinite).
Wide truthUpTo(const DistanceCertificate& claimed, const BenchmarkPair& pair, const SphereTree& tree_a,
               const SphereTree& tree_b, const GivenPose& given, double scale) {
  const SurfaceMesh& a = pair.a->surface();
  const SurfaceMesh& b = pair.b->surface();
  const Eigen::Isometry3d pose = given.isometry();
  const double margin = kContenderMargin * scale;
  // Triangles that meet are proof enough: nothing is closer.
  if (claimed.distance == 0.0 &&
      test::exactSquaredDistance(cornersOf(a, claimed.witness.triangle_a.value, GivenPose()),
                                 cornersOf(b, claimed.witness.triangle_b.value, given)) == 0) {
    return 0;
  }
  double limit = claimed.distance + margin;
  std::vector<std::pair<long double, std::pair<std::uint32_t, std::uint32_t>>> contenders;
  SphereTree::forEachPairWithin(tree_a, tree_b, pose, limit, [&](std::uint32_t i, std::uint32_t j) {
    const TrianglePoints points_a = pointsOf(a, i, Eigen::Isometry3d::Identity());
    const TrianglePoints points_b = pointsOf(b, j, pose);
    // FCL's kernel sorts out what is far; its own error is below the margin left to it.
    if (fclTriangleDistance(points_a, points_b) > limit + kPrefilterMargin * scale) return limit;
    const long double distance =
        std::sqrt(test::exactSquaredDistance(inLongDouble(points_a), inLongDouble(points_b)));
    if (distance <= static_cast<long double>(limit)) contenders.push_back({distance, {i, j}});
    limit = std::min(limit, static_cast<double>(distance) + margin);
    return limit;
  });
  Wide squared = std::numeric_limits<double>::infinity();
  for (const auto& [distance, triangles] : contenders) {
    if (distance > static_cast<long double>(limit) || squared == 0) continue;
    squared = std::min(squared, test::exactSquaredDistance(cornersOf(a, triangles.first, GivenPose()),
                                                           cornersOf(b, triangles.second, given)));
  }
  return boost::multiprecision::sqrt(squared);
}

Eigen::Vector3d anyVector(RandomEngine& engine, double half) {
  return {half * (2.0 * uniformUnit(engine) - 1.0), half * (2.0 * uniformUnit(engine) - 1.0),
          half * (2.0 * uniformUnit(engine) - 1.0)};
}

GivenPose poseOf(const BenchmarkPair& pair, std::size_t number) {
  RandomEngine engine(streamSeed(1, pair.name, number));
  if (number % 2 == 0) {
    const Eigen::Quaterniond rotation(
        Eigen::AngleAxisd(6.3 * uniformUnit(engine), anyVector(engine, 1.0).normalized()));
    const double reach = 0.6 * uniformUnit(engine) * (pair.a->diameter() + pair.b->diameter());
    const Eigen::Vector3d centre_a = pair.a->surface().boundingBox().center();
    const Eigen::Vector3d centre_b = pair.b->surface().boundingBox().center();
    return test::givenPose(rotation,
                           centre_a + reach * anyVector(engine, 1.0).normalized() - rotation * centre_b);
  }
  const Eigen::Isometry3d on_motion = pair.motion(uniformUnit(engine));
  const double off = std::pow(10.0, -6.0 * uniformUnit(engine)) * 0.1;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(off, anyVector(engine, 1.0).normalized()));
  return test::givenPose(turn * Eigen::Quaterniond(on_motion.linear()),
                         on_motion.translation() + anyVector(engine, off * pair.a->diameter()));
}

struct Row {
  int penetrating = 0;
  double worst_error = 0.0;
  double least_margin = std::numeric_limits<double>::infinity();
  double widest_gap = 0.0;
  int wrong = 0;
  int bounds_above = 0;
  int disagreements = 0;
};

Row run(const BenchmarkPair& pair, std::size_t poses) {
  const SphereTree tree_a(pair.a->surface());
  const SphereTree tree_b(pair.b->surface());
  Row row;
  std::mutex mutex;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, poses, 16), [&](const auto& range) {
    CertificateWorkspace workspace;
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      const GivenPose given = poseOf(pair, k);
      const Eigen::Isometry3d pose = given.isometry();
      const DistanceCertificate found =
          certifyDistance(*pair.a, *pair.b, pose, nullptr, 0, CertificateRequest(), workspace);
      const double scale = proofScale(*pair.a, *pair.b, pose);
      const Wide truth = truthUpTo(found, pair, tree_a, tree_b, given, scale);
      const double error =
          static_cast<double>(boost::multiprecision::abs(Wide(found.distance) - truth)) / scale;
      const double margin = static_cast<double>(truth - Wide(found.lower_bound)) / scale;
      const std::lock_guard<std::mutex> lock(mutex);
      row.penetrating += truth == 0 ? 1 : 0;
      row.worst_error = std::max(row.worst_error, error);
      row.least_margin = std::min(row.least_margin, margin);
      row.widest_gap = std::max(row.widest_gap, (found.distance - found.lower_bound) / scale);
      row.wrong += error <= kAllowedError ? 0 : 1;
      row.bounds_above += margin >= 0.0 ? 0 : 1;
      row.disagreements += (truth == 0) == (found.status == CertificateStatus::Penetrating) ? 0 : 1;
    }
  });
  return row;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("The proven distance against an independent hierarchy and 100 digits");
  std::vector<std::string> names = allPairs();
  std::size_t poses = 7000;
  std::string output;
  app.add_option("--pairs", names, "Pairs to run; all when left out")->delimiter(',');
  app.add_option("--poses", poses, "Poses of each pair")->check(CLI::PositiveNumber);
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  ResultTable table(
      output, "pair,poses,penetrating,worst_error,least_margin,widest_gap,wrong,bounds_above,disagreements");
  Row sum;
  for (const std::string& name : names) {
    const Row row = run(loadBenchmarkPair(name), poses);
    table.add(name, poses, row.penetrating, row.worst_error, row.least_margin, row.widest_gap, row.wrong,
              row.bounds_above, row.disagreements);
    sum.worst_error = std::max(sum.worst_error, row.worst_error);
    sum.least_margin = std::min(sum.least_margin, row.least_margin);
    sum.wrong += row.wrong;
    sum.bounds_above += row.bounds_above;
    sum.disagreements += row.disagreements;
  }
  std::printf(
      "%zu poses: %d wrong, %d bounds above the truth, %d disagree on penetration; worst error %.2e\n",
      poses * names.size(), sum.wrong, sum.bounds_above, sum.disagreements, sum.worst_error);
  return sum.wrong + sum.bounds_above + sum.disagreements == 0 ? 0 : 1;
}

}  // namespace concave_distance::benchmark
