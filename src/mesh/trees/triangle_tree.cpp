#include "triangle_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <limits>

namespace concave_distance {
namespace {

constexpr std::size_t kMostBins = 16;
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
  explicit TriangleTreeBuilder(const SurfaceMesh& mesh) : items_(mesh.triangleCount()) {
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      items_[t].triangle = TriangleIndex{t};
      for (int k = 0; k < 3; ++k) items_[t].box.extend(mesh.corner(TriangleIndex{t}, k));
    }
  }

  std::vector<TriangleIndex> order() const {
    std::vector<TriangleIndex> order;
    order.reserve(items_.size());
    for (const Item& item : items_) order.push_back(item.triangle);
    return order;
  }

  // Depth first, so that the first child is next to its parent; the recursion is at most 80 deep. What is
  // built does not depend on the number of threads: tasks share nothing but disjoint ranges of the items.
  void build(std::uint32_t first, std::uint32_t last, std::uint32_t depth, Nodes& nodes) {
    const std::size_t self = nodes.size();
    nodes.emplace_back();
    Eigen::AlignedBox3d centre_box;
    for (std::uint32_t i = first; i < last; ++i) {
      nodes[self].box.extend(items_[i].box);
      centre_box.extend(items_[i].centre());
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
  // The boxes are sorted themselves: passes over a node then read memory in its order.
  struct Item {
    Eigen::AlignedBox3d box;
    TriangleIndex triangle;
    Eigen::Vector3d centre() const { return 0.5 * (box.min() + box.max()); }
  };
  struct Bin {
    Eigen::AlignedBox3d box;
    std::uint32_t count = 0;
  };
  using Bins = std::array<std::array<Bin, kMostBins>, 3>;  // by axis

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
    const std::size_t bin_count = std::min<std::size_t>(kMostBins, 2 * count);
    const Eigen::Vector3d to_bin = static_cast<double>(bin_count) / centre_box.sizes().array();
    const Bins bins = binsOf(first, last, centre_box, to_bin, bin_count);
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(centre_box.sizes()[axis] > 0.0)) continue;
      const std::array<Bin, kMostBins>& along = bins[static_cast<std::size_t>(axis)];
      std::array<double, kMostBins> cost_above{};
      Bin above;
      for (std::size_t bin = bin_count - 1; bin > 0; --bin) {
        above.box.extend(along[bin].box);
        above.count += along[bin].count;
        cost_above[bin] = halfArea(above.box) * above.count;
      }
      Bin below;
      for (std::size_t bin = 1; bin < bin_count; ++bin) {
        below.box.extend(along[bin - 1].box);
        below.count += along[bin - 1].count;
        if (below.count == 0 || below.count == count) continue;
        const double cost = 1.0 + (halfArea(below.box) * below.count + cost_above[bin]) / area;
        if (cost < best_cost) {
          best_cost = cost;
          best = {axis, centre_box.min()[axis] + static_cast<double>(bin) / to_bin[axis]};
        }
      }
    }
    if (best.axis < 0) return first;
    const auto middle = std::partition(items_.begin() + first, items_.begin() + last, [&](const Item& item) {
      return item.centre()[best.axis] < best.position;
    });
    const auto split = static_cast<std::uint32_t>(middle - items_.begin());
    return split == last ? first : split;
  }

  Bins binsOf(std::uint32_t first, std::uint32_t last, const Eigen::AlignedBox3d& centre_box,
              const Eigen::Vector3d& to_bin, std::size_t bin_count) const {
    Bins bins;
    for (std::uint32_t i = first; i < last; ++i) {
      const Eigen::Vector3d centre = items_[i].centre();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<Eigen::Index>(axis);
        const double low = centre_box.min()[k];
        if (!(centre_box.max()[k] - low > 0.0)) continue;
        Bin& bin =
            bins[axis][std::min(bin_count - 1, static_cast<std::size_t>((centre[k] - low) * to_bin[k]))];
        bin.box.extend(items_[i].box);
        ++bin.count;
      }
    }
    return bins;
  }

  std::uint32_t splitByCount(std::uint32_t first, std::uint32_t last, const Eigen::AlignedBox3d& centre_box) {
    Eigen::Index axis = 0;
    centre_box.sizes().maxCoeff(&axis);
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(items_.begin() + first, items_.begin() + middle, items_.begin() + last,
                     [&](const Item& l, const Item& r) {
                       const double cl = l.centre()[axis];
                       const double cr = r.centre()[axis];
                       return cl != cr ? cl < cr : l.triangle < r.triangle;
                     });
    return middle;
  }

  std::vector<Item> items_;
};

}  // namespace

TriangleTree::TriangleTree(const SurfaceMesh& mesh) {
  if (mesh.triangleCount() == 0) return;
  nodes_.reserve(mesh.triangleCount());
  TriangleTreeBuilder builder(mesh);
  builder.build(0, static_cast<std::uint32_t>(mesh.triangleCount()), 0, nodes_);
  order_ = builder.order();
  nodes_.shrink_to_fit();
}

}  // namespace concave_distance
