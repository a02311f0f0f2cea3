#include "concave_distance/search/automatic_radii.h"

namespace concave_distance {

// A quarter of both bodies' bounding box diagonals: niches nearer than that along both surfaces share.
NicheRadii automaticRadii(const BodyMesh& a, const BodyMesh& b, const GeneticParameters& parameters) {
  const double sharing = parameters.sharing_radius.value_or(0.25 * (a.diameter() + b.diameter()));
  return {sharing, parameters.mating_radius.value_or(1.25 * sharing),
          parameters.niche_radius.value_or(sharing)};
}

}  // namespace concave_distance
