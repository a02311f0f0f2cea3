#include "concave_distance/distance/local_minima.h"

#include <algorithm>
#include <cmath>

#include "concave_distance/distance/basin_verdict.h"
#include "minima_candidates.h"
#include "minima_flood.h"
#include "minima_scene.h"

namespace concave_distance {
namespace {

/// Of heights, relative to the size of both bodies; the same as the tracker's.
constexpr double kPlateauTolerance = 1e-9;
/// No plateau seen comes near it; the flood has united the whole set before.
constexpr std::size_t kExtentPairLimit = 100'000;

struct Described {
  LocalMinimum niche;
  std::size_t minimum;  ///< of the flood
};

class Describer {
 public:
  Describer(const detail::MinimaScene& scene, const LocalMinimaRequest& request)
      : scene_(scene), request_(request), a_(scene.a), b_(scene.b) {}

  /// False for what is not wanted.
  bool describe(const detail::FloodedMinimum& minimum, LocalMinimum& niche) {
    niche.witness = refineWitness(a_, b_, scene_.a_from_b, minimum.a, minimum.b, refinement_).witness;
    niche.distance = std::sqrt(niche.witness.squared_distance);
    niche.flooded = minimum.flooded;
    if (minimum.distance <= 4.0 * scene_.rounding) {
      niche.distance = 0.0;
      return true;
    }
    if (niche.distance > request_.cutoff) return false;
    niche.outward = classifyOutwardness(a_, b_, scene_.a_from_b, niche.witness);
    if (niche.outward == Outwardness::ThroughMaterial && !request_.through_material) return false;
    niche.visible = isVisible(a_, b_, scene_.a_from_b, niche.witness);
    niche.prominence = minimum.pass / niche.distance - 1.0;
    const double tolerance = kPlateauTolerance * (a_.diameter() + b_.diameter());
    const NicheExtent extent =
        measureExtent(a_, b_, scene_.a_from_b, niche.witness, tolerance, kExtentPairLimit, extent_);
    niche.kind = extent.kind;
    niche.extent = extent.length;
    if (extent.kind != NicheKind::Point) niche.witness = extent.representative;
    return true;
  }

 private:
  const detail::MinimaScene& scene_;
  const LocalMinimaRequest& request_;
  const BodyMesh& a_;
  const BodyMesh& b_;
  RefinementWorkspace refinement_;
  ExtentWorkspace extent_;
};

/// Verdicts alone; no pass is measured.
detail::FloodResult decide(const detail::MinimaScene& scene, const LocalMinimaRequest& request,
                           const std::vector<MinimumSeed>& seeds, std::size_t owned, LocalMinimaCost& cost) {
  std::vector<BasinSeed> basin_seeds;
  basin_seeds.reserve(seeds.size());
  for (const MinimumSeed& seed : seeds) {
    basin_seeds.push_back({seed.a, seed.b, seed.distance, request.least_prominence, true,
                           std::numeric_limits<std::size_t>::max()});
  }
  BasinVerdicts verdicts;
  judgeBasins(scene.a, scene.b, scene.a_from_b, basin_seeds, verdicts);
  cost.flooded_pairs += verdicts.floodedPairs();
  detail::FloodResult result;
  const std::vector<Basin>& basins = verdicts.basins();
  std::vector<std::size_t> minimum_of_basin(basins.size(), LocalMinima::kNoOwner);
  // What no cone led to is met by a flood; what was asked for does not count.
  std::vector<bool> led_to(basins.size(), false);
  for (std::size_t i = 0; i < owned; ++i) {
    const std::uint32_t root = verdicts.rootOf(verdicts.basinOf(i));
    led_to[root] = led_to[root] || seeds[i].distance <= basins[root].distance + 16.0 * scene.rounding;
  }
  for (std::uint32_t i = 0; i < basins.size(); ++i) {
    const Basin& basin = basins[i];
    if (basin.owner != i) continue;
    minimum_of_basin[i] = result.minima.size();
    result.minima.push_back({basin.a, basin.b, basin.distance, basin.pass, basin.flooded, !led_to[i]});
  }
  for (std::size_t i = owned; i < seeds.size(); ++i) {
    result.owners.push_back(minimum_of_basin[verdicts.rootOf(verdicts.basinOf(i))]);
  }
  return result;
}

}  // namespace

LocalMinima findLocalMinima(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                            const LocalMinimaRequest& request) {
  const detail::MinimaScene scene(a, b, a_from_b);
  LocalMinima result;
  std::vector<MinimumSeed> seeds;
  detail::collectMeetingPairs(scene, seeds, result.cost);
  const NormalSides sides = request.through_material ? NormalSides::Both : NormalSides::Outside;
  detail::OpenCones open;
  detail::collectConeSeeds(scene, sides, request.cutoff, std::numeric_limits<std::size_t>::max(), open, seeds,
                           result.cost);
  const std::size_t owned = seeds.size();
  result.cost.minima = owned;
  RefinementWorkspace refinement;
  for (const auto& [triangle_a, triangle_b] : request.whose) {
    const WitnessPair settled = refineWitness(a, b, a_from_b, triangle_a, triangle_b, refinement).witness;
    seeds.push_back({settled.triangle_a, settled.triangle_b, std::sqrt(settled.squared_distance)});
  }
  const detail::FloodResult flood = request.prominence_limit > request.least_prominence
                                        ? detail::floodMinima(scene, request, seeds, owned, result.cost)
                                        : decide(scene, request, seeds, owned, result.cost);

  std::vector<Described> described;
  Describer describer(scene, request);
  for (std::size_t i = 0; i < flood.minima.size(); ++i) {
    LocalMinimum niche;
    if (describer.describe(flood.minima[i], niche)) described.push_back({niche, i});
  }
  std::sort(described.begin(), described.end(), [&](const Described& l, const Described& r) {
    if (l.niche.distance != r.niche.distance) return l.niche.distance < r.niche.distance;
    const detail::FloodedMinimum& of_l = flood.minima[l.minimum];
    const detail::FloodedMinimum& of_r = flood.minima[r.minimum];
    return of_l.a != of_r.a ? of_l.a < of_r.a : of_l.b < of_r.b;
  });
  result.cut = described.size() > request.largest_count;
  if (result.cut) described.resize(request.largest_count);
  std::vector<std::size_t> place(flood.minima.size(), LocalMinima::kNoOwner);
  for (const Described& entry : described) {
    place[entry.minimum] = result.niches.size();
    result.niches.push_back(entry.niche);
    result.cost.met_by_flood += flood.minima[entry.minimum].met_by_flood ? 1 : 0;
  }
  for (const std::size_t minimum : flood.owners) {
    result.owners.push_back(minimum == LocalMinima::kNoOwner ? LocalMinima::kNoOwner : place[minimum]);
  }
  return result;
}

}  // namespace concave_distance
