#include "automatic_radii.h"

#include <algorithm>

#include "search/grid/body_grid.h"

namespace concave_distance {
namespace {

// The rule. Two individuals share a niche when what separates them is small against the bodies, so the
// sharing radius is a share of the way across both (Delta adds up the ways on A and on B). It must not reach
// from one protrusion to the next, because that is where niches are; and it must span some edges, because
// nearer local minima are the grid's and not the surface's. The numbers were chosen on the thesis's three
// scenes (its hand-made radii, where they are stated, vary from 0.25 to 2 on them) and hold between a third
// and three times their value: there the share of the niches of prominence 0.01 that the final population of
// 100 keeps is flat. See doc/algorithm.md.
constexpr double kShareOfExtents = 0.1;
constexpr double kLeastEdges = 2.0;
// Table 5.22: sigma_s <= sigma_m <= 1.5 sigma_s, sigma_n = sigma_s.
constexpr double kMatingFactor = 1.25;

double sharingRadius(const BodyGrid& a, const BodyGrid& b) {
  const double share = kShareOfExtents * (a.geodesicExtent() + b.geodesicExtent());
  const double radius = std::min({share, a.protrusionSpacing(), b.protrusionSpacing()});
  return std::max(radius, kLeastEdges * std::max(a.nodes().max_edge_length, b.nodes().max_edge_length));
}

}  // namespace

NicheRadii automaticRadii(const BodyMesh& a, const BodyMesh& b, const GeneticParameters& parameters) {
  NicheRadii radii{};
  radii.sharing =
      parameters.sharing_radius ? *parameters.sharing_radius : sharingRadius(gridOf(a), gridOf(b));
  radii.mating = parameters.mating_radius.value_or(kMatingFactor * radii.sharing);
  radii.niche = parameters.niche_radius.value_or(radii.sharing);
  return radii;
}

}  // namespace concave_distance
