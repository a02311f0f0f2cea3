#include "concave_distance/scene/tracked_effects.h"

#include <utility>

#include "contact/motion_between.h"

namespace concave_distance {

TrackedEffects::TrackedEffects(std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
                               const ContactMaterial& material)
    : mesh_a_(std::move(a)), mesh_b_(std::move(b)), material_(material) {}

bool TrackedEffects::prepare(const EffectSettings& settings, bool wanted) {
  if (!wanted || !settings.any()) {
    effects_.reset();
    contacts_ = {};
    reported_ = {};
    has_pose_ = false;
    return false;
  }
  if (!effects_) {
    effects_ = std::make_unique<PairEffects>(mesh_a_, mesh_b_, settings, material_);
    return true;
  }
  if (effects_->settings() != settings) {
    effects_->setSettings(settings, material_);
    return true;
  }
  return false;
}

void TrackedEffects::update(const PairSolution& solution, double step,
                            const std::optional<RelativeTwist>& b_in_a, WorkLimit& limit) {
  if (!effects_) {
    return;
  }
  if (b_in_a) {
    b_in_a_ = *b_in_a;
  } else if (!has_pose_ || step != 0.0) {
    // At the same time once more, for other settings, the velocity of that time still holds.
    b_in_a_ = has_pose_ ? motionBetween(last_a_from_b_, solution.a_from_b, step) : RelativeTwist{};
  }
  const bool forward = step > 0.0 && (has_pose_ || b_in_a);
  effects_->update(solution, b_in_a_, forward ? step : 0.0, contacts_, &limit);
  has_pose_ = true;
  last_a_from_b_ = solution.a_from_b;
}

void TrackedEffects::forgetAnswer() {
  std::vector<ContactRegion> regions = std::move(contacts_.regions);
  regions.clear();
  contacts_ = {};
  contacts_.regions = std::move(regions);
}

void TrackedEffects::reset() {
  has_pose_ = false;
  if (effects_) {
    effects_->reset();
  }
}

void TrackedEffects::keep() {
  if (effects_) effects_->keep();
}

void TrackedEffects::goBack() {
  if (effects_) effects_->goBack();
}

EffectCounts TrackedEffects::takeCounts() {
  EffectCounts counts;
  if (!effects_) {
    return counts;
  }
  for (std::size_t stage = 0; stage < kEffectStages; ++stage) {
    counts.runs[stage] = effects_->counts().runs[stage] - reported_.runs[stage];
    counts.seconds[stage] = effects_->counts().seconds[stage] - reported_.seconds[stage];
  }
  reported_ = effects_->counts();
  return counts;
}

}  // namespace concave_distance
