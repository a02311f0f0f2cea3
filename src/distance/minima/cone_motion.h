#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/side.h"
#include "distance/kernels/pair_frame.h"
#include "mesh/trees/normal_cone_tree.h"

namespace concave_distance::detail {

/// Clocks of a motion, which never run back: how far the bodies have turned against each other (radians), and
/// how far each region of each body has moved as seen from the other (metres), alone or with the turn times a
/// lever. What holds with some slack holds until the clock that can change it has run on by the slack. All
/// clocks count quanta.
class ConeMotion {
 public:
  /// Levers of the combined clocks: 0, then powers of four times the frame's size.
  static constexpr std::size_t kLeverCount = 8;
  static constexpr std::uint32_t kNoClock = 0xffffffffU;
  static constexpr std::uint32_t kTurnClock = 0;

  /// @param size metres, of both bodies and the gap between them
  void begin(const NormalConeTree& a, const NormalConeTree& b, const PairFrame& frame, double size);

  /// Lets the clocks run to a new pose. False when they have run too far: begin anew.
  bool advance(const PairFrame& frame);

  void forgetRates() { rates_.clear(); }

  std::size_t clockCount() const { return quanta_.size(); }
  std::uint64_t now(std::uint32_t clock) const { return quanta_[clock]; }

  /// Of the motion of an item's or group's centre as seen from the other body, plus the turn times lever
  /// `rank`.
  std::uint32_t clockOf(Side side, std::uint32_t region, std::uint32_t rank) const {
    return firstClock(side) + region * static_cast<std::uint32_t>(kLeverCount) + rank;
  }
  double lever(std::uint32_t rank) const { return levers_[rank]; }

  /// When a slack (radians or metres) is used up, by a clock's quanta.
  std::uint64_t expiryAfter(std::uint32_t clock, double slack) const;

  /// Cycles that a slack is expected to last, by how fast the clock has run lately.
  double cyclesOf(std::uint32_t clock, double slack) const { return slack * cycles_per_unit_[clock]; }

 private:
  std::uint32_t firstClock(Side side) const { return side == Side::A ? 1 : first_of_b_; }
  double quantaPer(std::uint32_t clock) const;
  /// @return whether there is room for more
  bool run(std::uint32_t clock, double by);
  void updateRates();

  const NormalConeTree* a_ = nullptr;
  const NormalConeTree* b_ = nullptr;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d offset_;
  std::array<double, kLeverCount> levers_{};  ///< metres
  double quanta_per_metre_ = 1.0;
  double rounding_ = 0.0;  ///< metres, of a displacement
  std::uint32_t first_of_b_ = 1;
  std::vector<std::uint64_t> quanta_;
  std::vector<double> rates_;  ///< radians or metres a cycle
  std::vector<double> cycles_per_unit_;
};

/// The slack that is expected to last longest.
class SlackOffers {
 public:
  explicit SlackOffers(const ConeMotion& motion) : motion_(motion) {}

  void reset(std::uint32_t region_of_a, std::uint32_t region_of_b) {
    regions_ = {region_of_a, region_of_b};
    cycles_ = 0.0;
    clock_ = ConeMotion::kNoClock;
  }
  void offerTurn(double radians) { offer(ConeMotion::kTurnClock, radians); }
  /// Of the motion of one body's centre as seen from the other body plus the turn times a lever.
  void offerMotion(Side side, double metres, double lever = 0.0) {
    if (!(metres > 0.0) || !(lever < kLongest)) return;
    std::uint32_t rank = 0;
    while (rank + 1 < ConeMotion::kLeverCount && motion_.lever(rank) < lever) ++rank;
    const std::uint32_t region = regions_[static_cast<std::size_t>(side)];
    const auto with = [&](std::uint32_t r) {
      // A motion plus the turn times a longer lever is at most so many times the one with a shorter lever.
      const double share = motion_.lever(r) < lever ? motion_.lever(r) / lever : 1.0;
      offer(motion_.clockOf(side, region, r), share * metres);
    };
    with(rank);
    if (rank > 1) with(rank - 1);
  }

  bool empty() const { return clock_ == ConeMotion::kNoClock; }
  std::uint32_t clock() const { return clock_; }
  std::uint64_t expiry() const { return motion_.expiryAfter(clock_, slack_); }

 private:
  void offer(std::uint32_t clock, double slack) {
    const double cycles = motion_.cyclesOf(clock, slack);
    if (!(cycles > cycles_)) return;
    cycles_ = cycles;
    clock_ = clock;
    slack_ = slack;
  }

  static constexpr double kLongest = 1e100;  ///< metres

  const ConeMotion& motion_;
  std::array<std::uint32_t, 2> regions_{};
  double cycles_ = 0.0;
  double slack_ = 0.0;
  std::uint32_t clock_ = ConeMotion::kNoClock;
};

}  // namespace concave_distance::detail
