#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

#include "convex_distance.h"
#include "convex_piece.h"

namespace concave_distance {

enum class PieceSolver : std::uint8_t {
  QuadraticProgram,  ///< Carretero, eq. (6.4)
  Gjk                ///< Gilbert, Johnson and Keerthi 1988, FCL's
};

struct PartitionTrackerOptions {
  PieceSolver solver = PieceSolver::QuadraticProgram;
  /// Every sub-pair begins with its own solution of the last pose (Carretero, sec. 6.2.1), else with the
  /// pieces' centres.
  bool warm_start = true;
  /// Leave out sub-pairs that their spheres, or their shadows along the line of their last solution, show to
  /// be farther apart than the best. Carretero solves all.
  bool cull = false;
};

/// A piece of A and a piece of B, by their place in their partitions.
struct SubPair {
  std::uint32_t a;
  std::uint32_t b;
};

/// What a solve of two partitioned bodies has found and cost. Metres, seconds.
struct PartitionSolution {
  /// 0 when the bodies meet.
  double distance = std::numeric_limits<double>::quiet_NaN();
  double lower_bound = std::numeric_limits<double>::quiet_NaN();  ///< of the sub-pairs looked at
  Eigen::Vector3d point_a_in_a = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d point_b_in_a = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  SubPair sub_pair{0, 0};
  std::uint32_t sub_pairs = 0;   ///< solved
  std::uint32_t finished = 0;    ///< of these, those whose solver was not good enough (judgeProposal)
  std::uint32_t unproven = 0;    ///< of these, those that stayed farther from their bound than the tolerance
  std::uint64_t iterations = 0;  ///< of the quadratic programs
  std::uint32_t most_iterations = 0;  ///< of one
  /// By the thesis's totals, see kFlopsPerIteration; 0 for GJK, which counts no iterations.
  double flops = 0.0;
  double seconds = 0.0;
};

// GCC 9 has no constants that -frounding-math rounds.
/// Carretero (sec. 6.3.3) gives totals and no rule: 309.1 Mflop for 200 x 126 solves of 5.52 iterations each.
inline const double kFlopsPerIteration = 309.1e6 / (200.0 * 126.0 * 5.52);

/// Two partitioned bodies along a motion: the distance is the least of all sub-pairs' (Carretero, sec.
/// 6.1.3), each warm-started by its own previous solution. Not thread-safe; a sub-pair's solver is made when
/// it is first needed.
class PartitionTracker {
 public:
  /// @throws Error when a partition has no piece
  PartitionTracker(std::shared_ptr<const ConvexPartition> a, std::shared_ptr<const ConvexPartition> b,
                   const PartitionTrackerOptions& options);
  ~PartitionTracker();
  PartitionTracker(PartitionTracker&&) noexcept;
  PartitionTracker& operator=(PartitionTracker&&) noexcept;

  /// Every sub-pair. @param a_from_b rigid. Never throws.
  PartitionSolution update(const Eigen::Isometry3d& a_from_b);

  /// One sub-pair, added to `solution` if it is nearer; its solution is remembered.
  PieceDistance solve(const Eigen::Isometry3d& a_from_b, SubPair pair, PartitionSolution& solution);

  /// Whether a sub-pair is certainly no nearer than `distance`: its spheres say so, or its shadows along the
  /// line of its last solution (of its centres before the first). What `cull` leaves out. O(corners).
  bool isFarther(const Eigen::Isometry3d& a_from_b, SubPair pair, double distance) const;

  /// Forgets all solutions: the next solves are cold.
  void reset();

  const ConvexPartition& partitionA() const;
  const ConvexPartition& partitionB() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace concave_distance
