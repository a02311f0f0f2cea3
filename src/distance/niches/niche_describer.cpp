#include "niche_describer.h"

#include <cmath>

#include "mesh/surface/mesh_topology.h"
#include "niche_properties.h"
#include "shell_material.h"

namespace concave_distance::detail {
namespace {

/// No plateau seen comes near it; the search has united the whole set before.
constexpr std::size_t kExtentPairLimit = 100'000;

}  // namespace

void NicheDescriber::begin(const PairFrame& frame, const LocalMinimaRequest& request) {
  all_outward_ = !request.through_material && request.given == nullptr &&
                 frame.a.topology().allShellsClosed() && frame.b.topology().allShellsClosed() &&
                 !frame.hasJoints();
}

/// Where the middle of a set is hidden, the first of its corners that is not stands for it.
template <typename IsClear>
void NicheDescriber::showCorner(const PairFrame& frame, LocalMinimum& niche, const IsClear& is_clear,
                                WorkLimit& limit) {
  for (const ExtentWorkspace::Piece& piece : extent_.pieces) {
    for (std::uint32_t k = 0; k < piece.count; ++k) {
      if (limit.isOver()) return;
      const std::optional<WitnessPair> corner = cornerOf(frame.a, frame.b, frame.a_from_b, extent_, piece, k);
      if (!corner) continue;
      const double difference = std::sqrt(corner->squared_distance) - niche.distance;
      if (std::abs(difference) > 4.0 * frame.rounding || !is_clear(*corner)) continue;
      niche.witness = *corner;
      niche.visible = true;
      return;
    }
  }
}

bool NicheDescriber::describe(const PairFrame& frame, const LocalMinimaRequest& request,
                              const MinimumCandidate& minimum, bool met_by_search, bool is_seen,
                              LocalMinimum& niche, WorkLimit& limit) {
  const BodyMesh& a = frame.a;
  const BodyMesh& b = frame.b;
  niche.witness = minimum.is_measured
                      ? frame.witnessOf(minimum)
                      : refineWitness(a, b, frame.a_from_b, minimum.a, minimum.b, refinement_).witness;
  niche.distance = std::sqrt(niche.witness.squared_distance);
  if (minimum.distance <= 4.0 * frame.rounding) {
    niche.distance = 0.0;
    return true;
  }
  if (niche.distance > request.cutoff) return false;
  if (minimum.distance <= frame.touchingDistance()) return true;
  if (!all_outward_ || met_by_search) {
    niche.outward = classifyOutwardness(a, b, frame.a_from_b, niche.witness);
    if (niche.outward == Outwardness::ThroughMaterial && !request.through_material) return false;
  }
  // A hidden niche may begin in the material of another shell, where there is no surface.
  if (request.hidden && !request.through_material && isInsideMaterial(frame, niche.witness)) return false;
  if (!minimum.is_point) measure(frame, niche, limit);
  // Bodies that overlap can be opposite to each other inside another shell of one of them.
  const bool may_overlap = !(request.certain_distance > 4.0 * frame.touchingDistance());
  const auto is_clear = [&](const WitnessPair& witness) {
    return isVisible(a, b, frame.a_from_b, witness) && !(may_overlap && isInsideMaterial(frame, witness));
  };
  niche.visible =
      is_seen ? !(may_overlap && isInsideMaterial(frame, niche.witness)) : is_clear(niche.witness);
  if (!niche.visible && niche.kind != NicheKind::Point) showCorner(frame, niche, is_clear, limit);
  return niche.visible || request.hidden;
}

void NicheDescriber::measure(const PairFrame& frame, LocalMinimum& niche, WorkLimit& limit) {
  const BodyMesh& a = frame.a;
  const BodyMesh& b = frame.b;
  const double tolerance = kPlateauTolerance * (a.diameter() + b.diameter());
  const NicheExtent extent =
      measureExtent(a, b, frame.a_from_b, niche.witness, tolerance, kExtentPairLimit, extent_, &limit);
  niche.kind = extent.kind;
  niche.extent = extent.length;
  if (extent.kind != NicheKind::Point) niche.witness = extent.representative;
}

}  // namespace concave_distance::detail
