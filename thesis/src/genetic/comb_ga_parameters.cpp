#include "comb_ga_parameters.h"

#include "base/parameter_checks.h"
#include "comb_ga_parameter_table.h"

namespace concave_distance {

CombGaParameters::CombGaParameters(const GeneticParameters& core)
    : GeneticParameters(core),
      scheme(core.niching == NichingMethod::Sharing ? NichingScheme::Sharing
                                                    : NichingScheme::DeterministicCrowding) {}

void CombGaParameters::validate(const std::string& where) const {
  requireAllowed(combGaParameters(), *this, where);
  GeneticParameters::validate(where);
}

GeneticParameters partOfCore(const CombGaParameters& parameters) {
  GeneticParameters core = parameters;
  const bool crowds = parameters.scheme == NichingScheme::DeterministicCrowding ||
                      parameters.scheme == NichingScheme::DeterministicCrowdingWithSelection ||
                      parameters.scheme == NichingScheme::SimpleCrowding;
  core.niching = crowds ? NichingMethod::DeterministicCrowding : NichingMethod::Sharing;
  if (parameters.scheme == NichingScheme::None) core.conserve_niches = false;
  return core;
}

}  // namespace concave_distance
