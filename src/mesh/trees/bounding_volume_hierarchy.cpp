#include "bounding_volume_hierarchy.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <utility>

#include "oriented_box_fit.h"

namespace concave_distance {
namespace {

using Eigen::Vector3d;
using Hierarchy = BoundingVolumeHierarchy;

/// A subtree of the triangle tree: its triangles are next to each other in the tree's order.
struct Subtree {
  std::uint32_t node;
  std::uint32_t first;
  std::uint32_t count;
};

/// How many nodes and leaves are below a box, or where the next ones go.
struct Place {
  std::uint32_t nodes = 0;
  std::uint32_t leaves = 0;
};

class HierarchyBuilder {
 public:
  HierarchyBuilder(const SurfaceMesh& mesh, const TriangleTree& tree, const Vector3d& origin, double margin,
                   std::vector<Hierarchy::Node>& nodes, std::vector<Hierarchy::Leaf>& leaves)
      : tree_(tree), margin_(margin), nodes_(nodes), leaves_(leaves) {
    corners_.reserve(3 * mesh.triangleCount());
    for (const TriangleIndex t : tree.order()) {
      for (int k = 0; k < 3; ++k) corners_.push_back(mesh.corner(t, k) - origin);
    }
    counts_.resize(tree.nodes().size());
    // Children come after their parent, so that counts add up from the back.
    for (std::size_t i = counts_.size(); i-- > 0;) {
      const TriangleTree::Node& node = tree.nodes()[i];
      counts_[i] = node.count > 0 ? node.count : counts_[i + 1] + counts_[node.first];
    }
  }

  void build() {
    const Subtree all{0, 0, counts_[0]};
    const Place size = sizeOf(all);
    nodes_.resize(std::size_t{1} + size.nodes);
    leaves_.resize(size.leaves);
    nodes_[0] = emptyNode();
    Place next{1, 0};
    tbb::parallel_invoke([&] { storeBox(all, nodes_[0], 0); },
                         [&] { nodes_[0].child[0] = place(all, next); });
    repeatLastBox(nodes_[0], 1);
  }

 private:
  /// Counts what is below the subtree's box.
  Place sizeOf(const Subtree& subtree) const {
    if (subtree.count <= Hierarchy::kWidth) return {0, 1};
    std::array<Subtree, Hierarchy::kWidth> children;
    const std::size_t count = collapse(subtree, children);
    Place size{1, 0};
    for (std::size_t i = 0; i < count; ++i) {
      const Place below = sizeOf(children[i]);
      size.nodes += below.nodes;
      size.leaves += below.leaves;
    }
    return size;
  }

  /// Builds what is below a subtree's box, depth first from `next` on; returns what the box's
  /// child is called.
  std::uint32_t place(const Subtree& subtree, Place& next) {
    if (subtree.count <= Hierarchy::kWidth) {
      leaves_[next.leaves] = leafOf(subtree);
      return Hierarchy::kLeafFlag | next.leaves++;
    }
    const std::uint32_t self = next.nodes++;
    Hierarchy::Node& node = nodes_[self];
    node = emptyNode();
    std::array<Subtree, Hierarchy::kWidth> children;
    const std::size_t count = collapse(subtree, children);
    if (subtree.count <= kParallelSubtree) {
      for (std::size_t i = 0; i < count; ++i) {
        storeBox(children[i], node, i);
        node.child[i] = place(children[i], next);
      }
    } else {
      placeInTasks(children, count, node, next);
    }
    repeatLastBox(node, count);
    return self;
  }

  /// Every child is given where its nodes go, so that what is built does not depend on the number of threads.
  void placeInTasks(const std::array<Subtree, Hierarchy::kWidth>& children, std::size_t count,
                    Hierarchy::Node& node, Place& next) {
    std::array<Place, Hierarchy::kWidth> first;
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { first[i] = sizeOf(children[i]); });
    for (std::size_t i = 0; i < count; ++i) {
      const Place size = std::exchange(first[i], next);
      next = {next.nodes + size.nodes, next.leaves + size.leaves};
    }
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      storeBox(children[i], node, i);
      node.child[i] = place(children[i], first[i]);
    });
  }

  static Hierarchy::Node emptyNode() {
    Hierarchy::Node node{};
    std::fill(std::begin(node.child), std::end(node.child), Hierarchy::kNoChild);
    return node;
  }

  static void repeatLastBox(Hierarchy::Node& node, std::size_t used) {
    for (std::size_t lane = used; lane < Hierarchy::kWidth; ++lane) {
      for (int k = 0; k < 3; ++k) {
        node.centre[k][lane] = node.centre[k][used - 1];
        node.half[k][lane] = node.half[k][used - 1];
        for (int c = 0; c < 3; ++c) node.axes[k][c][lane] = node.axes[k][c][used - 1];
      }
    }
  }

  /// Opens the largest subtree again and again until there are four.
  std::size_t collapse(const Subtree& subtree, std::array<Subtree, Hierarchy::kWidth>& children) const {
    std::size_t count = 1;
    children[0] = subtree;
    while (count < Hierarchy::kWidth) {
      std::size_t widest = count;
      double widest_area = -1.0;
      for (std::size_t i = 0; i < count; ++i) {
        const bool is_leaf = tree_.nodes()[children[i].node].count > 0;
        if (is_leaf || (children[i].count <= Hierarchy::kWidth && count > 1)) continue;
        const Vector3d sizes = tree_.nodes()[children[i].node].box.sizes();
        const double area = sizes.x() * sizes.y() + sizes.y() * sizes.z() + sizes.z() * sizes.x();
        if (area > widest_area) {
          widest = i;
          widest_area = area;
        }
      }
      if (widest == count) break;
      const Subtree open = children[widest];
      const std::uint32_t second = tree_.nodes()[open.node].first;
      const std::uint32_t first_count = counts_[open.node + 1];
      children[widest] = {open.node + 1, open.first, first_count};
      children[count++] = {second, open.first + first_count, counts_[second]};
    }
    return count;
  }

  void storeBox(const Subtree& subtree, Hierarchy::Node& target, std::size_t lane) const {
    const OrientedBox box = detail::fitOrientedBox(
        {corners_.data() + 3 * std::size_t{subtree.first},
         corners_.data() + 3 * (std::size_t{subtree.first} + std::size_t{subtree.count})});
    for (int k = 0; k < 3; ++k) {
      target.centre[k][lane] = box.centre[k];
      target.half[k][lane] = box.half[k] + margin_;
      for (int c = 0; c < 3; ++c) target.axes[k][c][lane] = box.axes(c, k);
    }
  }

  Hierarchy::Leaf leafOf(const Subtree& subtree) const {
    Hierarchy::Leaf leaf{};
    leaf.count = subtree.count;
    for (std::size_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
      const std::size_t i = subtree.first + std::min<std::size_t>(lane, subtree.count - 1);
      leaf.triangle[lane] = tree_.order()[i];
      for (std::size_t k = 0; k < 3; ++k) {
        for (int c = 0; c < 3; ++c) leaf.corner[k][c][lane] = corners_[3 * i + k][c];
      }
    }
    return leaf;
  }

  const TriangleTree& tree_;
  double margin_;
  std::vector<Hierarchy::Node>& nodes_;
  std::vector<Hierarchy::Leaf>& leaves_;
  std::vector<Vector3d> corners_;      ///< in the tree's order, relative to the origin
  std::vector<std::uint32_t> counts_;  ///< triangles below each node of the tree
};

}  // namespace

BoundingVolumeHierarchy::BoundingVolumeHierarchy(const SurfaceMesh& mesh, const TriangleTree& tree)
    : origin_(0.5 * mesh.boundingBox().min() + 0.5 * mesh.boundingBox().max()) {
  for (const Vector3d& vertex : mesh.vertices()) reach_ = std::max(reach_, (vertex - origin_).norm());
  reach_ *= 1.0 + kBoxMargin;
  HierarchyBuilder(mesh, tree, origin_, kBoxMargin * reach_, nodes_, leaves_).build();
  roundNodes();
  chooseSubtrees();
}

void BoundingVolumeHierarchy::roundNodes() {
  const double unit = reach_ > 0.0 ? 1.0 / reach_ : 0.0;
  single_nodes_.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    SingleNode& single = single_nodes_[i];
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      single.child[lane] = node.child[lane];
      single.squared_size[lane] = 0.0F;
      for (int k = 0; k < 3; ++k) {
        single.centre[k][lane] = static_cast<float>(node.centre[k][lane] * unit);
        single.half[k][lane] = static_cast<float>(node.half[k][lane] * unit);
        single.squared_size[lane] += single.half[k][lane] * single.half[k][lane];
        for (int c = 0; c < 3; ++c) single.axes[k][c][lane] = static_cast<float>(node.axes[k][c][lane]);
      }
    }
  }
}

void BoundingVolumeHierarchy::chooseSubtrees() {
  subtrees_ = {kRoot};
  subtree_of_node_.assign(nodes_.size(), 0);
  // Parents come before their children. The node below the root belongs to the whole surface; the boxes of it
  // and of its children are subtrees; what is deeper is of its parent's.
  std::vector<std::uint8_t> depth(nodes_.size(), 0);
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
      const std::uint32_t child = nodes_[node].child[lane];
      if ((child & kLeafFlag) != 0) continue;
      depth[child] = static_cast<std::uint8_t>(std::min(depth[node] + 1, 4));
      if (depth[child] == 2 || depth[child] == 3) {
        subtree_of_node_[child] = static_cast<std::uint8_t>(subtrees_.size());
        subtrees_.push_back(node * static_cast<Slot>(kWidth) + lane);
      } else {
        subtree_of_node_[child] = subtree_of_node_[node];
      }
    }
  }
}

OrientedBox BoundingVolumeHierarchy::box(Slot slot) const {
  const Node& node = nodes_[slot / kWidth];
  const std::size_t lane = slot % kWidth;
  OrientedBox box;
  for (int k = 0; k < 3; ++k) {
    box.centre[k] = node.centre[k][lane];
    box.half[k] = node.half[k][lane];
    for (int c = 0; c < 3; ++c) box.axes(c, k) = node.axes[k][c][lane];
  }
  return box;
}

}  // namespace concave_distance
