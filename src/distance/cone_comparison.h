#pragma once

#include <Eigen/Core>

#include "cone_pair_bounds.h"
#include "feature_pairs.h"
#include "minima_scene.h"

namespace concave_distance::detail {

/// Compares groups of normal cones of two bodies at one pose.
class ConeComparison {
 public:
  using Tree = NormalConeTree;
  using Slot = Tree::Slot;
  static constexpr auto kWidth = static_cast<std::uint32_t>(Tree::kWidth);

  ConeComparison(const MinimaScene& scene, const FeaturePairs& features, NormalSides sides)
      : scene_(scene),
        a(scene.a.normalCones(sides)),
        b(scene.b.normalCones(sides)),
        limits_a_(features.slack(), scene.size, features.cutoff(), a.unit()),
        limits_b_(features.slack(), scene.size, features.cutoff(), b.unit()),
        turned_(scene.frames.rotation.transpose()) {}

  static bool isItem(std::uint32_t child) { return (child & Tree::kItemFlag) != 0; }
  static const Tree::Item& itemOf(const Tree& tree, std::uint32_t child) {
    return tree.items()[child & ~Tree::kItemFlag];
  }

  /// Which of two children is opened next; one of them is a node.
  bool opensB(Slot slot_a, Slot slot_b) const {
    return isItem(a.child(slot_a)) || (!isItem(b.child(slot_b)) && breadth(b, slot_b) >= breadth(a, slot_a));
  }

  /// A child of A with the four of a node of B, and the other way round.
  ConeReasons withNodeOfB(Slot kept, std::uint32_t node) {
    return coneReasons(b.nodes()[node], comparedA(kept), limits_b_);
  }
  ConeReasons withNodeOfA(std::uint32_t node, Slot kept) {
    return coneReasons(a.nodes()[node], comparedB(kept), limits_a_);
  }

 private:
  /// How much a child leaves open, in metres: the turn of its normals counts like the turn of directions.
  static double breadth(const Tree& tree, Slot slot) {
    const Tree::Node& node = tree.nodes()[slot / kWidth];
    return tree.unit() * node.radius[slot % kWidth] * (1.5 - node.cosine[slot % kWidth]);
  }

  static Eigen::Vector3d vectorOf(const float (&lanes)[3][Tree::kWidth], Slot slot) {
    return {lanes[0][slot % kWidth], lanes[1][slot % kWidth], lanes[2][slot % kWidth]};
  }

  static ComparedCone compared(const Tree& from, Slot slot, const Tree& to, const Eigen::Vector3d& centre,
                               const Eigen::Vector3d& axis) {
    const Tree::Node& node = from.nodes()[slot / kWidth];
    const std::uint32_t lane = slot % kWidth;
    const Eigen::Vector3d in_units = centre / to.unit();
    return {{static_cast<float>(in_units.x()), static_cast<float>(in_units.y()),
             static_cast<float>(in_units.z())},
            static_cast<float>(node.radius[lane] * (from.unit() / to.unit())),
            {static_cast<float>(axis.x()), static_cast<float>(axis.y()), static_cast<float>(axis.z())},
            node.angle[lane],
            node.cosine[lane],
            node.sine[lane]};
  }

  /// Child of A as B's nodes see it; the last one is kept.
  const ComparedCone& comparedA(Slot slot) {
    if (slot != compared_slot_a_) {
      const Tree::Node& node = a.nodes()[slot / kWidth];
      const Eigen::Vector3d centre = a.unit() * vectorOf(node.centre, slot);
      compared_a_ = compared(a, slot, b, turned_ * (centre - scene_.frames.offset),
                             turned_ * vectorOf(node.axis, slot));
      compared_slot_a_ = slot;
    }
    return compared_a_;
  }
  const ComparedCone& comparedB(Slot slot) {
    if (slot != compared_slot_b_) {
      const Tree::Node& node = b.nodes()[slot / kWidth];
      const Eigen::Vector3d centre = b.unit() * vectorOf(node.centre, slot);
      compared_b_ = compared(b, slot, a, scene_.frames.rotation * centre + scene_.frames.offset,
                             scene_.frames.rotation * vectorOf(node.axis, slot));
      compared_slot_b_ = slot;
    }
    return compared_b_;
  }

  const MinimaScene& scene_;

 public:
  const Tree& a;
  const Tree& b;

 private:
  ConeLimits limits_a_;  ///< for comparisons with A's nodes
  ConeLimits limits_b_;
  Eigen::Matrix3d turned_;  ///< from A's axes to B's
  ComparedCone compared_a_{};
  ComparedCone compared_b_{};
  Slot compared_slot_a_ = Tree::kNoChild;
  Slot compared_slot_b_ = Tree::kNoChild;
};

}  // namespace concave_distance::detail
