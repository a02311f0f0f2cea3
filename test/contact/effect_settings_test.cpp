#include "concave_distance/contact/effect_settings.h"

#include <gtest/gtest.h>

#include <vector>

#include "concave_distance/base/error.h"

namespace concave_distance::effect_settings_test {
namespace {

std::vector<EffectStage> stagesOf(const EffectSettings& settings) {
  const EffectPlan plan(settings);
  return {plan.begin(), plan.end()};
}

TEST(EffectPlan, HasNoStageThatNobodyAsksFor) {
  EffectSettings settings;
  EXPECT_TRUE(EffectPlan(settings).empty());
  settings.interference = true;
  EXPECT_EQ(stagesOf(settings), (std::vector{EffectStage::Interference, EffectStage::Identity}));
  settings.normal_force.emplace();
  EXPECT_EQ(stagesOf(settings),
            (std::vector{EffectStage::Interference, EffectStage::Identity, EffectStage::NormalForce}));
  settings.friction.model = FrictionModel::Bristle;
  EXPECT_EQ(stagesOf(settings), (std::vector{EffectStage::Interference, EffectStage::Identity,
                                             EffectStage::NormalForce, EffectStage::Friction}));
}

TEST(EffectPlan, ANormalForceBringsWhatItNeeds) {
  EffectSettings settings;
  settings.normal_force.emplace();
  EXPECT_EQ(stagesOf(settings).front(), EffectStage::Interference);
}

// A follower of a pair sees by this that its settings have been edited.
TEST(EffectSettings, DifferWhicheverParameterDiffers) {
  EffectSettings settings;
  settings.normal_force.emplace();
  const auto differs = [&](auto change) {
    EffectSettings other = settings;
    change(other);
    return other != settings;
  };
  EXPECT_FALSE(differs([](EffectSettings&) {}));
  EXPECT_TRUE(differs([](EffectSettings& s) { s.interference = true; }));
  EXPECT_TRUE(differs([](EffectSettings& s) { s.normal_force.reset(); }));
  EXPECT_TRUE(differs([](EffectSettings& s) { s.normal_force->model = NormalForceModel::Hertz; }));
  for (double NormalForceSettings::*value :
       {&NormalForceSettings::loading_coefficient, &NormalForceSettings::stiffness,
        &NormalForceSettings::damping, &NormalForceSettings::foundation_stiffness,
        &NormalForceSettings::radius}) {
    EXPECT_TRUE(differs([&](EffectSettings& s) { (*s.normal_force).*value += 1.0; }));
  }
  EXPECT_TRUE(differs([](EffectSettings& s) { s.friction.model = FrictionModel::Bristle; }));
  for (double FrictionSettings::*value :
       {&FrictionSettings::regularisation_speed, &FrictionSettings::stribeck_speed,
        &FrictionSettings::bristle_stiffness, &FrictionSettings::bristle_damping}) {
    EXPECT_TRUE(differs([&](EffectSettings& s) { s.friction.*value += 1.0; }));
  }
}

TEST(EffectSettings, FrictionWithoutANormalForceIsRefused) {
  EffectSettings settings;
  settings.interference = true;
  settings.friction.model = FrictionModel::RegularisedCoulomb;
  try {
    settings.validate("pairs[0].effects");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "pairs[0].effects.friction: friction is asked for without a normal force (add normal_force, "
                 "or leave friction out)");
  }
}

}  // namespace
}  // namespace concave_distance::effect_settings_test
