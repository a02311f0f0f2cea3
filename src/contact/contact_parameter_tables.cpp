#include "contact_parameter_tables.h"

namespace concave_distance {

const ParameterTable<NormalForceSettings>& normalForceParameters() {
  using N = NormalForceSettings;
  using Models = std::vector<std::pair<std::string, NormalForceModel>>;
  static const ParameterTable<N> table = {
      choice<N>(
          "model",
          Models{{"quasi_static", NormalForceModel::QuasiStatic},
                 {"spring_dashpot", NormalForceModel::SpringDashpot},
                 {"hertz", NormalForceModel::Hertz},
                 {"hunt_crossley", NormalForceModel::HuntCrossley},
                 {"elastic_foundation", NormalForceModel::ElasticFoundation}},
          [](auto& n) -> auto& { return n.model; }, "of the force ([effects](effects.md))"),
      choice<N>(
          "distribution",
          std::vector<std::pair<std::string, ForceDistribution>>{{"pressure", ForceDistribution::Pressure},
                                                                 {"lumped", ForceDistribution::Lumped}},
          [](auto& n) -> auto& { return n.distribution; },
          "`pressure`: all over the surfaces of a region; `lumped`: one force at its centroid"),
      number<N>(
          "loading_coefficient", [](auto& n) -> auto& { return n.loading_coefficient; },
          "the thesis's K_p; the default gives the Hertz force of a round contact")
          .ofModels({"quasi_static"})
          .above(0.0),
      number<N>(
          "stiffness", [](auto& n) -> auto& { return n.stiffness; }, "force by depth")
          .ofModels({"spring_dashpot"})
          .inUnit("N/m")
          .above(0.0),
      number<N>(
          "damping", [](auto& n) -> auto& { return n.damping; }, "force by the rate of the depth")
          .ofModels({"quasi_static", "spring_dashpot"})
          .inUnit("N s/m"),
      number<N>(
          "foundation_stiffness", [](auto& n) -> auto& { return n.foundation_stiffness; },
          "pressure by depth")
          .ofModels({"elastic_foundation"})
          .inUnit("Pa/m")
          .above(0.0),
      automatic<N>(
          "radius", [](auto& n) -> auto& { return n.radius; },
          "relative radius of curvature at the contact; `from_overlap`: each region its own", "from_overlap")
          .ofModels({"hertz", "hunt_crossley"})
          .inUnit("m"),
  };
  return table;
}

const ParameterTable<FrictionSettings>& frictionParameters() {
  using F = FrictionSettings;
  using Models = std::vector<std::pair<std::string, FrictionModel>>;
  static const ParameterTable<F> table = {
      choice<F>(
          "model",
          Models{{"none", FrictionModel::None},
                 {"regularised_coulomb", FrictionModel::RegularisedCoulomb},
                 {"bristle", FrictionModel::Bristle}},
          [](auto& f) -> auto& { return f.model; }, "of friction ([effects](effects.md))"),
      number<F>(
          "regularisation_speed", [](auto& f) -> auto& { return f.regularisation_speed; },
          "below about this sliding speed the force goes to 0")
          .ofModels({"regularised_coulomb"})
          .inUnit("m/s")
          .above(0.0),
      number<F>(
          "stribeck_speed", [](auto& f) -> auto& { return f.stribeck_speed; },
          "where the coefficient has fallen from static towards dynamic")
          .ofModels({"regularised_coulomb", "bristle"})
          .inUnit("m/s")
          .above(0.0),
      number<F>(
          "bristle_stiffness", [](auto& f) -> auto& { return f.bristle_stiffness; },
          "friction over normal force per metre that the bristles are bent by")
          .ofModels({"bristle"})
          .inUnit("1/m")
          .above(0.0),
      number<F>(
          "bristle_damping", [](auto& f) -> auto& { return f.bristle_damping; },
          "friction over normal force per speed of their bending")
          .ofModels({"bristle"})
          .inUnit("s/m"),
  };
  return table;
}

const ParameterTable<Material>& materialParameters() {
  using M = Material;
  static const ParameterTable<M> table = {
      number<M>(
          "youngs_modulus", [](auto& m) -> auto& { return m.youngs_modulus; }, "stiffness of the material")
          .inUnit("Pa")
          .above(0.0),
      number<M>(
          "poissons_ratio", [](auto& m) -> auto& { return m.poissons_ratio; },
          "how much it narrows when it is stretched")
          .below(0.5),
      number<M>(
          "dissipation", [](auto& m) -> auto& { return m.dissipation; },
          "of Hunt and Crossley; restitution is about 1 minus this times the impact speed")
          .inUnit("s/m"),
      number<M>(
          "static_friction", [](auto& m) -> auto& { return m.static_friction; },
          "coefficient at rest, not below the dynamic one"),
      number<M>(
          "dynamic_friction", [](auto& m) -> auto& { return m.dynamic_friction; },
          "coefficient while sliding"),
      number<M>(
          "viscous_friction", [](auto& m) -> auto& { return m.viscous_friction; },
          "what the coefficient grows by with the speed")
          .inUnit("s/m"),
      number<M>(
          "rolling_friction", [](auto& m) -> auto& { return m.rolling_friction; },
          "torque over normal force against rolling")
          .inUnit("m"),
      number<M>(
          "spinning_friction", [](auto& m) -> auto& { return m.spinning_friction; },
          "torque over normal force against spinning about the normal, beside what friction over the "
          "contact's width does")
          .inUnit("m"),
  };
  return table;
}

}  // namespace concave_distance
