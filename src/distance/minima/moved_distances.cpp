#include "moved_distances.h"

#include <algorithm>
#include <cmath>

#include "distance/kernels/pair_motion.h"

namespace concave_distance::detail {
namespace {

/// A moved distance has room for 2^18 sizes or radians.
constexpr double kCountsPerUnit = 0x1.0p44;
constexpr std::uint64_t kFull = std::uint64_t{1} << 62U;
/// The rounding of a displacement over the size: a few machine epsilons.
constexpr double kRounding = 0x1.0p-48;
/// The smallest radius above 0, over the frame's size.
constexpr double kSmallestRadius = 1.0 / 64.0;
/// The share that the last cycle has in the rates.
constexpr double kRateShare = 0.3;
/// Before the first motion, a radian is taken to come with so many metres, over the size.
constexpr double kSizesPerRadian = 0.3;
/// A moved distance is taken to grow at this share of the fastest rate at least: none rests for ever.
constexpr double kLeastRate = 1e-3;

}  // namespace

void MovedDistances::begin(const NormalConeTree& a, const NormalConeTree& b, const PairFrame& frame,
                           double size) {
  a_ = &a;
  b_ = &b;
  rotation_ = frame.rotation;
  offset_ = frame.offset;
  counts_per_metre_ = kCountsPerUnit / size;
  rounding_ = kRounding * size;
  radii_[0] = 0.0;
  for (std::size_t k = 1; k < kRadiusCount; ++k)
    radii_[k] = kSmallestRadius * size * std::ldexp(1.0, 2 * (static_cast<int>(k) - 1));
  first_of_b_ = 1 + static_cast<std::uint32_t>(a.subtrees().size() * kRadiusCount);
  const std::size_t count = first_of_b_ + b.subtrees().size() * kRadiusCount;
  counts_.assign(count, 0);
  if (rates_.size() != count) {
    rates_.assign(count, kSizesPerRadian * size);
    rates_[kTurn] = 1.0;
  }
  updateRates();
}

double MovedDistances::countsPer(std::uint32_t index) const {
  return index == kTurn ? kCountsPerUnit : counts_per_metre_;
}

void MovedDistances::updateRates() {
  const double fastest = *std::max_element(rates_.begin() + 1, rates_.end());
  rates_[kTurn] = std::max(rates_[kTurn], 1e-12);
  for (std::size_t index = 1; index < rates_.size(); ++index) {
    rates_[index] = std::max(rates_[index], kLeastRate * fastest);
  }
  cycles_per_unit_.resize(rates_.size());
  for (std::size_t index = 0; index < rates_.size(); ++index) cycles_per_unit_[index] = 1.0 / rates_[index];
}

std::uint64_t MovedDistances::expiryAfter(std::uint32_t index, double slack) const {
  const double counts = slack * countsPer(index);
  const std::uint64_t room = kFull - counts_[index];
  return counts < static_cast<double>(room) ? counts_[index] + static_cast<std::uint64_t>(counts) : kFull;
}

bool MovedDistances::add(std::uint32_t index, double by) {
  rates_[index] += kRateShare * (by - rates_[index]);
  const double counts = by * countsPer(index);
  if (!(counts < static_cast<double>(kFull - counts_[index]))) return false;
  counts_[index] += static_cast<std::uint64_t>(counts) + 1;
  return true;
}

bool MovedDistances::advance(const PairFrame& frame) {
  const PairMotion of_b(rotation_, offset_, frame.rotation, frame.offset, rounding_);
  if (of_b.isStill()) return true;
  const PairMotion of_a(rotation_.transpose(), -(rotation_.transpose() * offset_), frame.rotation.transpose(),
                        -(frame.rotation.transpose() * frame.offset), rounding_);
  const double radians = of_b.angle() + kRounding;
  bool has_room = add(kTurn, radians);
  const auto add_subtrees = [&](const NormalConeTree& tree, std::uint32_t first, const PairMotion& motion) {
    for (std::size_t subtree = 0; subtree < tree.subtrees().size(); ++subtree) {
      const NormalConeTree::Subtree& of = tree.subtrees()[subtree];
      const double metres = motion.largestWithin(of.centre, of.arm);
      for (std::size_t k = 0; k < kRadiusCount; ++k) {
        const auto index = first + static_cast<std::uint32_t>(subtree * kRadiusCount + k);
        has_room = add(index, metres + radians * radii_[k]) && has_room;
      }
    }
  };
  add_subtrees(*a_, 1, of_a);
  add_subtrees(*b_, first_of_b_, of_b);
  updateRates();
  rotation_ = frame.rotation;
  offset_ = frame.offset;
  return has_room;
}

}  // namespace concave_distance::detail
