#include "tree_pair_bounds.h"

namespace concave_distance::detail {
namespace {

using Hierarchy = BoundingVolumeHierarchy;

/// Weighs the squared distance of two boxes' centres against their squared bound, to find the nearer child.
constexpr double kWeightOfCentres = 0.1;

}  // namespace

TreePairBounds::TreePairBounds(const ProofFrame& frame, const NearestTriangles& nearest,
                               CertificateWorkspace& workspace, CertificateCost& cost)
    : a_(frame.a.hierarchy()),
      b_(frame.b.hierarchy()),
      frame_(frame),
      nearest_(nearest),
      cost_(cost),
      unit_a_(static_cast<float>(a_.reach() * frame.scale.inverse_scale)),
      unit_b_(static_cast<float>(b_.reach() * frame.scale.inverse_scale)),
      single_a_from_b_(frame.rotation, frame.offset * frame.scale.inverse_scale),
      single_b_from_a_(frame.turned, frame.turned * frame.offset * -frame.scale.inverse_scale),
      support_a_(a_, workspace.support_a),
      support_b_(b_, workspace.support_b) {}

Lanes TreePairBounds::squaredBounds(Slot kept, std::uint32_t opened, bool opens_b,
                                    LaneDirections* directions) {
  cost_.box_bounds += static_cast<std::uint32_t>(Hierarchy::kWidth);
  const std::uint32_t node = kept / Hierarchy::kWidth;
  const std::uint32_t lane = kept % Hierarchy::kWidth;
  if (opens_b) {
    if (kept != compared_slot_a_) {
      compared_a_ = ComparedBox(a_.singleNodes()[node], lane, unit_a_, single_b_from_a_);
      compared_slot_a_ = kept;
    }
    return detail::squaredBounds(b_.singleNodes()[opened], compared_a_, unit_b_, directions).cast<double>() *
           frame_.scale.squared_scale;
  }
  if (kept != compared_slot_b_) {
    compared_b_ = ComparedBox(b_.singleNodes()[node], lane, unit_b_, single_a_from_b_);
    compared_slot_b_ = kept;
  }
  return detail::squaredBounds(a_.singleNodes()[opened], compared_b_, unit_a_, directions).cast<double>() *
         frame_.scale.squared_scale;
}

Lanes TreePairBounds::separationsAlong(const LaneDirections& directions, Slot kept, bool opens_b) const {
  const std::uint32_t node = kept / Hierarchy::kWidth;
  const std::uint32_t lane = kept % Hierarchy::kWidth;
  const FloatLanes found =
      opens_b ? separations(directions, unit_b_, a_.singleNodes()[node], lane, unit_a_, single_b_from_a_)
              : separations(directions, unit_a_, b_.singleNodes()[node], lane, unit_b_, single_a_from_b_);
  return found.cast<double>() * frame_.scale.scale;
}

std::uint32_t TreePairBounds::nearestChild(Slot kept, std::uint32_t opened, bool opens_b) {
  const Lanes bounds = squaredBounds(kept, opened, opens_b, nullptr);
  const Hierarchy::SingleNode& node = (opens_b ? b_ : a_).singleNodes()[opened];
  const FloatLanes gaps = squaredGaps(node, opens_b ? compared_a_ : compared_b_, opens_b ? unit_b_ : unit_a_);
  const Lanes keys = bounds + kWeightOfCentres * frame_.scale.squared_scale * gaps.cast<double>();
  std::uint32_t nearest = 0;
  for (std::uint32_t lane = 1; lane < Hierarchy::kWidth; ++lane) {
    if (node.child[lane] != Hierarchy::kNoChild && keys[lane] < keys[nearest]) nearest = lane;
  }
  return nearest;
}

void TreePairBounds::takeDirection() {
  direction_count_ = nearest_.directionCount();
  const Eigen::Vector3d& direction = nearest_.direction();
  offset_along_ = direction.dot(frame_.offset);
  // Boxes of flat pieces may reach this far beyond their plane.
  const double tie = 0.375 * frame_.error;
  support_a_.setDirection(direction, direction.dot(nearest_.closest().point_a) + tie);
  support_b_.setDirection(-(frame_.turned * direction),
                          offset_along_ - direction.dot(nearest_.closest().point_b) + tie);
}

}  // namespace concave_distance::detail
