#include "thesis/benchmark/support/accuracy_partition.h"

#include <cstdio>

#include "benchmark/support/stopwatch.h"
#include "concave_distance/base/error.h"
#include "thesis/src/partition/convex_partition.h"
#include "thesis/src/partition/partition_tracker.h"

namespace concave_distance::benchmark {
namespace {

/// More sub-pairs are not solved one by one: quadratic programs for all of them take seconds a query.
constexpr std::size_t kAllSubPairsLimit = 10000;

using Partition = std::shared_ptr<const ConvexPartition>;

Partition cut(const BodyMesh& body) {
  PartitionedBody cut = partitionMesh(body.surface(), body.name());
  std::printf("%s: %zu pieces in %.2f s\n", body.name().c_str(), cut.partition.pieces.size(),
              cut.report.seconds);
  return std::make_shared<const ConvexPartition>(std::move(cut.partition));
}

void addMethod(Rows& rows, const std::string& method, const std::string& setting, const Partition& a,
               const Partition& b, const PartitionTrackerOptions& options) {
  PartitionTracker tracker(a, b, options);
  const auto solve = [&](const Eigen::Isometry3d& pose) {
    const QueryClock clock;
    const PartitionSolution solution = tracker.update(pose);
    // What is left out of all sub-pairs is farther than the nearest, so that the bound is of all.
    return Answer{solution.distance, solution.lower_bound, clock.microseconds()};
  };
  rows.cold(method, setting, [&](const Eigen::Isometry3d& pose, double, bool) {
    tracker.reset();
    return solve(pose);
  });
  tracker.reset();
  rows.tracked(method, setting, [&](const Eigen::Isometry3d& pose, double, bool) { return solve(pose); });
}

}  // namespace

void addPartition(Rows& rows, const BenchmarkPair& pair) {
  Partition a;
  Partition b;
  try {
    // The one that is refused for its reflex edges, if any, before the other is cut in vain.
    if (countReflexEdges(pair.a->surface()) < countReflexEdges(pair.b->surface())) b = cut(*pair.b);
    a = cut(*pair.a);
    if (!b) b = cut(*pair.b);
  } catch (const Error& error) {
    std::printf("%-18s %-22s left out: %s\n", pair.name.c_str(), "partition", error.what());
    return;
  }
  const std::size_t sub_pairs = a->pieces.size() * b->pieces.size();
  const std::string all = std::to_string(sub_pairs) + " sub-pairs";
  for (const PieceSolver solver : {PieceSolver::QuadraticProgram, PieceSolver::Gjk}) {
    const std::string method = solver == PieceSolver::Gjk ? "partition GJK" : "partition QP";
    PartitionTrackerOptions options;
    options.solver = solver;
    if (sub_pairs <= kAllSubPairsLimit) {
      addMethod(rows, method, all, a, b, options);
    } else {
      std::printf("%-18s %-22s left out: all %zu sub-pairs, more than %zu\n", pair.name.c_str(),
                  method.c_str(), sub_pairs, kAllSubPairsLimit);
    }
    options.cull = true;
    addMethod(rows, method, all + " culled", a, b, options);
  }
}

}  // namespace concave_distance::benchmark
