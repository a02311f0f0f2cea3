#include "local_minima.h"

#include <algorithm>
#include <cmath>

#include "cone_front.h"
#include "far_pieces.h"
#include "meeting_pairs.h"
#include "mesh/trees/normal_cone_tree.h"
#include "minima_candidates.h"
#include "minima_flood.h"
#include "minima_scene.h"
#include "minima_verdicts.h"

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
                           std::vector<MinimumSeed>& seeds, const std::vector<MinimumSeed>& asked,
                           detail::MinimaVerdicts& verdicts, bool keeps, LocalMinimaCost& cost,
                           WorkLimit& limit) {
  using Verdict = detail::MinimaVerdicts::Verdict;
  verdicts.judge(scene, seeds, asked, {request.least_prominence, request.through_material, keeps, {}}, limit);
  cost.flooded_pairs += verdicts.counts().flooded_cells;
  const auto& judged = verdicts.judged();
  detail::FloodResult result;
  std::vector<std::size_t> minimum_of(judged.size(), LocalMinima::kNoOwner);
  for (std::size_t i = 0; i < judged.size(); ++i) {
    result.cut = result.cut || judged[i].verdict == Verdict::Undecided;
    if (judged[i].verdict != Verdict::Niche) continue;
    const MinimumSeed& seed = judged[i].seed;
    minimum_of[i] = result.minima.size();
    const double flooded = (1.0 + request.least_prominence) * seed.distance;
    result.minima.push_back(
        {seed.a, seed.b, seed.distance, std::numeric_limits<double>::infinity(), flooded, i >= seeds.size()});
  }
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const std::uint32_t niche = verdicts.nicheOf(static_cast<std::uint32_t>(seeds.size() + i));
    result.owners.push_back(niche == detail::MinimaVerdicts::kNone ? LocalMinima::kNoOwner
                                                                   : minimum_of[niche]);
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

struct LocalMinimaMemory::Parts {
  detail::ConeFront front;
  detail::MinimaVerdicts verdicts;
};

LocalMinimaMemory::LocalMinimaMemory() = default;
LocalMinimaMemory::~LocalMinimaMemory() = default;
LocalMinimaMemory::LocalMinimaMemory(LocalMinimaMemory&&) noexcept = default;
LocalMinimaMemory& LocalMinimaMemory::operator=(LocalMinimaMemory&&) noexcept = default;

LocalMinimaMemory::Parts& LocalMinimaMemory::parts() {
  if (parts_ == nullptr) parts_ = std::make_unique<Parts>();
  return *parts_;
}

detail::ConeFront& LocalMinimaMemory::front() {
  return parts().front;
}

detail::MinimaVerdicts& LocalMinimaMemory::verdicts() {
  return parts().verdicts;
}

void LocalMinimaMemory::clear() {
  if (parts_ == nullptr) return;
  parts_->front.clear();
  parts_->verdicts.clear();
}

std::size_t LocalMinimaMemory::memoryBytes() const {
  return parts_ != nullptr ? sizeof(Parts) + parts_->front.memoryBytes() + parts_->verdicts.memoryBytes() : 0;
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
  std::vector<MinimumSeed> asked;
  for (const auto& [triangle_a, triangle_b] : request.asked_pairs) {
    const WitnessPair settled = refineWitness(a, b, a_from_b, triangle_a, triangle_b, refinement).witness;
    asked.push_back({settled.triangle_a, settled.triangle_b, std::sqrt(settled.squared_distance)});
  }
  const bool measures = request.prominence_limit > request.least_prominence && !isFar(scene, request);
  detail::FloodResult flood;
  if (measures) {
    seeds.insert(seeds.end(), asked.begin(), asked.end());
    flood = detail::floodMinima(scene, request, seeds, owned, result.cost, limit);
  } else {
    detail::MinimaVerdicts once;
    flood = decide(scene, request, seeds, asked, memory != nullptr ? memory->verdicts() : once,
                   memory != nullptr, result.cost, limit);
  }

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
