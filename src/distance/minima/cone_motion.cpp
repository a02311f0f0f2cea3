#include "cone_motion.h"

#include <algorithm>
#include <cmath>

namespace concave_distance::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A clock may run 2^18 sizes or radians until it is full.
constexpr double kQuantaPerUnit = 0x1.0p44;
constexpr std::uint64_t kFull = std::uint64_t{1} << 62U;
/// Of the sizes and displacements that a clock adds: a few roundings.
constexpr double kRounding = 0x1.0p-48;
/// The shortest lever over the frame's size.
constexpr double kShortestLever = 1.0 / 64.0;
/// Share of the last cycle in the rates.
constexpr double kRateShare = 0.3;
/// Before the first motion: metres for a radian, over the size.
constexpr double kSizesPerRadian = 0.3;
/// What a clock is taken to run at least, as a share of the fastest: none stands still for ever.
constexpr double kLeastRate = 1e-3;

}  // namespace

void ConeMotion::begin(const NormalConeTree& a, const NormalConeTree& b, const PairFrame& frame,
                       double size) {
  a_ = &a;
  b_ = &b;
  rotation_ = frame.rotation;
  offset_ = frame.offset;
  quanta_per_metre_ = kQuantaPerUnit / size;
  rounding_ = kRounding * size;
  levers_[0] = 0.0;
  for (std::size_t k = 1; k < kLeverCount; ++k)
    levers_[k] = kShortestLever * size * std::ldexp(1.0, 2 * (static_cast<int>(k) - 1));
  first_of_b_ = 1 + static_cast<std::uint32_t>(a.subtrees().size() * kLeverCount);
  const std::size_t count = first_of_b_ + b.subtrees().size() * kLeverCount;
  quanta_.assign(count, 0);
  if (rates_.size() != count) {
    rates_.assign(count, kSizesPerRadian * size);
    rates_[kTurnClock] = 1.0;
  }
  updateRates();
}

double ConeMotion::quantaPer(std::uint32_t clock) const {
  return clock == kTurnClock ? kQuantaPerUnit : quanta_per_metre_;
}

void ConeMotion::updateRates() {
  const double fastest = *std::max_element(rates_.begin() + 1, rates_.end());
  rates_[kTurnClock] = std::max(rates_[kTurnClock], 1e-12);
  for (std::size_t clock = 1; clock < rates_.size(); ++clock) {
    rates_[clock] = std::max(rates_[clock], kLeastRate * fastest);
  }
  cycles_per_unit_.resize(rates_.size());
  for (std::size_t clock = 0; clock < rates_.size(); ++clock) cycles_per_unit_[clock] = 1.0 / rates_[clock];
}

std::uint64_t ConeMotion::expiryAfter(std::uint32_t clock, double slack) const {
  const double quanta = slack * quantaPer(clock);
  const std::uint64_t room = kFull - quanta_[clock];
  return quanta < static_cast<double>(room) ? quanta_[clock] + static_cast<std::uint64_t>(quanta) : kFull;
}

bool ConeMotion::run(std::uint32_t clock, double by) {
  rates_[clock] += kRateShare * (by - rates_[clock]);
  const double quanta = by * quantaPer(clock);
  if (!(quanta < static_cast<double>(kFull - quanta_[clock]))) return false;
  quanta_[clock] += static_cast<std::uint64_t>(quanta) + 1;
  return true;
}

bool ConeMotion::advance(const PairFrame& frame) {
  const Matrix3d turn = frame.rotation - rotation_;
  const Vector3d shift = frame.offset - offset_;
  if (turn.isZero(0.0) && shift.isZero(0.0)) return true;
  // The largest stretch of a difference of two rotations by an angle t is 2 sin(t / 2): its Frobenius norm
  // over sqrt(2).
  const double stretch = turn.norm() * 0.70710678118654757;
  const double radians = 2.0 * std::asin(std::min(1.0, 0.5 * stretch)) + kRounding;
  bool has_room = run(kTurnClock, radians);
  const Matrix3d turn_in_b = frame.rotation.transpose() - rotation_.transpose();
  const Vector3d shift_in_b = rotation_.transpose() * offset_ - frame.rotation.transpose() * frame.offset;
  const auto run_regions = [&](const NormalConeTree& tree, std::uint32_t first, const Matrix3d& difference,
                               const Vector3d& by) {
    for (std::size_t region = 0; region < tree.subtrees().size(); ++region) {
      const NormalConeTree::Subtree& of = tree.subtrees()[region];
      const double metres = (difference * of.centre + by).norm() + stretch * of.arm + rounding_;
      for (std::size_t k = 0; k < kLeverCount; ++k) {
        const auto clock = first + static_cast<std::uint32_t>(region * kLeverCount + k);
        has_room = run(clock, metres + radians * levers_[k]) && has_room;
      }
    }
  };
  run_regions(*a_, 1, turn_in_b, shift_in_b);
  run_regions(*b_, first_of_b_, turn, shift);
  updateRates();
  rotation_ = frame.rotation;
  offset_ = frame.offset;
  return has_room;
}

}  // namespace concave_distance::detail
