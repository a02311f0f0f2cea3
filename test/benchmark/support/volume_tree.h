#pragma once

#include <limits>

#include "benchmark/support/bounding_volumes.h"
#include "concave_distance/mesh/body_mesh.h"
#include "distance/bound/certificate.h"
#include "distance/kernels/witness_refinement.h"

namespace concave_distance::benchmark {

/// A body's triangle tree with volumes of one kind, collapsed to W children a node and up to four triangles a
/// leaf. Coordinates relative to the hierarchy's origin.
template <typename Volume, int W>
class VolumeTree {
 public:
  using Item = typename Volume::Item;
  static constexpr std::uint32_t kLeafFlag = 0x80000000U;
  struct Node {
    typename Volume::template Lanes<W> lanes;
    std::array<std::uint32_t, W> child;  ///< a slot
    int count = 0;
  };
  /// A volume and what it holds: a node, or triangles with kLeafFlag in `below`.
  struct Slot {
    Item item;
    double squared_size;
    std::uint32_t below;
    std::uint32_t first;
    std::uint32_t count;
  };

  explicit VolumeTree(const BodyMesh& body) : tree_(body.tree()), counts_(tree_.nodes().size()) {
    const SurfaceMesh& mesh = body.surface();
    for (const TriangleIndex t : tree_.order()) {
      for (int k = 0; k < 3; ++k) corners_.push_back(mesh.corner(t, k) - body.hierarchy().origin());
    }
    for (std::size_t i = counts_.size(); i-- > 0;) {
      const TriangleTree::Node& node = tree_.nodes()[i];
      counts_[i] = node.count > 0 ? node.count : counts_[i + 1] + counts_[node.first];
    }
    place(0, 0);
  }

  const Slot& slot(std::uint32_t index) const { return slots_[index]; }
  const Node& node(std::uint32_t index) const { return nodes_[index]; }
  TriangleIndex triangle(std::uint32_t place) const { return tree_.order()[place]; }
  const Eigen::Vector3d* corners(std::uint32_t place) const {
    return corners_.data() + 3 * std::size_t{place};
  }

 private:
  std::uint32_t place(std::uint32_t tree_node, std::uint32_t first) {
    const auto self = static_cast<std::uint32_t>(slots_.size());
    const std::uint32_t count = counts_[tree_node];
    const Eigen::Vector3d* begin = corners(first);
    const Item item = Volume::fit({begin, begin + 3 * std::size_t{count}});
    slots_.push_back({item, Volume::squaredSize(item), kLeafFlag, first, count});
    if (count <= 4) return self;
    slots_[self].below = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    std::vector<std::array<std::uint32_t, 2>> children = {{tree_node, first}};  // of the tree, first triangle
    while (children.size() < W) {
      std::size_t widest = children.size();
      double area = -1.0;
      for (std::size_t i = 0; i < children.size(); ++i) {
        const TriangleTree::Node& node = tree_.nodes()[children[i][0]];
        if (node.count > 0 || (counts_[children[i][0]] <= 4 && children.size() > 1)) continue;
        const Eigen::Vector3d s = node.box.sizes();
        if (s.x() * s.y() + s.y() * s.z() + s.z() * s.x() > area) {
          area = s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
          widest = i;
        }
      }
      if (widest == children.size()) break;
      const auto [opened, from] = children[widest];
      children[widest] = {opened + 1, from};
      children.push_back({tree_.nodes()[opened].first, from + counts_[opened + 1]});
    }
    const std::uint32_t node = slots_[self].below;
    for (std::size_t i = 0; i < children.size(); ++i) {
      const std::uint32_t child = place(children[i][0], children[i][1]);
      nodes_[node].child[i] = child;
      nodes_[node].lanes.store(static_cast<int>(i), slots_[child].item);
    }
    nodes_[node].count = static_cast<int>(children.size());
    for (int lane = nodes_[node].count; lane < W; ++lane) {  // unused lanes repeat the last one
      nodes_[node].lanes.store(lane, slots_[nodes_[node].child[children.size() - 1]].item);
    }
    return self;
  }

  const TriangleTree& tree_;
  std::vector<std::uint32_t> counts_;
  std::vector<Eigen::Vector3d> corners_;
  std::vector<Slot> slots_;
  std::vector<Node> nodes_;
};

/// A plain proof of the distance over two trees: dives once, refines what it finds to its local minimum, then
/// goes depth first, the nearest child next. What separates at a pair of leaves is the witness direction;
/// what is left goes to the triangle kernel. The same for every volume and width.
template <typename Volume, int W>
class PlainProof {
 public:
  using Tree = VolumeTree<Volume, W>;
  PlainProof(const BodyMesh& a, const BodyMesh& b) : a_(a), b_(b), tree_a_(a), tree_b_(b) {}

  double run(const Eigen::Isometry3d& a_from_b) {
    rotation_ = a_from_b.linear();
    offset_ = a_from_b * b_.hierarchy().origin() - a_.hierarchy().origin();
    error_ = kProofError * proofScale(a_, b_, a_from_b);
    distance_ = enough_ = std::numeric_limits<double>::infinity();
    direction_.setZero();
    cost_ = CertificateCost();
    open_.clear();
    Pair pair{0, 0, 0.0};
    while (!isLeaf(tree_a_.slot(pair.a)) || !isLeaf(tree_b_.slot(pair.b))) {
      expand(pair);
      pair = open_.back();
    }
    const WitnessRefinement refined =
        refineWitness(a_, b_, a_from_b, tree_a_.triangle(tree_a_.slot(pair.a).first),
                      tree_b_.triangle(tree_b_.slot(pair.b).first), refinement_);
    cost_.triangle_pairs += refined.iterations;
    measure(localCorners(refined.witness.triangle_a), movedCorners(refined.witness.triangle_b));
    open_.assign(1, {0, 0, 0.0});
    while (!open_.empty() && distance_ > 0.0) {
      const Pair next = open_.back();
      open_.pop_back();
      if (next.bound >= enough_) continue;
      if (isLeaf(tree_a_.slot(next.a)) && isLeaf(tree_b_.slot(next.b))) {
        measureLeaves(tree_a_.slot(next.a), tree_b_.slot(next.b));
      } else {
        expand(next);
      }
    }
    return distance_;
  }
  const CertificateCost& cost() const { return cost_; }

 private:
  struct Pair {
    std::uint32_t a;
    std::uint32_t b;
    double bound;
  };
  static bool isLeaf(const typename Tree::Slot& slot) { return (slot.below & Tree::kLeafFlag) != 0; }

  TrianglePoints localCorners(TriangleIndex t) const {
    TrianglePoints points;
    for (std::size_t k = 0; k < 3; ++k) {
      points[k] = a_.surface().corner(t, static_cast<int>(k)) - a_.hierarchy().origin();
    }
    return points;
  }
  TrianglePoints movedCorners(TriangleIndex t) const {
    TrianglePoints points;
    for (std::size_t k = 0; k < 3; ++k) {
      points[k] =
          rotation_ * (b_.surface().corner(t, static_cast<int>(k)) - b_.hierarchy().origin()) + offset_;
    }
    return points;
  }

  void measure(const TrianglePoints& a, const TrianglePoints& b) {
    const TrianglePairDistance found = triangleDistance(a, b);
    ++cost_.triangle_pairs;
    const double distance = std::sqrt(found.squared_distance);
    if (!(distance < distance_)) return;
    distance_ = distance <= error_ ? 0.0 : distance;
    if (distance_ > 0.0) direction_ = (found.point_b - found.point_a) / distance;
    enough_ = std::max(0.0, distance_ - error_);
  }

  void measureLeaves(const typename Tree::Slot& slot_a, const typename Tree::Slot& slot_b) {
    ++cost_.leaf_pairs;
    TrianglePoints moved[4];
    double least[4];
    for (std::uint32_t j = 0; j < slot_b.count; ++j) {
      const Eigen::Vector3d* corners = tree_b_.corners(slot_b.first + j);
      for (std::size_t k = 0; k < 3; ++k) moved[j][k] = rotation_ * corners[k] + offset_;
    }
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    for (std::uint32_t i = 0; i < slot_a.count; ++i) {
      const Eigen::Vector3d* corners = tree_a_.corners(slot_a.first + i);
      for (std::uint32_t j = 0; j < slot_b.count; ++j) {
        if (direction != direction_ || (i == 0 && j == 0)) {
          direction = direction_;
          for (std::uint32_t n = 0; n < slot_b.count; ++n) {
            least[n] = std::min(
                {direction.dot(moved[n][0]), direction.dot(moved[n][1]), direction.dot(moved[n][2])});
          }
        }
        const double most =
            std::max({direction.dot(corners[0]), direction.dot(corners[1]), direction.dot(corners[2])});
        if (least[j] - most < enough_) measure({corners[0], corners[1], corners[2]}, moved[j]);
      }
    }
  }

  void expand(const Pair& pair) {
    const auto& slot_a = tree_a_.slot(pair.a);
    const auto& slot_b = tree_b_.slot(pair.b);
    const bool opens_b = isLeaf(slot_a) || (!isLeaf(slot_b) && slot_b.squared_size >= slot_a.squared_size);
    const typename Tree::Node& node = opens_b ? tree_b_.node(slot_b.below) : tree_a_.node(slot_a.below);
    const LaneArray<W> bounds =
        opens_b ? node.lanes.bounds(
                      Volume::moved(slot_a.item, rotation_.transpose(), -(rotation_.transpose() * offset_)),
                      rotation_.transpose() * direction_, enough_)
                : node.lanes.bounds(Volume::moved(slot_b.item, rotation_, offset_), -direction_, enough_);
    cost_.box_bounds += static_cast<std::uint32_t>(node.count);
    const std::size_t before = open_.size();
    for (int lane = 0; lane < node.count; ++lane) {
      if (bounds[lane] >= enough_) continue;
      const std::uint32_t child = node.child[static_cast<std::size_t>(lane)];
      open_.push_back(
          {opens_b ? pair.a : child, opens_b ? child : pair.b, std::max(pair.bound, bounds[lane])});
    }
    std::sort(open_.begin() + static_cast<std::ptrdiff_t>(before), open_.end(),
              [](const Pair& l, const Pair& r) { return l.bound > r.bound; });
  }

  const BodyMesh& a_;
  const BodyMesh& b_;
  Tree tree_a_;
  Tree tree_b_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d offset_;
  double error_ = 0.0;
  double distance_ = 0.0;
  double enough_ = 0.0;
  Eigen::Vector3d direction_;
  CertificateCost cost_;
  std::vector<Pair> open_;
  RefinementWorkspace refinement_;
};

}  // namespace concave_distance::benchmark
