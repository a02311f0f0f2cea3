#include "concave_distance/ros/followed_effects.h"

#include <utility>

#include "concave_distance/contact/motion_between.h"
#include "concave_distance/ros/time_difference.h"

namespace concave_distance {

FollowedEffects::FollowedEffects(std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
                                 const ContactMaterial& material)
    : mesh_a_(std::move(a)), mesh_b_(std::move(b)), material_(material) {}

bool FollowedEffects::prepare(const EffectSettings& settings, bool wanted) {
  if (!wanted || !settings.any()) {
    effects_.reset();
    contacts_ = {};
    told_ = {};
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

void FollowedEffects::update(const PairSolution& solution, const Eigen::Isometry3d& a_from_b, ros::Time stamp,
                             WorkLimit& limit) {
  if (!effects_) {
    return;
  }
  const double step = has_pose_ ? secondsBetween(last_stamp_, stamp) : 0.0;
  // The same stamp once more, for other settings: the velocity of that time still holds.
  if (!has_pose_ || step != 0.0) {
    b_in_a_ = motionBetween(last_a_from_b_, a_from_b, step);
  }
  effects_->update(solution, a_from_b, b_in_a_, step > 0.0 ? step : 0.0, contacts_, &limit);
  has_pose_ = true;
  last_a_from_b_ = a_from_b;
  last_stamp_ = stamp;
}

void FollowedEffects::reset() {
  has_pose_ = false;
  if (effects_) {
    effects_->reset();
  }
}

EffectCounts FollowedEffects::takeCounts() {
  EffectCounts counts;
  if (!effects_) {
    return counts;
  }
  for (std::size_t stage = 0; stage < kEffectStages; ++stage) {
    counts.runs[stage] = effects_->counts().runs[stage] - told_.runs[stage];
    counts.seconds[stage] = effects_->counts().seconds[stage] - told_.seconds[stage];
  }
  told_ = effects_->counts();
  return counts;
}

}  // namespace concave_distance
