#include "concave_distance/contact/effect_settings.h"

#include "concave_distance/base/error.h"

namespace concave_distance {

void EffectSettings::validate(const std::string& where) const {
  if (normal_force) normal_force->validate(where + ".normal_force");
  if (friction.model != FrictionModel::None && !normal_force) {
    throw Error(where + ".friction", "friction is asked for without a normal force",
                "add normal_force, or leave friction out");
  }
  friction.validate(where + ".friction");
}

std::string_view toString(EffectStage stage) {
  switch (stage) {
    case EffectStage::Interference:
      return "interference";
    case EffectStage::Identity:
      return "identity";
    case EffectStage::NormalForce:
      return "normal_force";
    case EffectStage::Friction:
      return "friction";
  }
  return "unknown";
}

EffectPlan::EffectPlan(const EffectSettings& settings) {
  if (!settings.any()) return;
  stages_[count_++] = EffectStage::Interference;
  stages_[count_++] = EffectStage::Identity;
  if (settings.normal_force) stages_[count_++] = EffectStage::NormalForce;
  if (settings.friction.model != FrictionModel::None) stages_[count_++] = EffectStage::Friction;
}

}  // namespace concave_distance
