#include "straight_chains.h"

#include <algorithm>
#include <utility>

namespace concave_distance::detail {
namespace {

using Ends = std::array<NodeIndex, 2>;

double distanceToChord(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double squared = along.squaredNorm();
  const double s = squared > 0.0 ? std::clamp((point - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (point - (a + s * along)).norm();
}

class ChainReducer {
 public:
  ChainReducer(const SurfaceMesh& mesh, double tolerance, std::vector<bool>& is_straight)
      : mesh_(mesh), tolerance_(tolerance), is_straight_(is_straight) {}

  /// Marks those between the first and the last node that stay.
  void reduceOpen(const std::vector<NodeIndex>& chain) {
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, chain.size() - 1}};
    while (!open.empty()) {
      const auto [first, last] = open.back();
      open.pop_back();
      std::size_t farthest = first;
      double distance = tolerance_;
      for (std::size_t i = first + 1; i < last; ++i) {
        const double d = distanceToChord(at(chain[i]), at(chain[first]), at(chain[last]));
        if (d > distance) {
          distance = d;
          farthest = i;
        }
      }
      if (farthest == first) continue;
      keep(chain[farthest]);
      open.emplace_back(first, farthest);
      open.emplace_back(farthest, last);
    }
  }

  /// Farthest from any point is a corner, and farthest from that is another.
  void reduceClosed(std::vector<NodeIndex> loop) {
    std::rotate(loop.begin(), farthestFrom(loop, loop.front()), loop.end());
    const auto second = farthestFrom(loop, loop.front());
    keep(loop.front());
    keep(*second);
    std::vector<NodeIndex> back(second, loop.end());
    back.push_back(loop.front());
    reduceOpen({loop.begin(), second + 1});
    reduceOpen(back);
  }

 private:
  const Eigen::Vector3d& at(NodeIndex node) const { return mesh_.vertex(node); }
  void keep(NodeIndex node) { is_straight_[node.value] = false; }

  std::vector<NodeIndex>::iterator farthestFrom(std::vector<NodeIndex>& loop, NodeIndex from) const {
    return std::max_element(loop.begin(), loop.end(), [&](NodeIndex l, NodeIndex r) {
      return (at(l) - at(from)).squaredNorm() < (at(r) - at(from)).squaredNorm();
    });
  }

  const SurfaceMesh& mesh_;
  double tolerance_;
  std::vector<bool>& is_straight_;
};

/// Walks from a node away from `previous`, as long as borders go through; ends at a node where they do not,
/// or at `start`.
std::vector<NodeIndex> follow(NodeIndex start, NodeIndex next, const std::vector<Ends>& ends,
                              const std::vector<bool>& goes_through) {
  std::vector<NodeIndex> chain{start};
  NodeIndex previous = start;
  while (next != start) {
    chain.push_back(next);
    if (!goes_through[next.value]) break;
    const Ends& both = ends[next.value];
    const NodeIndex after = both[0] == previous ? both[1] : both[0];
    previous = next;
    next = after;
  }
  return chain;
}

}  // namespace

std::array<NodeIndex, 2> commonEnds(NodeIndex node, const std::vector<VertexFan>& fans) {
  Ends ends{node, node};
  for (const VertexFan& fan : fans) {
    const NodeIndex low = std::min(fan.rim.front(), fan.rim.back());
    const NodeIndex high = std::max(fan.rim.front(), fan.rim.back());
    if (fan.is_closed || low == high || (&fan != &fans.front() && ends != Ends{low, high}))
      return {node, node};
    ends = {low, high};
  }
  return ends;
}

std::vector<bool> findStraightNodes(const SurfaceMesh& mesh, const PatchedMesh& patched, double tolerance) {
  std::vector<Ends> ends;
  std::vector<bool> goes_through;
  for (std::size_t i = 0; i < patched.nodeCount(); ++i) {
    const NodeIndex node{i};
    ends.push_back(commonEnds(node, patched.fansOf(node)));
    goes_through.push_back(ends.back()[0] != ends.back()[1]);
  }
  std::vector<bool> is_straight = goes_through;
  std::vector<bool> is_done(goes_through.size(), false);
  ChainReducer reducer(mesh, tolerance, is_straight);
  for (std::size_t i = 0; i < goes_through.size(); ++i) {
    if (!goes_through[i] || is_done[i]) continue;
    const NodeIndex start{i};
    std::vector<NodeIndex> chain = follow(start, ends[i][0], ends, goes_through);
    const bool is_loop = goes_through[chain.back().value];
    if (!is_loop) {
      const std::vector<NodeIndex> other = follow(start, ends[i][1], ends, goes_through);
      std::reverse(chain.begin(), chain.end());
      chain.insert(chain.end(), other.begin() + 1, other.end());
    }
    for (const NodeIndex node : chain) {
      is_done[node.value] = true;
    }
    if (is_loop) {
      reducer.reduceClosed(std::move(chain));
    } else {
      reducer.reduceOpen(chain);
    }
  }
  return is_straight;
}

}  // namespace concave_distance::detail
