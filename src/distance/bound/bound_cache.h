#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "box_pair_bounds.h"
#include "mesh/trees/bounding_volume_hierarchy.h"

namespace concave_distance {

namespace detail {
class BranchAndBound;
}

/// Keeps where the last proof of one pair's distance ended: every pair of boxes, or of leaves, that was shown
/// to be far enough apart, with its bound. Moving by x brings no pair closer by more than x, so that a bound
/// is good until the bodies have come as far: kept as the bound plus how far the subtree of B has moved
/// altogether (its moved distance), it is compared with that moved distance now. What has run out is opened
/// again. Belongs to one pair of bodies; the caller clears it when the bodies change.
class BoundCache {
 public:
  /// Holds the bounds of the children of one box against one other box.
  struct Quad {
    double bound[BoundingVolumeHierarchy::kWidth];  ///< metres plus moved distance; infinite: opened further,
                                                    ///< or none
    BoundingVolumeHierarchy::Slot kept;
    std::uint32_t opened;  ///< node of the other body
    std::uint8_t subtree;  ///< of B
    bool opens_b;
    bool by_boxes;  ///< all were parted by their boxes, along directions of their own
  };
  struct LeafPair {
    double bound;
    BoundingVolumeHierarchy::Slot a;
    BoundingVolumeHierarchy::Slot b;
    std::uint8_t subtree;
    Eigen::Vector3d direction;  ///< from A to B, A's axes
  };

  void clear() { valid_ = false; }
  /// Returns false when the next proof must begin at the roots.
  bool valid() const { return valid_; }
  std::size_t size() const { return quads_.size() + leaf_pairs_.size(); }

 private:
  friend class detail::BranchAndBound;

  bool isAt(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& offset) const {
    return rotation == rotation_ && offset == offset_;
  }
  /// Adds the motion to a pose to the moved distances; rotation and offset as in the proof's local frames.
  /// `rounding` (metres) is what the displacement itself may be off.
  void advance(const BoundingVolumeHierarchy& b, const Eigen::Matrix3d& rotation,
               const Eigen::Vector3d& offset, double rounding);
  void begin(const BoundingVolumeHierarchy& b, const Eigen::Matrix3d& rotation,
             const Eigen::Vector3d& offset);
  /// Decides after a proof whether the next one uses the cache, begins it anew or does without for a while.
  void decide(bool began_anew, std::uint32_t opened);

  std::vector<Quad> quads_;
  std::vector<detail::LaneDirections> directions_;  ///< along which each quad was parted
  std::vector<LeafPair> leaf_pairs_;
  std::vector<double> moved_distances_;  ///< metres, of each subtree of B
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();
  bool valid_ = false;
  std::uint32_t opened_at_begin_ = 0;
  std::size_t size_at_begin_ = 0;
  std::uint32_t wait_ = 0;  ///< proofs to do without
  std::uint32_t next_wait_ = 1;
};

}  // namespace concave_distance
