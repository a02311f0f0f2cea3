#include "clearance_pair.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "distance/bound/round_certificate.h"
#include "distance/bound/solid_overlap.h"

namespace concave_distance::detail {
namespace {

/// A bound by boxes is taken where it is this share of what is needed: an exact distance takes some ten times
/// as long.
constexpr double kShareByBoxes = 0.1;
/// A distance is proven to this share of what it is above the aim.
constexpr double kRelativeTolerance = 0.2;

/// Returns whether neither body holds a part of the other; empty when the limit was reached first.
std::optional<bool> areApart(const ClearancePair& pair, const Eigen::Isometry3d& a_from_b, WorkLimit& limit) {
  const BodyMesh& a = *pair.a->mesh;
  const BodyMesh& b = *pair.b->mesh;
  const std::optional<bool> holds =
      hasRound(a, b) ? isRoundContained(a, b, a_from_b) : isContained(a, b, a_from_b, limit);
  return holds ? std::optional<bool>(!*holds) : std::nullopt;
}

}  // namespace

ClearanceSample sampleByBoxes(const ClearancePair& pair, double moment, ClearanceWorkspace& workspace) {
  ClearanceSample sample;
  sample.moment = moment;
  ++workspace.box_queries;
  const double bound =
      distanceLowerBound(pair.a->bounds, pair.b->bounds, workspace.pose.a_from_b) - pair.error;
  sample.lower = bound - pair.margin;
  sample.is_apart = bound > 0.0;
  return sample;
}

ClearanceSample sampleAt(const ClearancePair& pair, double moment, const SampleRequest& request,
                         const TrianglePair* starts, std::size_t start_count, bool is_apart,
                         ClearanceWorkspace& workspace, WorkLimit& limit) {
  const Eigen::Isometry3d& a_from_b = workspace.pose.a_from_b;
  const BodyMesh& a = *pair.a->mesh;
  const BodyMesh& b = *pair.b->mesh;
  ClearanceSample sample = sampleByBoxes(pair, moment, workspace);
  if (request.allows_boxes && sample.is_apart && sample.lower - request.aim >= kShareByBoxes * request.need) {
    return sample;
  }
  ++workspace.queries;
  CertificateRequest wanted;
  wanted.limit = &limit;
  wanted.absolute_tolerance = request.tolerance;
  if (std::isfinite(request.aim)) {
    wanted.relative_tolerance = kRelativeTolerance;
    wanted.margin = std::max(0.0, request.aim + pair.margin);
    wanted.far_enough = request.aim + request.need + pair.margin + pair.error;
  }
  const bool is_round = hasRound(a, b);
  const DistanceCertificate found =
      is_round ? certifyRoundDistance(a, b, a_from_b, starts, start_count, wanted)
               : certifyDistance(a, b, a_from_b, starts, start_count, wanted, workspace.certificate);
  sample.is_certified = true;
  sample.triangles = {found.witness.triangle_a, found.witness.triangle_b};
  sample.point_a_in_a = found.witness.point_a_in_a;
  sample.point_b_in_a = found.witness.point_b_in_a;
  sample.lower = std::max(sample.lower, found.lower_bound - pair.error - pair.margin);
  sample.distance = std::max(0.0, found.distance - pair.margin);
  std::optional<bool> apart = is_apart || sample.is_apart;
  if (found.status == CertificateStatus::Penetrating) {
    apart = false;
  } else if (!*apart) {
    apart = areApart(pair, a_from_b, limit);
  }
  sample.is_apart = apart.value_or(false);
  // Until it is known that neither is inside the other, nothing is certain.
  if (!sample.is_apart) sample.lower = 0.0;
  if (apart && !*apart) sample.distance = 0.0;
  return sample;
}

}  // namespace concave_distance::detail
