#include "triangle_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <limits>

namespace concave_distance {
namespace {

constexpr std::size_t kBinCount = 16;
constexpr std::uint32_t kLargestLeaf = 4;
/// Below this depth nodes are halved by count, so that the depth stays under kSurfaceAreaDepth + 32.
constexpr std::uint32_t kSurfaceAreaDepth = 48;

double halfArea(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return 0.0;
  const Eigen::Vector3d s = box.sizes();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

struct Split {
  int axis = -1;
  double position = 0.0;  ///< boxes whose centre lies below go to the first child
};

using Nodes = std::vector<TriangleTree::Node>;

class TriangleTreeBuilder {
 public:
  TriangleTreeBuilder(const SurfaceMesh& mesh, std::vector<TriangleIndex>& order)
      : order_(order), boxes_(mesh.triangleCount()), centres_(mesh.triangleCount()) {
    order_.reserve(mesh.triangleCount());
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      for (int k = 0; k < 3; ++k) {
        boxes_[t].extend(mesh.corner(TriangleIndex{t}, k));
      }
      centres_[t] = 0.5 * (boxes_[t].min() + boxes_[t].max());
      order_.push_back(TriangleIndex{t});
    }
  }

  // Depth first, so that the first child is next to its parent; the recursion is at most 80 deep. What is
  // built does not depend on the number of threads: tasks share nothing but disjoint ranges of the order.
  void build(std::uint32_t first, std::uint32_t last, std::uint32_t depth, Nodes& nodes) {
    const std::size_t self = nodes.size();
    nodes.emplace_back();
    Eigen::AlignedBox3d centre_box;
    for (std::uint32_t i = first; i < last; ++i) {
      nodes[self].box.extend(boxes_[order_[i].value]);
      centre_box.extend(centres_[order_[i].value]);
    }
    const std::uint32_t count = last - first;
    std::uint32_t middle = first;
    if (count > 1) {
      middle = depth < kSurfaceAreaDepth ? splitByArea(first, last, nodes[self].box, centre_box) : first;
      if (middle == first && count > kLargestLeaf) middle = splitByCount(first, last, centre_box);
    }
    if (middle == first) {
      nodes[self].first = first;
      nodes[self].count = count;
      return;
    }
    if (count < kParallelSubtree) {
      build(first, middle, depth + 1, nodes);
      nodes[self].first = static_cast<std::uint32_t>(nodes.size());
      build(middle, last, depth + 1, nodes);
      return;
    }
    Nodes second;
    tbb::parallel_invoke([&] { build(first, middle, depth + 1, nodes); },
                         [&] { build(middle, last, depth + 1, second); });
    nodes[self].first = static_cast<std::uint32_t>(nodes.size());
    append(second, nodes);
  }

 private:
  static void append(const Nodes& subtree, Nodes& nodes) {
    const auto base = static_cast<std::uint32_t>(nodes.size());
    nodes.insert(nodes.end(), subtree.begin(), subtree.end());
    for (std::size_t i = base; i < nodes.size(); ++i) {
      if (nodes[i].count == 0) nodes[i].first += base;
    }
  }

  /// First entry of the second child; `first` when a leaf is cheaper or no plane separates the centres.
  std::uint32_t splitByArea(std::uint32_t first, std::uint32_t last, const Eigen::AlignedBox3d& box,
                            const Eigen::AlignedBox3d& centre_box) {
    const std::uint32_t count = last - first;
    // Costs relative to one triangle test; opening a node costs about as much.
    double best_cost = count <= kLargestLeaf ? count : std::numeric_limits<double>::infinity();
    const double area = std::max(halfArea(box), std::numeric_limits<double>::min());
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = centre_box.min()[axis];
      const double width = centre_box.max()[axis] - low;
      if (!(width > 0.0)) continue;
      std::array<Eigen::AlignedBox3d, kBinCount> bin_boxes;
      std::array<std::uint32_t, kBinCount> bin_counts{};
      const double to_bin = static_cast<double>(kBinCount) / width;
      for (std::uint32_t i = first; i < last; ++i) {
        const std::uint32_t t = order_[i].value;
        const auto bin =
            std::min(kBinCount - 1, static_cast<std::size_t>((centres_[t][axis] - low) * to_bin));
        bin_boxes[bin].extend(boxes_[t]);
        ++bin_counts[bin];
      }
      std::array<double, kBinCount> cost_above{};
      Eigen::AlignedBox3d above;
      std::uint32_t count_above = 0;
      for (std::size_t bin = kBinCount - 1; bin > 0; --bin) {
        above.extend(bin_boxes[bin]);
        count_above += bin_counts[bin];
        cost_above[bin] = halfArea(above) * count_above;
      }
      Eigen::AlignedBox3d below;
      std::uint32_t count_below = 0;
      for (std::size_t bin = 1; bin < kBinCount; ++bin) {
        below.extend(bin_boxes[bin - 1]);
        count_below += bin_counts[bin - 1];
        if (count_below == 0 || count_below == count) continue;
        const double cost = 1.0 + (halfArea(below) * count_below + cost_above[bin]) / area;
        if (cost < best_cost) {
          best_cost = cost;
          best = {axis, low + static_cast<double>(bin) / to_bin};
        }
      }
    }
    if (best.axis < 0) return first;
    const auto middle = std::partition(order_.begin() + first, order_.begin() + last, [&](TriangleIndex t) {
      return centres_[t.value][best.axis] < best.position;
    });
    const auto split = static_cast<std::uint32_t>(middle - order_.begin());
    return split == last ? first : split;
  }

  std::uint32_t splitByCount(std::uint32_t first, std::uint32_t last, const Eigen::AlignedBox3d& centre_box) {
    Eigen::Index axis = 0;
    centre_box.sizes().maxCoeff(&axis);
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](TriangleIndex l, TriangleIndex r) {
                       const double cl = centres_[l.value][axis];
                       const double cr = centres_[r.value][axis];
                       return cl != cr ? cl < cr : l < r;
                     });
    return middle;
  }

  std::vector<TriangleIndex>& order_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<Eigen::Vector3d> centres_;
};

}  // namespace

TriangleTree::TriangleTree(const SurfaceMesh& mesh) {
  if (mesh.triangleCount() == 0) return;
  nodes_.reserve(mesh.triangleCount());
  TriangleTreeBuilder(mesh, order_).build(0, static_cast<std::uint32_t>(mesh.triangleCount()), 0, nodes_);
  nodes_.shrink_to_fit();
}

std::size_t TriangleTree::memoryBytes() const {
  return nodes_.capacity() * sizeof(Node) + order_.capacity() * sizeof(TriangleIndex);
}

}  // namespace concave_distance
