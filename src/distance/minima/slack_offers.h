#pragma once

#include <array>
#include <cstdint>

#include "moved_distances.h"

namespace concave_distance::detail {

/// Chooses, of all slacks that are offered for a pair of groups or features, the one that is expected to last
/// longest.
class SlackOffers {
 public:
  explicit SlackOffers(const MovedDistances& motion) : motion_(motion) {}

  void reset(std::uint32_t subtree_of_a, std::uint32_t subtree_of_b) {
    subtrees_ = {subtree_of_a, subtree_of_b};
    cycles_ = 0.0;
    index_ = MovedDistances::kNone;
  }
  void offerTurn(double radians) { offer(MovedDistances::kTurn, radians); }
  /// Offers a slack against the motion of one body's centre as seen from the other body plus the turn times a
  /// radius (metres).
  void offerMotion(Side side, double metres, double radius = 0.0) {
    if (!(metres > 0.0) || !(radius < kLongest)) return;
    std::uint32_t rank = 0;
    while (rank + 1 < MovedDistances::kRadiusCount && motion_.radius(rank) < radius) ++rank;
    const std::uint32_t subtree = subtrees_[static_cast<std::size_t>(side)];
    const auto with = [&](std::uint32_t r) {
      // A motion plus the turn times a larger radius is at most so many times the one with a smaller radius.
      const double share = motion_.radius(r) < radius ? motion_.radius(r) / radius : 1.0;
      offer(motion_.indexOf(side, subtree, r), share * metres);
    };
    with(rank);
    if (rank > 1) with(rank - 1);
  }

  bool empty() const { return index_ == MovedDistances::kNone; }
  /// Returns the index of the moved distance that the best slack counts on.
  std::uint32_t movedDistance() const { return index_; }
  std::uint64_t expiry() const { return motion_.expiryAfter(index_, slack_); }

 private:
  void offer(std::uint32_t index, double slack) {
    const double cycles = motion_.cyclesOf(index, slack);
    if (!(cycles > cycles_)) return;
    cycles_ = cycles;
    index_ = index;
    slack_ = slack;
  }

  static constexpr double kLongest = 1e100;  ///< metres

  const MovedDistances& motion_;
  std::array<std::uint32_t, 2> subtrees_{};
  double cycles_ = 0.0;
  double slack_ = 0.0;
  std::uint32_t index_ = MovedDistances::kNone;
};

}  // namespace concave_distance::detail
