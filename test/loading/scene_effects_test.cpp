#include <gtest/gtest.h>

#include <functional>

#include "contact/contact_parameter_tables.h"
#include "loading/set_effects.h"
#include "support/scene_fixture.h"

namespace concave_distance::scene_effects_test {
namespace {

using test::mentions;

const std::string kTwoBalls =
    "bodies:\n"
    "  - {name: a, sphere: {radius: 1}, max_edge_length: 100}\n"
    "  - {name: b, sphere: {radius: 1}, max_edge_length: 100}\n";

class SceneEffects : public test::SceneTest {
 protected:
  EffectSettings effectsOf(const std::string& effects) const {
    const Scene scene = load(kTwoBalls + "defaults: {effects: " + effects + "}\n");
    EXPECT_TRUE(scene.problems.empty());
    return allPairs(scene).at(0).settings.effects;
  }
  void expectRefused(const std::string& effects, const std::string& key, const std::string& allowed) const {
    const std::string text = refusal(kTwoBalls + "defaults: {effects: " + effects + "}\n");
    EXPECT_TRUE(mentions(text, "scene.yaml:4, defaults.effects" + key + ": ")) << text;
    EXPECT_TRUE(mentions(text, allowed)) << text;
  }
};

TEST_F(SceneEffects, NothingIsComputedUnlessItIsNamed) {
  EXPECT_FALSE(allPairs(load(kTwoBalls)).at(0).settings.effects.any());
  EXPECT_FALSE(effectsOf("none").any());
}

TEST_F(SceneEffects, AModelIsNamedAloneOrWithItsParameters) {
  const EffectSettings plain = effectsOf("{normal_force: hertz, friction: bristle}");
  ASSERT_TRUE(plain.normal_force);
  EXPECT_EQ(plain.normal_force->model, NormalForceModel::Hertz);
  EXPECT_EQ(plain.friction.model, FrictionModel::Bristle);
  const EffectSettings detailed = effectsOf(
      "{interference: true, normal_force: {model: spring_dashpot, stiffness: 5, damping: 2}, "
      "friction: {model: regularised_coulomb, regularisation_speed: 0.25}}");
  EXPECT_TRUE(detailed.interference);
  EXPECT_EQ(detailed.normal_force->model, NormalForceModel::SpringDashpot);
  EXPECT_EQ(detailed.normal_force->stiffness, 5.0);
  EXPECT_EQ(detailed.normal_force->damping, 2.0);
  EXPECT_EQ(detailed.friction.regularisation_speed, 0.25);
  EXPECT_EQ(effectsOf("{normal_force: {model: hertz, radius: 0.5}}").normal_force->radius, 0.5);
  EXPECT_EQ(effectsOf("{normal_force: {radius: from_overlap}}").normal_force->radius, 0.0);
  const FrictionSettings bristle =
      effectsOf(
          "{normal_force: {model: quasi_static, loading_coefficient: 2}, "
          "friction: {model: bristle, stribeck_speed: 3, bristle_stiffness: 4, bristle_damping: 5}}")
          .friction;
  EXPECT_EQ(bristle.stribeck_speed, 3.0);
  EXPECT_EQ(bristle.bristle_stiffness, 4.0);
  EXPECT_EQ(bristle.bristle_damping, 5.0);
}

TEST_F(SceneEffects, APairsEffectsAreLaidOverTheDefaults) {
  const Scene scene = load(kTwoBalls +
                           "defaults: {effects: {normal_force: hertz}}\n"
                           "pairs:\n  - {between: [a, b], effects: {friction: bristle}}\n");
  const EffectSettings effects = allPairs(scene).at(0).settings.effects;
  EXPECT_EQ(effects.normal_force->model, NormalForceModel::Hertz);
  EXPECT_EQ(effects.friction.model, FrictionModel::Bristle);
  const Scene without = load(kTwoBalls +
                             "defaults: {effects: {normal_force: hertz}}\n"
                             "pairs:\n  - {between: [a, b], effects: none}\n");
  EXPECT_FALSE(allPairs(without).at(0).settings.effects.any());
}

TEST_F(SceneEffects, WrongNamesAndValuesAreRefusedWithWhatIsAllowed) {
  expectRefused("gravity", "", "none, or a map with interference, normal_force, friction");
  expectRefused("{gravity: 9.81}", ".gravity", "interference, normal_force, friction");
  expectRefused("{normal_force: hurtz}", ".normal_force",
                "quasi_static, spring_dashpot, hertz, hunt_crossley");
  expectRefused("{normal_force: {model: spring_dashpot, stiffness: -1}}", ".normal_force.stiffness",
                "greater than 0 (N/m)");
  expectRefused("{normal_force: {model: quasi_static, damping: -1}}", ".normal_force.damping", "0 or more");
  expectRefused("{normal_force: {model: quasi_static, loading_coefficient: 0}}",
                ".normal_force.loading_coefficient", "greater than 0");
  expectRefused("{normal_force: {radius: 0}}", ".normal_force.radius", "from_overlap");
  expectRefused("{normal_force: hertz, friction: {model: glue}}", ".friction.model",
                "none, regularised_coulomb, bristle");
  expectRefused("{normal_force: hertz, friction: {model: bristle, bristle_stiffness: 0}}",
                ".friction.bristle_stiffness", "greater than 0 (1/m)");
  expectRefused("{friction: bristle}", ".friction", "add normal_force, or leave friction out");
}

/// Every parameter of `table` but the model, with each model: taken or refused as the table says.
template <typename Settings>
void expectFitAlone(const ParameterTable<Settings>& table, const std::string& before, const std::string& key,
                    const std::function<std::string(const std::string&)>& refusalOf) {
  const Settings defaults;
  std::size_t refused = 0;
  for (const std::string& model : findParameter(table, "model")->info.choices) {
    for (const Parameter<Settings>& parameter : table) {
      const ParameterInfo& info = parameter.info;
      if (info.name == "model") continue;
      const std::string text = refusalOf("{" + before + key + ": {model: " + model + ", " + info.name + ": " +
                                         toText(parameter.get(defaults)) + "}}");
      if (belongsTo(info, model)) {
        EXPECT_EQ(text, "") << model << ", " << info.name;
        continue;
      }
      ++refused;
      EXPECT_TRUE(mentions(text, "scene.yaml:4, defaults.effects." + key + "." + info.name + ": ")) << text;
      EXPECT_TRUE(mentions(text, "and the model is " + model)) << text;
      for (const std::string& other : info.models) EXPECT_TRUE(mentions(text, other)) << text;
      EXPECT_TRUE(mentions(text, "leave it out, or write model: ")) << text;
    }
  }
  EXPECT_GT(refused, 0U);
}

TEST_F(SceneEffects, AParameterOfAnotherModelIsRefusedWithTheModelsItBelongsTo) {
  const auto refusal_of = [this](const std::string& effects) -> std::string {
    try {
      load(kTwoBalls + "defaults: {effects: " + effects + "}\n");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  expectFitAlone(normalForceParameters(), "", "normal_force", refusal_of);
  expectFitAlone(frictionParameters(), "normal_force: hertz, ", "friction", refusal_of);
  expectRefused(
      "{normal_force: {model: hertz, damping: 2}}", ".normal_force.damping",
      "it is a parameter of quasi_static and spring_dashpot, and the model is hertz (leave it out, or "
      "write model: quasi_static or spring_dashpot)");
}

TEST_F(SceneEffects, TheModelThatAParameterIsLaidOverCounts) {
  const std::string defaults = "defaults: {effects: {normal_force: {model: spring_dashpot, stiffness: 5}}}\n";
  const Scene scene =
      load(kTwoBalls + defaults + "pairs:\n  - {between: [a, b], effects: {normal_force: {damping: 3}}}\n");
  EXPECT_EQ(allPairs(scene).at(0).settings.effects.normal_force->damping, 3.0);
  const std::string text =
      refusal(kTwoBalls + defaults + "pairs:\n  - {between: [a, b], effects: {normal_force: {radius: 1}}}\n");
  EXPECT_TRUE(mentions(text, "and the model is spring_dashpot")) << text;
  Scene served = load(kTwoBalls + defaults);
  setEffects(served, "*", "{normal_force: {stiffness: 7}}");
  EXPECT_EQ(allPairs(served).at(0).settings.effects.normal_force->stiffness, 7.0);
  EXPECT_THROW(setEffects(served, "*", "{normal_force: {foundation_stiffness: 7}}"), Error);
  EXPECT_THROW(setEffects(served, "*", "{normal_force: {model: hertz, stiffness: 7}}"), Error);
}

TEST_F(SceneEffects, EffectsNeedAProof) {
  const std::string text =
      refusal(kTwoBalls + "defaults: {accuracy: refined, effects: {interference: true}}\n");
  EXPECT_TRUE(mentions(text, "set accuracy to certified")) << text;
}

// Each of these texts to set_effects soon ends in an Error, and no pair is changed.
TEST_F(SceneEffects, NoTextFromOutsideDoesHarm) {
  const auto repeated = [](const std::string& text, std::size_t size) {
    std::string all;
    while (all.size() + text.size() <= size) all += text;
    return all;
  };
  Scene scene = load(kTwoBalls);
  for (const std::string part :
       {"[",  "{",  "{a: ", "[{",   "- ",    "? ",   "&a ", "! ", "*a ",  ": ",
        ", ", "\"", "'",    "|\n ", "---\n", "%A\n", "\t",  "x",  "<<: ", "!!binary "}) {
    for (const std::size_t size : {std::size_t{4096}, std::size_t{10'000'000}}) {
      EXPECT_THROW(setEffects(scene, "*", repeated(part, size)), Error) << part << " times " << size;
    }
  }
  for (const std::string text : {"&a [*a]", "&a {normal_force: *a}", "{normal_force: &b {model: *b}}",
                                 "{&a interference: *a}", "*none", "{interference: {}, interference: {}}"}) {
    EXPECT_THROW(setEffects(scene, "*", text), Error) << text;
  }
  EXPECT_THROW(setEffects(scene, std::string(1'000'000, '['), "none"), Error);
  EXPECT_THROW(setEffects(scene, repeated("*a", 1'000'000), "none"), Error);
  EXPECT_THROW(setEffects(scene, std::string(4097, '*'), "interference"), Error) << "it would match";
  for (const ScenePair& pair : allPairs(scene)) EXPECT_FALSE(pair.settings.effects.any());
}

TEST_F(SceneEffects, AMaterialIsNamedOrSpelledOut) {
  const Scene scene = load(
      "materials:\n  rubber: {youngs_modulus: 1e6, poissons_ratio: 0.48, dissipation: 0.5}\n"
      "  ice: {static_friction: 0.02, dynamic_friction: 0.01, viscous_friction: 0.003}\n"
      "defaults: {material: ice}\n"
      "bodies:\n"
      "  - {name: a, sphere: {radius: 1}, max_edge_length: 100, material: rubber}\n"
      "  - {name: b, sphere: {radius: 1}, max_edge_length: 100}\n"
      "  - {name: c, sphere: {radius: 1}, max_edge_length: 100, material: {youngs_modulus: 7}}\n");
  EXPECT_EQ(scene.bodies.at(0).material.youngs_modulus, 1e6);
  EXPECT_EQ(scene.bodies.at(0).material.poissons_ratio, 0.48);
  EXPECT_EQ(scene.bodies.at(0).material.dissipation, 0.5);
  EXPECT_EQ(scene.bodies.at(1).material.dynamic_friction, 0.01);
  EXPECT_EQ(scene.bodies.at(1).material.viscous_friction, 0.003);
  EXPECT_EQ(scene.bodies.at(2).material.youngs_modulus, 7.0);
}

TEST_F(SceneEffects, WrongMaterialsAreRefusedWithWhatIsAllowed) {
  const auto refused = [&](const std::string& yaml, const std::string& place, const std::string& allowed) {
    const std::string text = refusal(yaml);
    EXPECT_TRUE(mentions(text, place)) << text;
    EXPECT_TRUE(mentions(text, allowed)) << text;
  };
  refused("materials: {steel: {youngs_modulus: 0}}\n", "scene.yaml:1, materials.steel.youngs_modulus",
          "greater than 0 (Pa)");
  refused("materials: {steel: {poissons_ratio: 0.5}}\n", "materials.steel.poissons_ratio",
          "from 0 to below 0.5");
  refused("materials: {steel: {colour: red}}\n", "materials.steel.colour", "youngs_modulus");
  refused("materials: {steel: {static_friction: 0.1}}\n", "materials.steel",
          "dynamic_friction (0.4) or more");
  refused("materials: {steel: {}}\ndefaults: {material: steal}\n", "scene.yaml:2, defaults.material",
          "a name under `materials`: steel");
}

TEST_F(SceneEffects, AnOpenBodyThatIsToPushIsToldOf) {
  // The tetrahedron without its last face.
  std::string open = test::tetrahedronStl();
  const std::size_t last = open.rfind("facet normal");
  open = open.substr(0, last) + "endsolid t\n";
  folder.write("open.stl", open);
  const std::string yaml =
      "bodies:\n"
      "  - {name: a, mesh: open.stl, max_edge_length: 100}\n"
      "  - {name: b, sphere: {radius: 1}, max_edge_length: 100}\n";
  EXPECT_TRUE(load(yaml).problems.empty());
  const Scene scene = load(yaml + "defaults: {effects: {normal_force: hertz}}\n");
  ASSERT_EQ(scene.problems.size(), 1U);
  EXPECT_TRUE(mentions(scene.problems[0].message, "'a' is not closed")) << scene.problems[0].message;
}

}  // namespace
}  // namespace concave_distance::scene_effects_test
