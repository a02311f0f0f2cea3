#include "concave_distance/partition/hybrid_distance.h"

#include <chrono>

#include "concave_distance/partition/pieces_at_point.h"

namespace concave_distance {

struct HybridDistance::State {
  PartitionTracker tracker;
  double reach;
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

  /// Solves what touches at two points and has not been solved yet. Whether any is nearer than `best`, whose
  /// points these are.
  bool improve(const Eigen::Isometry3d& a_from_b, PieceDistance& best, PartitionSolution& solution) {
    findPiecesAt(tracker.partitionA(), best.points.on_a, reach, at_a);
    findPiecesAt(tracker.partitionB(), best.points.on_b, reach, at_b);
    bool improved = false;
    for (const std::uint32_t a : at_a) {
      for (const std::uint32_t b : at_b) {
        if (!firstTime({a, b})) continue;
        const PieceDistance answer = tracker.solve(a_from_b, {a, b}, solution);
        if (answer.distance >= best.distance) continue;
        best = answer;
        improved = true;
      }
    }
    return improved;
  }
};

HybridDistance::HybridDistance(std::shared_ptr<const ConvexPartition> a,
                               std::shared_ptr<const ConvexPartition> b, const HybridOptions& options)
    : state_(new State{
          PartitionTracker(std::move(a), std::move(b), options.tracker), options.reach, {}, {}, {}, 0}) {
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
  solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return solution;
}

}  // namespace concave_distance
