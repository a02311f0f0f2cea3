#include <algorithm>

#include "concave_distance/mesh/mesh_metric.h"

namespace concave_distance {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kNoBall = std::numeric_limits<std::uint32_t>::max();
// Room for this many balls that each cover the whole mesh; smaller balls fit in greater number.
constexpr std::size_t kBallEntriesPerNode = 16;
constexpr std::size_t kBallSlots = 1024;
// A distance is rounded to float once: what rounds down to a bound is less than this factor above it.
constexpr double kFloatRounding = 1.0 + 0x1.0p-23;
// The straight distance is itself rounded; scaled down by this it never exceeds a path's length.
constexpr double kStraightRounding = 1.0 - 0x1.0p-48;

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
  ball_entries_.resize(kBallEntriesPerNode * nodes);
  balls_.resize(std::min(kBallSlots, nodes));
  ball_of_node_.assign(nodes, kNoBall);
  path_length_.assign(nodes, kInfinity);
  predecessor_.resize(nodes);
  reached_.reserve(nodes);
  heap_.reserve(nodes);
}

std::size_t MeshMetricQuery::memoryBytes() const {
  return ball_entries_.capacity() * sizeof(BallEntry) + balls_.capacity() * sizeof(Ball) +
         ball_of_node_.capacity() * sizeof(std::uint32_t) + path_length_.capacity() * sizeof(double) +
         (predecessor_.capacity() + reached_.capacity()) * sizeof(NodeIndex) +
         heap_.capacity() * sizeof(OpenNode);
}

void MeshMetricQuery::clearSearch() {
  for (const NodeIndex node : reached_) {
    path_length_[node.value] = kInfinity;
  }
  reached_.clear();
  heap_.clear();
}

void MeshMetricQuery::open(NodeIndex node, double path_length, double key, NodeIndex predecessor) {
  if (path_length_[node.value] == kInfinity) {
    reached_.push_back(node);
  }
  path_length_[node.value] = path_length;
  predecessor_[node.value] = predecessor;
  heap_.push_back({key, path_length, node});
  std::push_heap(heap_.begin(), heap_.end(), ComesLater{});
}

bool MeshMetricQuery::takeNearest(OpenNode& nearest) {
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), ComesLater{});
    nearest = heap_.back();
    heap_.pop_back();
    if (nearest.path_length <= path_length_[nearest.node.value]) {
      return true;  // else a shorter path to it was opened later
    }
  }
  return false;
}

double MeshMetricQuery::distanceWithin(NodeIndex from, NodeIndex to, double bound) {
  if (from == to) {
    return bound >= 0.0 ? 0.0 : kInfinity;
  }
  if (metric_->hasMatrices()) {
    const auto distance = static_cast<double>(metric_->matrixDistance(from, to));
    return distance <= bound ? distance : kInfinity;
  }
  const NodeGraph& graph = metric_->graph();
  if (graph.shell[from.value] != graph.shell[to.value] ||
      (graph.positions[from.value] - graph.positions[to.value]).norm() > bound * kFloatRounding) {
    return kInfinity;
  }
  allocate();
  double distance = kInfinity;
  if (const Ball* ball = cachedBall(from, bound)) {
    distance = static_cast<double>(ballDistance(*ball, to));
  } else if (const Ball* ball_of_to = cachedBall(to, bound)) {
    distance = static_cast<double>(ballDistance(*ball_of_to, from));
  } else {
    distance = static_cast<double>(ballDistance(searchBall(from, bound), to));
  }
  return distance <= bound ? distance : kInfinity;
}

const MeshMetricQuery::Ball* MeshMetricQuery::cachedBall(NodeIndex source, double radius) const {
  const std::uint32_t slot = ball_of_node_[source.value];
  return slot != kNoBall && balls_[slot].radius >= radius ? &balls_[slot] : nullptr;
}

float MeshMetricQuery::ballDistance(const Ball& ball, NodeIndex node) const {
  const auto first = ball_entries_.begin() + static_cast<std::ptrdiff_t>(ball.first);
  const auto last = first + static_cast<std::ptrdiff_t>(ball.count);
  const auto found = std::lower_bound(
      first, last, node, [](const BallEntry& entry, NodeIndex value) { return entry.node < value; });
  return found != last && found->node == node ? found->distance : std::numeric_limits<float>::infinity();
}

const MeshMetricQuery::Ball& MeshMetricQuery::searchBall(NodeIndex source, double radius) {
  const NodeGraph& graph = metric_->graph();
  const double limit = radius * kFloatRounding;
  clearSearch();
  open(source, 0.0, 0.0, source);
  OpenNode nearest{};
  while (takeNearest(nearest)) {
    for (const NodeGraph::Edge& edge : graph.edges.row(nearest.node.value)) {
      const double through = nearest.path_length + static_cast<double>(edge.length);
      if (through <= limit && through < path_length_[edge.to.value]) {
        open(edge.to, through, through, nearest.node);
      }
    }
  }
  return storeBall(source, radius);
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
const MeshMetricQuery::Ball& MeshMetricQuery::storeBall(NodeIndex source, double radius) {
  const std::size_t count = reached_.size();
  if (next_entry_ + count > ball_entries_.size()) {
    while (ball_count_ > 0 && balls_[oldest_ball_].first >= next_entry_) {
      dropOldestBall();
    }
    next_entry_ = 0;
  }
  const auto oldestIsInTheWay = [&] {
    const Ball& oldest = balls_[oldest_ball_];
    return oldest.first < next_entry_ + count && oldest.first + oldest.count > next_entry_;
  };
  while (ball_count_ > 0 && (ball_count_ == balls_.size() || oldestIsInTheWay())) {
    dropOldestBall();
  }
  const std::size_t slot = (oldest_ball_ + ball_count_) % balls_.size();
  ++ball_count_;
  balls_[slot] = {source, radius, next_entry_, count};
  ball_of_node_[source.value] = static_cast<std::uint32_t>(slot);

  const auto first = ball_entries_.begin() + static_cast<std::ptrdiff_t>(next_entry_);
  const auto last = std::transform(reached_.begin(), reached_.end(), first, [&](NodeIndex node) {
    return BallEntry{node, static_cast<float>(path_length_[node.value])};
  });
  std::sort(first, last, [](const BallEntry& l, const BallEntry& r) { return l.node < r.node; });
  next_entry_ += count;
  return balls_[slot];
}

void MeshMetricQuery::shortestPath(NodeIndex from, NodeIndex to, std::vector<NodeIndex>& path, double bound) {
  path.clear();
  const NodeGraph& graph = metric_->graph();
  if (graph.shell[from.value] != graph.shell[to.value]) {
    return;
  }
  if (metric_->hasMatrices()) {
    if (static_cast<double>(metric_->matrixDistance(from, to)) > bound) {
      return;
    }
    for (NodeIndex node = to; node != from; node = metric_->matrixPredecessor(from, node)) {
      path.push_back(node);
    }
    path.push_back(from);
    std::reverse(path.begin(), path.end());
    return;
  }
  allocate();
  // A*: the key never overestimates, and nodes are opened again when a shorter path turns up, so the path
  // is shortest when `to` comes first. Searched from `to`, so that the predecessors lead from `from` on.
  const Eigen::Vector3d& goal = graph.positions[from.value];
  const auto keyOf = [&](NodeIndex node, double path_length) {
    return path_length + (graph.positions[node.value] - goal).norm() * kStraightRounding;
  };
  const double limit = bound * kFloatRounding;
  clearSearch();
  open(to, 0.0, keyOf(to, 0.0), to);
  OpenNode nearest{};
  bool found = false;
  while (!found && takeNearest(nearest)) {
    found = nearest.node == from;
    if (found || nearest.key > limit) {
      break;
    }
    for (const NodeGraph::Edge& edge : graph.edges.row(nearest.node.value)) {
      const double through = nearest.path_length + static_cast<double>(edge.length);
      if (through < path_length_[edge.to.value]) {
        open(edge.to, through, keyOf(edge.to, through), nearest.node);
      }
    }
  }
  if (!found || static_cast<double>(static_cast<float>(nearest.path_length)) > bound) {
    return;
  }
  for (NodeIndex node = from; node != to; node = predecessor_[node.value]) {
    path.push_back(node);
  }
  path.push_back(to);
}

}  // namespace concave_distance
