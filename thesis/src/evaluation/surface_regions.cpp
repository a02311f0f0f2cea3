#include "surface_regions.h"

#include <unordered_set>

#include "base/pair_key.h"
#include "distance/niches/facet_pair_neighbours.h"

namespace concave_distance::evaluation {

SurfaceRegions::SurfaceRegions(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                               const std::vector<LocalMinimum>& minima)
    : scene_(detail::PairFrame::withFacets(a, b, a_from_b)) {
  for (std::size_t i = 0; i < minima.size(); ++i) {
    const auto facet_pair = scene_.facetPairOf(minima[i].witness.triangle_a, minima[i].witness.triangle_b);
    minima_of_facet_pair_.emplace(pairKey(facet_pair.a, facet_pair.b), i);
  }
}

std::size_t SurfaceRegions::ownerOf(const FoundPlace& place) const {
  const double level = place.distance + 8.0 * scene_.rounding;
  const double squared_level = level * level;
  std::size_t owner = kNoOwner;
  std::unordered_set<std::uint64_t> reached;
  std::vector<TrianglePair> open;
  const auto reach = [&](TriangleIndex a, TriangleIndex b) {
    if (reached.insert(pairKey(a, b)).second) open.push_back({a, b});
  };
  const TrianglePair start = scene_.facetPairOf(place.triangle_a, place.triangle_b);
  reach(start.a, start.b);
  while (!open.empty()) {
    const TrianglePair facet_pair = open.back();
    open.pop_back();
    const auto [first, last] = minima_of_facet_pair_.equal_range(pairKey(facet_pair.a, facet_pair.b));
    for (auto found = first; found != last; ++found) {
      if (owner != kNoOwner && owner != found->second) return kNoOwner;
      owner = found->second;
    }
    const detail::FacetPoints points_a = scene_.facetOfA(facet_pair.a);
    const detail::FacetPoints points_b = scene_.facetOfB(facet_pair.b);
    detail::forEachNeighbour(scene_, facet_pair.a, facet_pair.b, points_a, points_b,
                             detail::facetPairLevels(points_a, points_b),
                             [&](TriangleIndex a, TriangleIndex b, double squared, const auto&) {
                               if (squared <= squared_level) reach(a, b);
                             });
  }
  return owner;
}

}  // namespace concave_distance::evaluation
