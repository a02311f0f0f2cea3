#include "convex_shell_pairs.h"

#include "mesh/convex_shells.h"
#include "niche_properties.h"

namespace concave_distance::detail {
namespace {

/// Facet pairs after which a set of closest points is not measured on.
constexpr std::size_t kMostExtentPairs = 4096;
/// More pairs of shells take longer than all normal cones.
constexpr std::size_t kMostPairs = 512;

using Shell = ConvexShells::Shell;

const std::vector<Shell>& shellsOf(const BodyMesh& body) {
  return body.convexShells().shells;
}

/// Two convex solids are apart where each closest point sees the other one in front of it, not behind it
/// through its own solid.
bool isOutward(const Shell& a, const Shell& b, const Eigen::Isometry3d& a_from_b,
               const WitnessPair& witness) {
  const Eigen::Vector3d between = witness.point_b_in_a - witness.point_a_in_a;
  return between.dot(a.centre - witness.point_a_in_a) < 0.0 &&
         between.dot(a_from_b * b.centre - witness.point_b_in_a) > 0.0;
}

}  // namespace

void ConvexShellPairs::begin(const PairFrame& frame) {
  const auto count_a = static_cast<std::uint32_t>(shellsOf(frame.a).size());
  const auto count_b = static_cast<std::uint32_t>(shellsOf(frame.b).size());
  const std::size_t count = std::size_t{count_a} * count_b;
  if (count > kMostPairs) return;
  pairs_.resize(count);
  for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
    pairs_[i].a = i / count_b;
    pairs_[i].b = i % count_b;
  }
}

ConvexShellPairs::Outcome ConvexShellPairs::collect(const PairFrame& frame, const LocalMinimaRequest& request,
                                                    std::vector<MinimumCandidate>& candidates,
                                                    WorkLimit& limit) {
  // Closest points are not enough where minima behind other shells or through material are asked for.
  if (request.hidden || request.through_material) return Outcome::Unknown;
  if (pairs_.empty()) begin(frame);
  if (pairs_.empty()) return Outcome::Unknown;
  const std::size_t before = candidates.size();
  for (ShellPair& pair : pairs_) {
    const Outcome outcome = look(frame, request, pair, candidates, limit);
    if (outcome == Outcome::Complete) continue;
    if (outcome == Outcome::Unknown) candidates.resize(before);
    return outcome;
  }
  return Outcome::Complete;
}

ConvexShellPairs::Outcome ConvexShellPairs::look(const PairFrame& frame, const LocalMinimaRequest& request,
                                                 ShellPair& pair, std::vector<MinimumCandidate>& candidates,
                                                 WorkLimit& limit) {
  const Shell& a = shellsOf(frame.a)[pair.a];
  const Shell& b = shellsOf(frame.b)[pair.b];
  CertificateRequest proof;
  proof.limit = &limit;
  const DistanceCertificate nearest =
      certifyDistance(*a.mesh, *b.mesh, frame.a_from_b, &pair.nearest, pair.has_nearest ? 1 : 0, proof,
                      workspace_, request.is_tracked ? &pair.cache : nullptr);
  if (nearest.status == CertificateStatus::Budget || limit.isOver()) return Outcome::LimitReached;
  WitnessPair witness = nearest.witness;
  pair.nearest = {witness.triangle_a, witness.triangle_b};
  pair.has_nearest = true;
  if (nearest.status == CertificateStatus::Penetrating) return Outcome::Complete;
  if (nearest.lower_bound > request.cutoff + frame.rounding) return Outcome::Complete;
  const double rise = 64.0 * frame.rounding + 2.0 * frame.pose_error;
  if (!(rise < request.rule.riseAt(nearest.distance))) return Outcome::Unknown;
  if (!isOutward(a, b, frame.a_from_b, witness)) return Outcome::Complete;
  const double tolerance = kPlateauTolerance * frame.diameters();
  const NicheExtent extent =
      measureExtent(*a.mesh, *b.mesh, frame.a_from_b, witness, tolerance, kMostExtentPairs, extent_, &limit);
  const bool is_point = extent.kind == NicheKind::Point;
  witness.triangle_a = a.triangles[witness.triangle_a.value];
  witness.triangle_b = b.triangles[witness.triangle_b.value];
  if (!frame.areOnSurface(witness.triangle_a, witness.triangle_b)) {
    // Another place of a set may not be in the material of another shell.
    return is_point ? Outcome::Complete : Outcome::Unknown;
  }
  candidates.push_back(frame.candidateOf(witness));
  candidates.back().is_point = is_point;
  return Outcome::Complete;
}

void ConvexShellPairs::clear() {
  for (ShellPair& pair : pairs_) {
    pair.cache.clear();
    pair.has_nearest = false;
  }
}

}  // namespace concave_distance::detail
