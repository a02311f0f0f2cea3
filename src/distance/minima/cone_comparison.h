#pragma once

#include <Eigen/Core>
#include <utility>

#include "cone_pair_bounds.h"
#include "distance/kernels/pair_frame.h"
#include "feature_pairs.h"

namespace concave_distance::detail {

/// Compares groups of normal cones of two bodies at one pose.
class ConeComparison {
 public:
  using Tree = NormalConeTree;
  using Slot = Tree::Slot;
  static constexpr auto kWidth = static_cast<std::uint32_t>(Tree::kWidth);

  ConeComparison(const PairFrame& frame, const FeaturePairs& features, NormalSides sides)
      : frame_(frame),
        a(frame.a.normalCones(sides)),
        b(frame.b.normalCones(sides)),
        limits_a_(features.slack(), frame.size, features.cutoff(), a.unit()),
        limits_b_(features.slack(), frame.size, features.cutoff(), b.unit()),
        turned_(frame.rotation.transpose()),
        scale_(static_cast<float>(a.unit() / b.unit())) {
    const Eigen::Vector3d offset = -(turned_ * frame.offset) / b.unit();
    for (int row = 0; row < 3; ++row) {
      offset_of_a_[row] = static_cast<float>(offset[row]);
      for (int column = 0; column < 3; ++column) {
        axes_of_a_[row][column] = static_cast<float>(turned_(row, column));
      }
    }
  }

  static bool isItem(std::uint32_t child) { return (child & Tree::kItemFlag) != 0; }
  static const Tree::Item& itemOf(const Tree& tree, std::uint32_t child) {
    return tree.items()[child & ~Tree::kItemFlag];
  }

  /// Returns whether B's group is opened next; one of the two is a node.
  bool opensB(Slot slot_a, Slot slot_b) const {
    return isItem(a.child(slot_a)) || (!isItem(b.child(slot_b)) && breadth(b, slot_b) >= breadth(a, slot_a));
  }

  /// Compares a group of A with four parts of one of B, and the other way round.
  ConeReasons withPartsOfB(Slot kept, Slot first) {
    return coneReasons(partsOf(b, first), comparedA(kept), limits_b_);
  }
  ConeReasons withPartsOfA(Slot first, Slot kept) {
    return coneReasons(partsOf(a, first), comparedB(kept), limits_a_);
  }

  /// Compares four pairs (slot of A, slot of B), of which A's are the kept groups.
  ConeReasons ofPairs(const std::pair<Slot, Slot>* pairs) const {
    const auto& of_a = a.groups();
    const auto& of_b = b.groups();
    const ComparedCone<ConeLanes> kept =
        coneLanes(of_a[pairs[0].first], of_a[pairs[1].first], of_a[pairs[2].first], of_a[pairs[3].first]);
    const ComparedCone<ConeLanes> others =
        coneLanes(of_b[pairs[0].second], of_b[pairs[1].second], of_b[pairs[2].second], of_b[pairs[3].second]);
    return coneReasons(others, movedToB(kept), limits_b_);
  }
  void prefetch(const std::pair<Slot, Slot>& pair) const {
    for (const Tree::Group* group : {&a.groups()[pair.first], &b.groups()[pair.second]}) {
      __builtin_prefetch(group);
      __builtin_prefetch(&group->child);
    }
  }

 private:
  /// Returns how much a child leaves open, in metres: the turn of its normals counts like the turn of
  /// directions.
  static double breadth(const Tree& tree, Slot slot) {
    const Tree::Group& group = tree.groups()[slot];
    return tree.unit() * group.radius * (1.5 - group.cosine);
  }

  static Eigen::Vector3d vectorOf(const float (&numbers)[3]) { return {numbers[0], numbers[1], numbers[2]}; }

  static ComparedCone<ConeLanes> partsOf(const Tree& tree, Slot first) {
    const Tree::Group* parts = &tree.groups()[first];
    return coneLanes(parts[0], parts[1], parts[2], parts[3]);
  }

  static ComparedCone<float> compared(const Tree::Group& group, const Tree& from, const Tree& to,
                                      const Eigen::Vector3d& centre, const Eigen::Vector3d& axis) {
    const Eigen::Vector3d in_units = centre / to.unit();
    return {{static_cast<float>(in_units.x()), static_cast<float>(in_units.y()),
             static_cast<float>(in_units.z())},
            static_cast<float>(group.radius * (from.unit() / to.unit())),
            {static_cast<float>(axis.x()), static_cast<float>(axis.y()), static_cast<float>(axis.z())},
            group.angle,
            group.cosine,
            group.sine};
  }

  /// Returns a group of A in B's frame, and keeps the last one.
  const ComparedCone<float>& comparedA(Slot slot) {
    if (slot != compared_slot_a_) {
      const Tree::Group& group = a.groups()[slot];
      const Eigen::Vector3d centre = a.unit() * vectorOf(group.centre);
      compared_a_ = compared(group, a, b, turned_ * (centre - frame_.offset), turned_ * vectorOf(group.axis));
      compared_slot_a_ = slot;
    }
    return compared_a_;
  }
  const ComparedCone<float>& comparedB(Slot slot) {
    if (slot != compared_slot_b_) {
      const Tree::Group& group = b.groups()[slot];
      const Eigen::Vector3d centre = b.unit() * vectorOf(group.centre);
      compared_b_ = compared(group, b, a, frame_.rotation * centre + frame_.offset,
                             frame_.rotation * vectorOf(group.axis));
      compared_slot_b_ = slot;
    }
    return compared_b_;
  }

  /// Returns groups of A in B's frame and unit, in single precision.
  ComparedCone<ConeLanes> movedToB(const ComparedCone<ConeLanes>& cone) const {
    const auto turned = [this](const ConeLanes(&of)[3], int row) {
      return ConeLanes(axes_of_a_[row][0] * of[0] + axes_of_a_[row][1] * of[1] + axes_of_a_[row][2] * of[2]);
    };
    const ConeLanes centre[3] = {scale_ * cone.centre[0], scale_ * cone.centre[1], scale_ * cone.centre[2]};
    return {{turned(centre, 0) + offset_of_a_[0], turned(centre, 1) + offset_of_a_[1],
             turned(centre, 2) + offset_of_a_[2]},
            scale_ * cone.radius,
            {turned(cone.axis, 0), turned(cone.axis, 1), turned(cone.axis, 2)},
            cone.angle,
            cone.cosine,
            cone.sine};
  }

  const PairFrame& frame_;

 public:
  const Tree& a;
  const Tree& b;

 private:
  ConeLimits limits_a_;  ///< for comparisons with A's nodes
  ConeLimits limits_b_;
  Eigen::Matrix3d turned_;  ///< from A's axes to B's
  float scale_;             ///< from A's unit to B's
  float axes_of_a_[3][3];   ///< of turned_
  float offset_of_a_[3];    ///< of A's origin, in B's unit
  ComparedCone<float> compared_a_{};
  ComparedCone<float> compared_b_{};
  Slot compared_slot_a_ = Tree::kNoChild;
  Slot compared_slot_b_ = Tree::kNoChild;
};

}  // namespace concave_distance::detail
