#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/side.h"
#include "distance/kernels/pair_frame.h"
#include "mesh/trees/normal_cone_tree.h"

namespace concave_distance::detail {

/// Adds up how far the bodies have moved since begin(): how far they have turned against each other
/// (radians), and how far each subtree of each body has moved as seen from the other (metres), alone or with
/// the turn times a radius. What holds with some slack holds until the moved distance that can change it has
/// grown by the slack. Moved distances never shrink; they are whole numbers of small counts, so that adding
/// is exact.
class MovedDistances {
 public:
  /// The radii are 0 and then powers of four times the frame's size.
  static constexpr std::size_t kRadiusCount = 8;
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr std::uint32_t kTurn = 0;

  /// @param size metres, of both bodies and the gap between them
  void begin(const NormalConeTree& a, const NormalConeTree& b, const PairFrame& frame, double size);

  /// Adds the motion to a new pose. Returns false when a moved distance has no room for more: begin anew.
  bool advance(const PairFrame& frame);

  void forgetRates() { rates_.clear(); }

  std::size_t size() const { return counts_.size(); }
  std::uint64_t now(std::uint32_t index) const { return counts_[index]; }

  /// Returns the index of what the centre of an item or group moves by as seen from the other body, plus the
  /// turn times radius `rank`.
  std::uint32_t indexOf(Side side, std::uint32_t subtree, std::uint32_t rank) const {
    return firstOf(side) + subtree * static_cast<std::uint32_t>(kRadiusCount) + rank;
  }
  double radius(std::uint32_t rank) const { return radii_[rank]; }

  /// Returns the count at which a slack (radians or metres) is used up.
  std::uint64_t expiryAfter(std::uint32_t index, double slack) const;

  /// Returns the cycles that a slack is expected to last at the latest rate.
  double cyclesOf(std::uint32_t index, double slack) const { return slack * cycles_per_unit_[index]; }

 private:
  std::uint32_t firstOf(Side side) const { return side == Side::A ? 1 : first_of_b_; }
  double countsPer(std::uint32_t index) const;
  /// Adds radians or metres to a moved distance, and returns whether there was room for them.
  bool add(std::uint32_t index, double by);
  void updateRates();

  const NormalConeTree* a_ = nullptr;
  const NormalConeTree* b_ = nullptr;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d offset_;
  std::array<double, kRadiusCount> radii_{};  ///< metres
  double counts_per_metre_ = 1.0;
  double rounding_ = 0.0;  ///< metres, of a displacement
  std::uint32_t first_of_b_ = 1;
  std::vector<std::uint64_t> counts_;
  std::vector<double> rates_;  ///< radians or metres a cycle
  std::vector<double> cycles_per_unit_;
};

}  // namespace concave_distance::detail
