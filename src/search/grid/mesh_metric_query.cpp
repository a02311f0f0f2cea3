#include <algorithm>

#include "base/constants.h"
#include "mesh_metric.h"

namespace concave_distance {
namespace {

constexpr std::uint32_t kNoBall = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kNoNode = std::numeric_limits<std::uint32_t>::max();
// Room for ten balls that each cover the whole mesh, smaller ones in greater number; small meshes are
// generous up to 3 MB.
constexpr std::size_t kBallEntriesPerNode = 16;
constexpr std::size_t kGenerousEntriesPerNode = 64;
constexpr std::size_t kGenerousEntries = std::size_t{1} << 18U;
constexpr std::size_t kBallSlots = 4096;
// A distance is rounded to float once: what rounds down to a bound is less than this factor above it.
constexpr double kFloatRounding = 1.0 + 0x1.0p-23;

/// A seat in [0, seats), well spread (Fibonacci hashing, then Lemire's multiplication for the remainder).
std::size_t homeSeat(std::uint32_t node, std::size_t seats) {
  const std::uint64_t hash = (node * 0x9e3779b9U) & 0xffffffffU;
  return static_cast<std::size_t>((hash * seats) >> 32U);
}

/// For the heap functions, which keep the greatest in front: smallest key first, then smallest node.
struct ComesLater {
  template <typename Open>
  bool operator()(const Open& l, const Open& r) const {
    return l.key != r.key ? l.key > r.key : r.node < l.node;
  }
};

}  // namespace

MeshMetricQuery::MeshMetricQuery(const MeshMetric& metric) : metric_(&metric) {}

void MeshMetricQuery::allocate() {
  const std::size_t nodes = metric_->graph().nodeCount();
  if (path_length_.size() == nodes) {
    return;
  }
  ball_entries_.resize(
      std::max(kBallEntriesPerNode * nodes, std::min(kGenerousEntriesPerNode * nodes, kGenerousEntries)));
  balls_.resize(std::min(kBallSlots, nodes));
  ball_of_node_.assign(nodes, kNoBall);
  path_length_.assign(nodes, kInfinity);
  predecessor_.resize(nodes);
  reached_.reserve(nodes);
  open_.reserve(nodes);
}

void MeshMetricQuery::clearSearch() {
  for (const NodeIndex node : reached_) {
    path_length_[node.value] = kInfinity;
  }
  reached_.clear();
  open_.clear();
}

void MeshMetricQuery::reach(NodeIndex node, double path_length, NodeIndex predecessor) {
  if (path_length_[node.value] == kInfinity) {
    reached_.push_back(node);
  }
  path_length_[node.value] = path_length;
  predecessor_[node.value] = predecessor;
}

/// Without a search: between shells, or when even the straight distance is too long.
bool MeshMetricQuery::cannotReach(NodeIndex from, NodeIndex to, double bound) const {
  const NodeGraph& graph = metric_->graph();
  return graph.shell[from.value] != graph.shell[to.value] ||
         (graph.positions[from.value] - graph.positions[to.value]).norm() > bound * kFloatRounding;
}

double MeshMetricQuery::distanceWithin(NodeIndex from, NodeIndex to, double bound) {
  if (from == to) {
    return bound >= 0.0 ? 0.0 : kInfinity;
  }
  if (metric_->hasMatrices()) {
    const auto distance = static_cast<double>(metric_->matrixDistance(from, to));
    return distance <= bound ? distance : kInfinity;
  }
  if (cannotReach(from, to, bound)) {
    return kInfinity;
  }
  allocate();
  const BallEntry* entry = nullptr;
  if (const Ball* ball = cachedBall(from, bound)) {
    entry = find(*ball, to);
  } else if (const Ball* ball_of_to = cachedBall(to, bound)) {
    entry = find(*ball_of_to, from);
  } else {
    entry = find(searchBall(from, bound), to);
  }
  const double distance = entry == nullptr ? kInfinity : static_cast<double>(entry->distance);
  return distance <= bound ? distance : kInfinity;
}

NodeIndex MeshMetricQuery::nodeTowards(NodeIndex from, NodeIndex to, double distance, double bound) {
  const double length = distanceWithin(from, to, bound);
  if (length == kInfinity || from == to) {
    return from;
  }
  NodeIndex node = from;
  if (metric_->hasMatrices()) {
    // Rows of `to` only: the predecessor on the way from `to` is the next node on the way there.
    while (node != to) {
      const NodeIndex next = metric_->matrixPredecessor(to, node);
      if (length - static_cast<double>(metric_->matrixDistance(to, next)) > distance) {
        break;
      }
      node = next;
    }
    return node;
  }
  if (const Ball* ball = cachedBall(from, bound)) {
    const BallEntry* entry = find(*ball, to);
    while (static_cast<double>(entry->distance) > distance) {
      entry = find(*ball, NodeIndex{entry->predecessor});
    }
    return NodeIndex{entry->node};
  }
  const Ball* ball = cachedBall(to, bound);
  while (node != to) {
    const BallEntry* next = find(*ball, NodeIndex{find(*ball, node)->predecessor});
    if (length - static_cast<double>(next->distance) > distance) {
      break;
    }
    node = NodeIndex{next->node};
  }
  return node;
}

NodeIndex MeshMetricQuery::nodeInBall(NodeIndex from, double radius, double fraction) {
  allocate();
  const Ball* cached = cachedBall(from, radius);
  const Ball& ball = cached != nullptr && cached->radius == radius ? *cached : searchBall(from, radius);
  auto seat = static_cast<std::size_t>(fraction * static_cast<double>(ball.seats));
  while (ball_entries_[ball.first + seat].node == kNoNode) {
    seat = (seat + 1) % ball.seats;
  }
  return NodeIndex{ball_entries_[ball.first + seat].node};
}

const MeshMetricQuery::Ball* MeshMetricQuery::cachedBall(NodeIndex source, double radius) const {
  const std::uint32_t slot = ball_of_node_[source.value];
  return slot != kNoBall && balls_[slot].radius >= radius ? &balls_[slot] : nullptr;
}

const MeshMetricQuery::BallEntry* MeshMetricQuery::find(const Ball& ball, NodeIndex node) const {
  std::size_t seat = homeSeat(node.value, ball.seats);
  while (true) {
    const BallEntry& entry = ball_entries_[ball.first + seat];
    if (entry.node == node.value) {
      return &entry;
    }
    if (entry.node == kNoNode) {
      return nullptr;
    }
    seat = seat + 1 == ball.seats ? 0 : seat + 1;
  }
}

/// Dijkstra's search up to the radius. The heap orders by float, half as large as double: where it hands out
/// two nodes in the wrong order, the later one corrects the other, so the lengths are exact all the same.
const MeshMetricQuery::Ball& MeshMetricQuery::searchBall(NodeIndex source, double radius) {
  const NodeGraph& graph = metric_->graph();
  const double limit = radius * kFloatRounding;
  clearSearch();
  reach(source, 0.0, source);
  open_.push_back({0.0F, source.value});
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), ComesLater{});
    const Reached nearest = open_.back();
    open_.pop_back();
    const double path_length = path_length_[nearest.node];
    if (nearest.key > static_cast<float>(path_length)) {
      continue;  // a shorter path to it was found later
    }
    for (const NodeGraph::Edge& edge : graph.edges.row(nearest.node)) {
      const double through = path_length + static_cast<double>(edge.length);
      if (through <= limit && through < path_length_[edge.to.value]) {
        reach(edge.to, through, NodeIndex{nearest.node});
        open_.push_back({static_cast<float>(through), edge.to.value});
        std::push_heap(open_.begin(), open_.end(), ComesLater{});
      }
    }
  }
  return storeBall(source, radius);
}

const MeshMetricQuery::Ball& MeshMetricQuery::storeBall(NodeIndex source, double radius) {
  const std::size_t seats = reached_.size() + reached_.size() / 2 + 1;
  const std::size_t first = makeRoom(seats);
  const std::size_t slot = (oldest_ball_ + ball_count_) % balls_.size();
  ++ball_count_;
  balls_[slot] = {source, radius, first, seats};
  ball_of_node_[source.value] = static_cast<std::uint32_t>(slot);
  BallEntry* table = &ball_entries_[first];
  std::fill(table, table + seats, BallEntry{kNoNode, 0.0F, kNoNode});
  for (const NodeIndex node : reached_) {
    std::size_t seat = homeSeat(node.value, seats);
    while (table[seat].node != kNoNode) {
      seat = seat + 1 == seats ? 0 : seat + 1;
    }
    table[seat] = {node.value, static_cast<float>(path_length_[node.value]), predecessor_[node.value].value};
  }
  return balls_[slot];
}

void MeshMetricQuery::dropOldestBall() {
  const Ball& ball = balls_[oldest_ball_];
  if (ball_of_node_[ball.source.value] == oldest_ball_) {  // else a larger one took its place
    ball_of_node_[ball.source.value] = kNoBall;
  }
  oldest_ball_ = (oldest_ball_ + 1) % balls_.size();
  --ball_count_;
}

/// Balls lie in the ring of entries in the order of their age, so room is made by dropping the oldest.
/// Returns where the new one starts.
std::size_t MeshMetricQuery::makeRoom(std::size_t seats) {
  if (next_entry_ + seats > ball_entries_.size()) {
    while (ball_count_ > 0 && balls_[oldest_ball_].first >= next_entry_) {
      dropOldestBall();
    }
    next_entry_ = 0;
  }
  const auto oldest_is_in_place = [&] {
    const Ball& oldest = balls_[oldest_ball_];
    return oldest.first < next_entry_ + seats && oldest.first + oldest.seats > next_entry_;
  };
  while (ball_count_ > 0 && (ball_count_ == balls_.size() || oldest_is_in_place())) {
    dropOldestBall();
  }
  const std::size_t first = next_entry_;
  next_entry_ += seats;
  return first;
}

}  // namespace concave_distance
