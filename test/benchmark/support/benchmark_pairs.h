#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmark/support/fcl_distance.h"
#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance::benchmark {

/// Two bodies and a motion of B in A's frame, collision free at every instant by FCL but for those that are
/// called overlapping.
struct BenchmarkPair {
  std::string name;
  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
  std::shared_ptr<FclModel> fcl_a;
  std::shared_ptr<FclModel> fcl_b;
  /// Pose of B in A's frame at t in [0, 1].
  std::function<Eigen::Isometry3d(double)> motion;
};

/// The names that loadBenchmarkPair knows, but for those of simplePairs().
std::vector<std::string> allPairs();
/// Pairs whose geometry calls for little: convex ones, apart and overlapping, and unions of primitives.
std::vector<std::string> simplePairs();

/// @param max_edge_length of both grids, metres; empty: automatic
/// @throws Error for an unknown name or a file that is missing
BenchmarkPair loadBenchmarkPair(const std::string& name,
                                std::optional<double> max_edge_length = std::nullopt);

/// `count` poses of B around A with random directions and rotations, FCL distance in (0, 0.5 diameter of A].
std::vector<Eigen::Isometry3d> randomPoses(const BenchmarkPair& pair, std::size_t count, std::uint64_t seed);

}  // namespace concave_distance::benchmark
