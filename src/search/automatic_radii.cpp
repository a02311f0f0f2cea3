#include "concave_distance/search/automatic_radii.h"

#include <algorithm>
#include <limits>

#include "concave_distance/mesh/geodesic_extent.h"

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
constexpr double kLeastProminence = 0.05;
constexpr double kLeastEdges = 2.0;
// The most prominent ones are enough; the others only cost time.
constexpr std::size_t kProtrusionLimit = 64;
// Table 5.22: sigma_s <= sigma_m <= 1.5 sigma_s, sigma_n = sigma_s.
constexpr double kMatingFactor = 1.25;

/// The least mesh distance between two protrusions of the body when it is below `bound`, else `bound`.
double protrusionSpacing(const BodyMesh& body, double bound) {
  std::vector<Protrusion> protrusions = findProtrusions(body.graph(), kLeastProminence);
  protrusions.resize(std::min(protrusions.size(), kProtrusionLimit));
  MeshMetricQuery query(body.metric());
  double spacing = bound;
  for (std::size_t i = 0; i < protrusions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      spacing = std::min(spacing, query.distanceWithin(protrusions[i].node, protrusions[j].node, bound));
    }
  }
  return spacing;
}

double sharingRadius(const BodyMesh& a, const BodyMesh& b) {
  double radius = kShareOfExtents * (geodesicExtent(a.graph()) + geodesicExtent(b.graph()));
  radius = protrusionSpacing(a, radius);
  radius = protrusionSpacing(b, radius);
  return std::max(radius, kLeastEdges * std::max(a.maxEdgeLength(), b.maxEdgeLength()));
}

}  // namespace

NicheRadii automaticRadii(const BodyMesh& a, const BodyMesh& b, const GeneticParameters& parameters) {
  NicheRadii radii{};
  radii.sharing = parameters.sharing_radius ? *parameters.sharing_radius : sharingRadius(a, b);
  radii.mating = parameters.mating_radius.value_or(kMatingFactor * radii.sharing);
  radii.niche = parameters.niche_radius.value_or(radii.sharing);
  return radii;
}

}  // namespace concave_distance
