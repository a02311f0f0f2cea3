#include "hybrid_distance.h"

#include <chrono>

#include "pieces_at_point.h"

namespace concave_distance {

struct HybridDistance::State {
  PartitionTracker tracker;
  HybridOptions options;
  std::vector<std::uint32_t> at_a;
  std::vector<std::uint32_t> at_b;
  std::vector<std::uint32_t> solved_in;  ///< of each sub-pair: the last update it was solved in
  std::uint32_t update_count = 0;

  bool firstTime(SubPair pair) {
    std::uint32_t& stamp = solved_in[pair.a * tracker.partitionB().pieces.size() + pair.b];
    if (stamp == update_count) return false;
    stamp = update_count;
    return true;
  }

  /// Whether the sub-pair has not been looked at in this update and may be nearer than all that was.
  bool isWanted(const Eigen::Isometry3d& a_from_b, SubPair pair, const PartitionSolution& solution) {
    if (!firstTime(pair)) return false;
    return !options.prove ||
           (solution.distance != 0.0 && !tracker.isFarther(a_from_b, pair, solution.distance));
  }

  /// Solves what touches at two points and is wanted. Whether any is nearer than `best`, whose points these
  /// are.
  bool improve(const Eigen::Isometry3d& a_from_b, PieceDistance& best, PartitionSolution& solution) {
    findPiecesAt(tracker.partitionA(), best.points.on_a, options.reach, at_a);
    findPiecesAt(tracker.partitionB(), best.points.on_b, options.reach, at_b);
    bool improved = false;
    for (const std::uint32_t a : at_a) {
      for (const std::uint32_t b : at_b) {
        if (!isWanted(a_from_b, {a, b}, solution)) continue;
        const PieceDistance answer = tracker.solve(a_from_b, {a, b}, solution);
        if (answer.distance >= best.distance) continue;
        best = answer;
        improved = true;
      }
    }
    return improved;
  }

  /// What no place has led to.
  void solveRest(const Eigen::Isometry3d& a_from_b, PartitionSolution& solution) {
    const auto count_a = static_cast<std::uint32_t>(tracker.partitionA().pieces.size());
    const auto count_b = static_cast<std::uint32_t>(tracker.partitionB().pieces.size());
    for (std::uint32_t a = 0; a < count_a; ++a) {
      for (std::uint32_t b = 0; b < count_b; ++b) {
        if (isWanted(a_from_b, {a, b}, solution)) tracker.solve(a_from_b, {a, b}, solution);
      }
    }
  }
};

HybridDistance::HybridDistance(std::shared_ptr<const ConvexPartition> a,
                               std::shared_ptr<const ConvexPartition> b, const HybridOptions& options)
    : state_(
          new State{PartitionTracker(std::move(a), std::move(b), options.tracker), options, {}, {}, {}, 0}) {
  state_->solved_in.resize(state_->tracker.partitionA().pieces.size() *
                           state_->tracker.partitionB().pieces.size());
}

HybridDistance::~HybridDistance() = default;
HybridDistance::HybridDistance(HybridDistance&&) noexcept = default;
HybridDistance& HybridDistance::operator=(HybridDistance&&) noexcept = default;

void HybridDistance::reset() {
  state_->tracker.reset();
}

PartitionSolution HybridDistance::update(const Eigen::Isometry3d& a_from_b,
                                         const std::vector<PlacePair>& places) {
  const auto start = std::chrono::steady_clock::now();
  PartitionSolution solution;
  ++state_->update_count;
  for (const PlacePair& place : places) {
    PieceDistance best{};
    best.points = {place.on_a, place.on_b};
    best.distance = std::numeric_limits<double>::infinity();
    while (state_->improve(a_from_b, best, solution) && best.distance > 0.0) {
    }
  }
  if (state_->options.prove) state_->solveRest(a_from_b, solution);
  solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return solution;
}

}  // namespace concave_distance
