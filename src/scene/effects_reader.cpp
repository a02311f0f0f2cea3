#include "effects_reader.h"

#include "concave_distance/base/error.h"
#include "setting_values.h"

namespace concave_distance::detail {
namespace {

constexpr std::pair<const char*, NormalForceModel> kNormalForceModels[] = {
    {"quasi_static", NormalForceModel::QuasiStatic},
    {"spring_dashpot", NormalForceModel::SpringDashpot},
    {"hertz", NormalForceModel::Hertz},
    {"hunt_crossley", NormalForceModel::HuntCrossley},
    {"elastic_foundation", NormalForceModel::ElasticFoundation}};
constexpr std::pair<const char*, FrictionModel> kFrictionModels[] = {
    {"none", FrictionModel::None},
    {"regularised_coulomb", FrictionModel::RegularisedCoulomb},
    {"bristle", FrictionModel::Bristle}};

void readNormalForce(const YamlValue& value, std::optional<NormalForceSettings>& normal_force) {
  if (value.isText("none")) {
    normal_force.reset();
    return;
  }
  NormalForceSettings settings = normal_force.value_or(NormalForceSettings());
  if (value.isMap()) {
    YamlMap map(value, "a map with model and its parameters");
    if (auto v = map.take("model")) settings.model = v->choice(kNormalForceModels);
    if (auto v = map.take("loading_coefficient")) {
      settings.loading_coefficient = v->number("greater than 0", positiveFinite);
    }
    if (auto v = map.take("stiffness")) {
      settings.stiffness = v->number("greater than 0, newtons a metre", positiveFinite);
    }
    if (auto v = map.take("damping")) {
      settings.damping = v->number("0 or more, newton seconds a metre", notNegativeFinite);
    }
    if (auto v = map.take("foundation_stiffness")) {
      settings.foundation_stiffness = v->number("greater than 0, pascal a metre", positiveFinite);
    }
    if (auto v = map.take("radius")) {
      settings.radius = optionalNumber(*v, "from_overlap", kLength, positiveFinite).value_or(0.0);
    }
    map.finish();
  } else {
    settings.model = value.choice(kNormalForceModels);
  }
  normal_force = settings;
}

void readFriction(const YamlValue& value, FrictionSettings& friction) {
  if (!value.isMap()) {
    friction.model = value.choice(kFrictionModels);
    return;
  }
  YamlMap map(value, "a map with model and its parameters");
  if (auto v = map.take("model")) friction.model = v->choice(kFrictionModels);
  const char* speed = "greater than 0, metres a second";
  if (auto v = map.take("regularisation_speed"))
    friction.regularisation_speed = v->number(speed, positiveFinite);
  if (auto v = map.take("stribeck_speed")) friction.stribeck_speed = v->number(speed, positiveFinite);
  if (auto v = map.take("bristle_stiffness")) {
    friction.bristle_stiffness = v->number("greater than 0, per metre", positiveFinite);
  }
  if (auto v = map.take("bristle_damping")) {
    friction.bristle_damping = v->number("0 or more, seconds a metre", notNegativeFinite);
  }
  map.finish();
}

Material readMaterialValues(const YamlValue& value) {
  YamlMap map(value, "a map of a material's values");
  Material material;
  if (auto v = map.take("youngs_modulus")) {
    material.youngs_modulus = v->number("greater than 0, pascal", positiveFinite);
  }
  if (auto v = map.take("poissons_ratio")) {
    material.poissons_ratio =
        v->number("from 0 to below 0.5", [](double nu) { return nu >= 0.0 && nu < 0.5; });
  }
  const char* coefficient = "0 or more";
  if (auto v = map.take("dissipation")) {
    material.dissipation = v->number("0 or more, seconds a metre", notNegativeFinite);
  }
  if (auto v = map.take("static_friction"))
    material.static_friction = v->number(coefficient, notNegativeFinite);
  if (auto v = map.take("dynamic_friction"))
    material.dynamic_friction = v->number(coefficient, notNegativeFinite);
  if (auto v = map.take("viscous_friction")) {
    material.viscous_friction = v->number("0 or more, seconds a metre", notNegativeFinite);
  }
  map.finish();
  material.validate(value.where());
  return material;
}

}  // namespace

void readEffects(const YamlValue& value, EffectSettings& effects) {
  if (value.isText("none")) {
    effects = {};
    return;
  }
  if (!value.isMap()) value.refuse("none, or a map with interference, normal_force, friction");
  YamlMap map(value, "a map with interference, normal_force, friction");
  if (auto v = map.take("interference")) effects.interference = v->boolean();
  if (auto v = map.take("normal_force")) readNormalForce(*v, effects.normal_force);
  if (auto v = map.take("friction")) readFriction(*v, effects.friction);
  map.finish();
  effects.validate(value.where());
}

Materials readMaterials(const YamlValue& value) {
  const YamlMap map(value, "a map from a material's name to its values");
  Materials materials;
  for (const auto& [name, values] : map.entries()) materials[name] = readMaterialValues(values);
  return materials;
}

Material readMaterial(const YamlValue& value, const Materials& materials) {
  if (value.isMap()) return readMaterialValues(value);
  std::string known;
  for (const auto& [name, material] : materials) {
    if (value.isText(name.c_str())) return material;
    known += (known.empty() ? "" : ", ") + name;
  }
  value.refuse((known.empty() ? "a name under `materials`, where there is none yet"
                              : "a name under `materials`: " + known) +
               "; or a map of a material's values");
}

}  // namespace concave_distance::detail
