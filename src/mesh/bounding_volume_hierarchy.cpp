#include "concave_distance/mesh/bounding_volume_hierarchy.h"

#include <algorithm>
#include <array>
#include <cmath>

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

class Builder {
 public:
  Builder(const SurfaceMesh& mesh, const TriangleTree& tree, const Vector3d& origin, double margin,
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
    nodes_.emplace_back(Hierarchy::Node{});
    std::fill(std::begin(nodes_[0].child), std::end(nodes_[0].child), Hierarchy::kNoChild);
    place({0, 0, counts_[0]}, 0, 0);
    repeatLastBox(nodes_[0], 1);
  }

 private:
  void place(const Subtree& subtree, std::size_t node, std::size_t lane) {
    storeBox(subtree, node, lane);
    if (subtree.count <= Hierarchy::kWidth) {
      nodes_[node].child[lane] = Hierarchy::kLeafFlag | static_cast<std::uint32_t>(leaves_.size());
      addLeaf(subtree);
      return;
    }
    const std::size_t self = nodes_.size();
    nodes_[node].child[lane] = static_cast<std::uint32_t>(self);
    nodes_.emplace_back(Hierarchy::Node{});
    std::fill(std::begin(nodes_[self].child), std::end(nodes_[self].child), Hierarchy::kNoChild);
    std::array<Subtree, Hierarchy::kWidth> children;
    const std::size_t count = collapse(subtree, children);
    for (std::size_t i = 0; i < count; ++i) place(children[i], self, i);
    repeatLastBox(nodes_[self], count);
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

  void storeBox(const Subtree& subtree, std::size_t node, std::size_t lane) {
    const OrientedBox box = detail::fitOrientedBox(
        {corners_.data() + 3 * std::size_t{subtree.first},
         corners_.data() + 3 * (std::size_t{subtree.first} + std::size_t{subtree.count})});
    Hierarchy::Node& target = nodes_[node];
    for (int k = 0; k < 3; ++k) {
      target.centre[k][lane] = box.centre[k];
      target.half[k][lane] = box.half[k] + margin_;
      for (int c = 0; c < 3; ++c) target.axes[k][c][lane] = box.axes(c, k);
    }
  }

  void addLeaf(const Subtree& subtree) {
    Hierarchy::Leaf leaf{};
    leaf.count = subtree.count;
    for (std::size_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
      const std::size_t i = subtree.first + std::min<std::size_t>(lane, subtree.count - 1);
      leaf.triangle[lane] = tree_.order()[i];
      for (std::size_t k = 0; k < 3; ++k) {
        for (int c = 0; c < 3; ++c) leaf.corner[k][c][lane] = corners_[3 * i + k][c];
      }
    }
    leaves_.push_back(leaf);
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
  Builder(mesh, tree, origin_, kBoxMargin * reach_, nodes_, leaves_).build();
  nodes_.shrink_to_fit();
  leaves_.shrink_to_fit();
  chooseRegions();
}

void BoundingVolumeHierarchy::chooseRegions() {
  regions_ = {kRoot};
  region_of_node_.assign(nodes_.size(), 0);
  // Parents come before their children. The node below the root belongs to the whole surface; the boxes of it
  // and of its children are regions; what is deeper is of its parent's.
  std::vector<std::uint8_t> depth(nodes_.size(), 0);
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
      const std::uint32_t child = nodes_[node].child[lane];
      if ((child & kLeafFlag) != 0) continue;
      depth[child] = static_cast<std::uint8_t>(std::min(depth[node] + 1, 4));
      if (depth[child] == 2 || depth[child] == 3) {
        region_of_node_[child] = static_cast<std::uint8_t>(regions_.size());
        regions_.push_back(node * static_cast<Slot>(kWidth) + lane);
      } else {
        region_of_node_[child] = region_of_node_[node];
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

std::size_t BoundingVolumeHierarchy::memoryBytes() const {
  return nodes_.capacity() * sizeof(Node) + leaves_.capacity() * sizeof(Leaf) + region_of_node_.capacity();
}

}  // namespace concave_distance
