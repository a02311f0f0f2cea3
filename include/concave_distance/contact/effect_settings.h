#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "concave_distance/contact/friction.h"
#include "concave_distance/contact/normal_force.h"

namespace concave_distance {

/// Says what a pair asks for beyond distance and niches (doc/effects.md): nothing by default.
struct EffectSettings {
  bool interference = false;                        ///< the regions where the bodies overlap
  std::optional<NormalForceSettings> normal_force;  ///< a force at each region; brings interference with it
  FrictionSettings friction;                        ///< beside a normal force only

  bool any() const { return interference || normal_force.has_value(); }
  /// @throws Error naming the effect or the parameter, the value seen and what is allowed
  void validate(const std::string& where) const;
};

inline bool operator==(const EffectSettings& l, const EffectSettings& r) {
  return l.interference == r.interference && l.normal_force == r.normal_force && l.friction == r.friction;
}
inline bool operator!=(const EffectSettings& l, const EffectSettings& r) {
  return !(l == r);
}

/// Names what is done about a pair's contacts, in the order in which it is done.
enum class EffectStage : std::uint8_t {
  Interference,  ///< once the certificate allows contact
  Identity,      ///< regions to niches and to the last cycle's regions; where there are regions
  NormalForce,   ///< where there are regions
  Friction       ///< where a region is under load
};
inline constexpr std::size_t kEffectStages = 4;
std::string_view toString(EffectStage stage);

/// The stages that a pair's settings call for, made once; a stage that is not asked for is not in it.
class EffectPlan {
 public:
  EffectPlan() = default;
  explicit EffectPlan(const EffectSettings& settings);
  bool empty() const { return count_ == 0; }
  const EffectStage* begin() const { return stages_.data(); }
  const EffectStage* end() const { return stages_.data() + count_; }

 private:
  std::array<EffectStage, kEffectStages> stages_{};
  std::size_t count_ = 0;
};

/// Counts how often each stage ran and adds up what it took, by EffectStage.
struct EffectCounts {
  std::array<std::uint64_t, kEffectStages> runs{};
  std::array<double, kEffectStages> seconds{};

  EffectCounts& operator+=(const EffectCounts& other) {
    for (std::size_t stage = 0; stage < kEffectStages; ++stage) {
      runs[stage] += other.runs[stage];
      seconds[stage] += other.seconds[stage];
    }
    return *this;
  }
};

}  // namespace concave_distance
