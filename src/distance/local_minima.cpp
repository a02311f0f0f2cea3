#include "local_minima.h"

#include <algorithm>
#include <cmath>

#include "basin_verdict.h"
#include "cone_front.h"
#include "far_pieces.h"
#include "meeting_pairs.h"
#include "mesh/trees/normal_cone_tree.h"
#include "minima_candidates.h"
#include "minima_flood.h"
#include "minima_scene.h"

namespace concave_distance {
namespace {

/// Of heights, relative to the size of both bodies; the same as the tracker's.
constexpr double kPlateauTolerance = 1e-9;
/// What judgeBasins() and decide() store for a seed.
constexpr std::size_t kBytesPerSeed = sizeof(BasinSeed) + sizeof(Basin) + 64;
/// No plateau seen comes near it; the flood has united the whole set before.
constexpr std::size_t kExtentPairLimit = 100'000;

struct Described {
  LocalMinimum niche;
  std::size_t minimum;  ///< of the flood
};

class Describer {
 public:
  Describer(const detail::MinimaScene& scene, const LocalMinimaRequest& request, WorkLimit& limit)
      : scene_(scene), request_(request), a_(scene.a), b_(scene.b), limit_(limit) {}

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
        measureExtent(a_, b_, scene_.a_from_b, niche.witness, tolerance, kExtentPairLimit, extent_, &limit_);
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
  WorkLimit& limit_;
  RefinementWorkspace refinement_;
  ExtentWorkspace extent_;
};

/// Verdicts alone; no pass is measured.
detail::FloodResult decide(const detail::MinimaScene& scene, const LocalMinimaRequest& request,
                           const std::vector<MinimumSeed>& seeds, std::size_t owned, LocalMinimaCost& cost,
                           WorkLimit& limit) {
  const MemoryScope memory(limit);
  detail::FloodResult result;
  if (!limit.takeMemory(seeds.size() * kBytesPerSeed)) {
    result.cut = true;
    result.owners.assign(seeds.size() - owned, LocalMinima::kNoOwner);
    return result;
  }
  std::vector<BasinSeed> basin_seeds;
  basin_seeds.reserve(seeds.size());
  for (const MinimumSeed& seed : seeds) {
    basin_seeds.push_back({seed.a, seed.b, seed.distance, request.least_prominence, true,
                           std::numeric_limits<std::size_t>::max()});
  }
  BasinVerdicts verdicts;
  judgeBasins(scene.a, scene.b, scene.a_from_b, basin_seeds, verdicts, &limit);
  cost.flooded_pairs += verdicts.floodedPairs();
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
    result.cut = result.cut || basin.refused;
    if (basin.owner != i || basin.refused) continue;
    minimum_of_basin[i] = result.minima.size();
    result.minima.push_back({basin.a, basin.b, basin.distance, basin.pass, basin.flooded, !led_to[i]});
  }
  for (std::size_t i = owned; i < seeds.size(); ++i) {
    result.owners.push_back(minimum_of_basin[verdicts.rootOf(verdicts.basinOf(i))]);
  }
  return result;
}

bool isFar(const detail::MinimaScene& scene, const LocalMinimaRequest& request) {
  return detail::isFar(scene, request.least_prominence);
}

void collectSeeds(const detail::MinimaScene& scene, const LocalMinimaRequest& request,
                  std::vector<MinimumSeed>& seeds, LocalMinimaCost& cost, WorkLimit& limit,
                  LocalMinimaMemory* memory) {
  detail::FarPieceBuffers far_pieces;
  if (isFar(scene, request) && detail::collectFarSeeds(scene, request.cutoff, far_pieces, seeds, limit))
    return;
  if (!(request.certain_distance > 16.0 * scene.rounding))
    detail::collectMeetingPairs(scene, seeds, cost, limit);
  const NormalSides sides = request.through_material ? NormalSides::Both : NormalSides::Outside;
  if (memory != nullptr) {
    detail::ConeFront& front = memory->front();
    front.collect(scene, sides, request.cutoff, seeds, limit);
    cost.node_pairs += front.counts().groups;
    cost.feature_pairs += front.counts().features;
    return;
  }
  detail::OpenCones open;
  detail::collectConeSeeds(scene, sides, request.cutoff, std::numeric_limits<std::size_t>::max(), open, seeds,
                           cost, limit);
}

}  // namespace

LocalMinimaMemory::LocalMinimaMemory() : front_(std::make_unique<detail::ConeFront>()) {}
LocalMinimaMemory::~LocalMinimaMemory() = default;
LocalMinimaMemory::LocalMinimaMemory(LocalMinimaMemory&&) noexcept = default;
LocalMinimaMemory& LocalMinimaMemory::operator=(LocalMinimaMemory&&) noexcept = default;

void LocalMinimaMemory::clear() {
  front_->clear();
}

std::size_t LocalMinimaMemory::memoryBytes() const {
  return front_->memoryBytes();
}

LocalMinima findLocalMinima(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                            const LocalMinimaRequest& request, LocalMinimaMemory* memory) {
  const detail::MinimaScene scene(a, b, a_from_b);
  WorkLimit none;
  WorkLimit& limit = request.limit != nullptr ? *request.limit : none;
  const MemoryScope scope(limit);
  const bool refused_before = limit.hasRefusedMemory();
  LocalMinima result;
  std::vector<MinimumSeed> seeds;
  collectSeeds(scene, request, seeds, result.cost, limit, memory);
  const std::size_t owned = seeds.size();
  result.cost.minima = owned;
  if (limit.isOver()) {
    result.finished = false;
    result.owners.assign(request.asked_pairs.size(), LocalMinima::kNoOwner);
    return result;
  }
  RefinementWorkspace refinement;
  for (const auto& [triangle_a, triangle_b] : request.asked_pairs) {
    const WitnessPair settled = refineWitness(a, b, a_from_b, triangle_a, triangle_b, refinement).witness;
    seeds.push_back({settled.triangle_a, settled.triangle_b, std::sqrt(settled.squared_distance)});
  }
  const bool measures = request.prominence_limit > request.least_prominence && !isFar(scene, request);
  const detail::FloodResult flood =
      measures ? detail::floodMinima(scene, request, seeds, owned, result.cost, limit)
               : decide(scene, request, seeds, owned, result.cost, limit);

  std::vector<Described> described;
  Describer describer(scene, request, limit);
  for (std::size_t i = 0; i < flood.minima.size() && !limit.isOver(); ++i) {
    LocalMinimum niche;
    if (describer.describe(flood.minima[i], niche)) described.push_back({niche, i});
  }
  result.finished = !flood.cut && !limit.isOver() && limit.hasRefusedMemory() == refused_before;
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
