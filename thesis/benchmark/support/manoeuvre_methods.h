#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "thesis/src/partition/convex_piece.h"

namespace concave_distance::benchmark {

/// What one method says at one instant of a motion, and what that cost. Metres, microseconds of
/// processor time.
struct MethodStep {
  double distance = 0.0;
  double time_us = 0.0;
  double flops =
      0.0;  ///< by the thesis's rules: 26 a node pair, kFlopsPerIteration a QP iteration; 0: no rule
  std::size_t sub_pairs = 0;        ///< solved
  double iterations = 0.0;          ///< of the quadratic programs, together
  std::size_t most_iterations = 0;  ///< of one
  std::size_t finished = 0;         ///< sub-pairs whose solver was not good enough
  std::size_t niches = 0;           ///< reported
};

/// Two bodies as every method needs them.
struct PartitionedPair {
  std::string name;
  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
  std::shared_ptr<const ConvexPartition> hand_a;  ///< cut by hand
  std::shared_ptr<const ConvexPartition> hand_b;
  std::shared_ptr<const ConvexPartition> automatic_a;  ///< partitionMesh; may be missing
  std::shared_ptr<const ConvexPartition> automatic_b;
};

/// A method that follows a motion; state from one instant to the next is its own.
struct Method {
  std::string name;
  std::string partition;  ///< hand, automatic or none
  std::function<MethodStep(const Eigen::Isometry3d& a_from_b, double time)> step;
};

/// Convex partition with QP and with GJK, all sub-pairs and culled, the hybrid, the thesis's search with
/// its Table 6.1, and this package's tracker at `nodes` (with that search, too), `refined` and `certified`.
/// On the automatic partition, too, where there is one. @param cold also QP without warm starts
std::vector<Method> manoeuvreMethods(const PartitionedPair& pair, bool cold);

/// FOLDER/NAME.stl on a grid of `max_edge_length`, metres. @throws Error when the file is missing
std::shared_ptr<const BodyMesh> loadBody(const std::string& folder, const std::string& name,
                                         double max_edge_length);

}  // namespace concave_distance::benchmark
