#include "partition_tracker.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <vector>

#include "concave_distance/base/error.h"
#include "piece_solvers.h"

namespace concave_distance {
namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<GjkShape> shapesOf(const ConvexPartition& partition) {
  std::vector<GjkShape> shapes;
  for (const ConvexPiece& piece : partition.pieces) shapes.emplace_back(piece);
  return shapes;
}

void checkPieces(const ConvexPartition& partition) {
  if (partition.pieces.empty()) {
    throw Error(partition.name, "the partition has no piece",
                "partition the body, see thesis_tool partition");
  }
}

}  // namespace

struct PartitionTracker::State {
  std::shared_ptr<const ConvexPartition> a;
  std::shared_ptr<const ConvexPartition> b;
  PartitionTrackerOptions options;
  std::vector<GjkShape> shapes_a;
  std::vector<GjkShape> shapes_b;
  struct Memory {
    std::optional<QuadraticPieceSolver> solver;
    std::optional<PiecePoints> last;
  };
  std::vector<Memory> memories;  ///< row by row, a row a piece of A
  std::vector<std::uint32_t> order;

  Memory& memoryOf(SubPair pair) { return memories[pair.a * b->pieces.size() + pair.b]; }
  SubPair pairAt(std::size_t place) const {
    const std::size_t columns = b->pieces.size();
    return {static_cast<std::uint32_t>(place / columns), static_cast<std::uint32_t>(place % columns)};
  }
};

PartitionTracker::PartitionTracker(std::shared_ptr<const ConvexPartition> a,
                                   std::shared_ptr<const ConvexPartition> b,
                                   const PartitionTrackerOptions& options)
    : state_(std::make_unique<State>()) {
  checkPieces(*a);
  checkPieces(*b);
  state_->a = std::move(a);
  state_->b = std::move(b);
  state_->options = options;
  state_->memories.resize(state_->a->pieces.size() * state_->b->pieces.size());
  if (options.solver == PieceSolver::Gjk) {
    state_->shapes_a = shapesOf(*state_->a);
    state_->shapes_b = shapesOf(*state_->b);
  }
  state_->order.resize(state_->memories.size());
  for (std::size_t k = 0; k < state_->order.size(); ++k) state_->order[k] = static_cast<std::uint32_t>(k);
}

PartitionTracker::~PartitionTracker() = default;
PartitionTracker::PartitionTracker(PartitionTracker&&) noexcept = default;
PartitionTracker& PartitionTracker::operator=(PartitionTracker&&) noexcept = default;

const ConvexPartition& PartitionTracker::partitionA() const {
  return *state_->a;
}
const ConvexPartition& PartitionTracker::partitionB() const {
  return *state_->b;
}

bool PartitionTracker::isFarther(const Eigen::Isometry3d& a_from_b, SubPair pair, double distance) const {
  const ConvexPiece& piece_a = state_->a->pieces[pair.a];
  const ConvexPiece& piece_b = state_->b->pieces[pair.b];
  const Eigen::Vector3d between = a_from_b * piece_b.centre - piece_a.centre;
  const double reach = distance + piece_a.radius + piece_b.radius;
  if (between.squaredNorm() > reach * reach) return true;
  const std::optional<PiecePoints>& last = state_->memoryOf(pair).last;
  const Eigen::Vector3d direction = last ? Eigen::Vector3d(a_from_b * last->on_b - last->on_a) : between;
  const double length = direction.norm();
  return length > 0.0 && shadowGap(piece_a, piece_b, a_from_b, direction / length) > distance;
}

void PartitionTracker::reset() {
  for (State::Memory& memory : state_->memories) memory.last.reset();
}

PieceDistance PartitionTracker::solve(const Eigen::Isometry3d& a_from_b, SubPair pair,
                                      PartitionSolution& solution) {
  State& s = *state_;
  const ConvexPiece& piece_a = s.a->pieces[pair.a];
  const ConvexPiece& piece_b = s.b->pieces[pair.b];
  State::Memory& memory = s.memoryOf(pair);
  PieceProposal proposal;
  if (s.options.solver == PieceSolver::Gjk) {
    proposal = solveGjk(s.shapes_a[pair.a], s.shapes_b[pair.b], a_from_b);
  } else {
    if (!memory.solver) memory.solver.emplace(piece_a, piece_b);
    const bool warm = s.options.warm_start && memory.last.has_value();
    proposal = memory.solver->solve(a_from_b, warm ? &*memory.last : nullptr);
  }
  PieceDistance answer = judgeProposal(piece_a, piece_b, a_from_b, proposal);
  memory.last = answer.points;
  ++solution.sub_pairs;
  solution.finished += answer.finished ? 1 : 0;
  solution.unproven += answer.proven ? 0 : 1;
  solution.iterations += answer.iterations;
  solution.most_iterations = std::max(solution.most_iterations, answer.iterations);
  solution.flops += kFlopsPerIteration * answer.iterations;
  // Comparisons are written so that the first sub-pair replaces "not computed".
  if (!(solution.distance <= answer.distance)) {
    solution.distance = answer.distance;
    solution.point_a_in_a = answer.points.on_a;
    solution.point_b_in_a = a_from_b * answer.points.on_b;
    solution.sub_pair = pair;
  }
  if (!(solution.lower_bound <= answer.lower_bound)) solution.lower_bound = answer.lower_bound;
  return answer;
}

PartitionSolution PartitionTracker::update(const Eigen::Isometry3d& a_from_b) {
  const auto start = std::chrono::steady_clock::now();
  State& s = *state_;
  PartitionSolution solution;
  for (std::size_t k = 0; k < s.order.size(); ++k) {
    const SubPair pair = s.pairAt(s.order[k]);
    if (s.options.cull && k > 0 && isFarther(a_from_b, pair, solution.distance)) continue;
    const double before = solution.distance;
    solve(a_from_b, pair, solution);
    // The best of this pose is the first of the next: the others have to be nearer than it.
    if (s.options.cull && !(before <= solution.distance)) std::swap(s.order[0], s.order[k]);
  }
  solution.seconds = secondsSince(start);
  return solution;
}

}  // namespace concave_distance
