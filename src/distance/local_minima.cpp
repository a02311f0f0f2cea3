#include "concave_distance/distance/local_minima.h"

#include <algorithm>
#include <cmath>

#include "minima_candidates.h"
#include "minima_flood.h"
#include "minima_scene.h"
#include "minima_verdict.h"

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
      : scene_(scene), request_(request), a_(scene.a.body()), b_(scene.b.body()) {}

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

}  // namespace

LocalMinima findLocalMinima(const MinimaIndex& a, const MinimaIndex& b, const Eigen::Isometry3d& a_from_b,
                            const LocalMinimaRequest& request) {
  const detail::MinimaScene scene(a, b, a_from_b);
  LocalMinima result;
  std::vector<detail::MinimumSeed> seeds;
  detail::collectMeetingPairs(scene, seeds, result.cost);
  detail::CandidateWorkspace candidates;
  detail::collectConeSeeds(scene, request.cutoff, seeds, result.cost, candidates);
  const std::size_t owned = seeds.size();
  result.cost.minima = owned;
  RefinementWorkspace refinement;
  for (const auto& [triangle_a, triangle_b] : request.whose) {
    const WitnessPair settled =
        refineWitness(a.body(), b.body(), a_from_b, triangle_a, triangle_b, refinement).witness;
    seeds.push_back({settled.triangle_a, settled.triangle_b, std::sqrt(settled.squared_distance)});
  }
  detail::FloodResult flood;
  if (request.prominence_limit > request.least_prominence) {
    flood = detail::floodMinima(scene, request, seeds, owned, result.cost);
  } else {
    detail::VerdictWorkspace verdict;
    detail::decideMinima(scene, request.least_prominence, seeds, owned, verdict, flood, result.cost);
  }

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
