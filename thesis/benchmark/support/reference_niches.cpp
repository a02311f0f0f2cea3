#include "thesis/benchmark/support/reference_niches.h"

#include <algorithm>
#include <cmath>

#include "distance/niches/niche_decider.h"
#include "distance/niches/planar_set.h"
#include "search/grid/body_grid.h"
#include "support/enumeration.h"

namespace concave_distance::benchmark {

std::vector<ReferenceNiche> referenceNiches(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                                            double cutoff, double least_prominence) {
  RefinementWorkspace workspace;
  std::vector<ReferenceNiche> references;
  // What lies below the cutoff and leads on at less than the least prominence does so below this.
  const double flood_level = (1.0 + least_prominence) * cutoff;
  for (const test::NodeNiche& niche :
       test::enumerateNodeNiches(*pair.a, *pair.b, pose, flood_level, least_prominence)) {
    if (niche.distance > cutoff) {
      break;  // ascending
    }
    const WitnessRefinement refined =
        refineWitness(*pair.a, *pair.b, pose, gridOf(*pair.a).nodes().originalTriangle(niche.node_a),
                      gridOf(*pair.b).nodes().originalTriangle(niche.node_b), workspace);
    if (classifyOutwardness(*pair.a, *pair.b, pose, refined.witness) == Outwardness::ThroughMaterial) {
      continue;
    }
    bool known = false;
    for (const ReferenceNiche& other : references) {
      known = known || isSameNiche(pair, pose, refined.witness, other.witness, least_prominence);
    }
    if (!known) {
      references.push_back({refined.witness,
                            {niche.node_a, niche.node_b, niche.distance * niche.distance},
                            niche.distance,
                            niche.prominence});
    }
  }
  return references;
}

namespace {

// True when a witness is on the plateau that was measured last, whose distance varies by up to `tolerance`.
bool isOnMeasuredSet(const ExtentWorkspace& workspace, const WitnessPair& witness, double tolerance) {
  const Eigen::Vector3d displacement = witness.point_a_in_a - workspace.origin;
  if (std::abs(workspace.normal.dot(displacement)) > tolerance) return false;
  // One point of A can be equally near to two places of B: the set leads to B along its normal.
  const Eigen::Vector3d between = witness.point_b_in_a - witness.point_a_in_a;
  const Eigen::Vector3d beside = between - workspace.normal.dot(between) * workspace.normal;
  if (workspace.normal.dot(between) < 0.0 || beside.squaredNorm() > 4.0 * workspace.reach * workspace.reach) {
    return false;
  }
  const Eigen::Vector2d point(workspace.axis_x.dot(displacement), workspace.axis_y.dot(displacement));
  return std::any_of(
      workspace.pieces.begin(), workspace.pieces.end(), [&](const ExtentWorkspace::Piece& piece) {
        const Eigen::Vector2d nearest = detail::nearestIn(&workspace.points[piece.first], piece.count, point);
        return (nearest - point).squaredNorm() <= 4.0 * workspace.reach * workspace.reach;
      });
}

// On one plateau: at one distance, and one on the set around the other.
bool isOnePlateau(const BenchmarkPair& pair, const Eigen::Isometry3d& pose, const WitnessPair& l,
                  const WitnessPair& r, double size) {
  constexpr double kTolerance = 1e-9;
  if (std::abs(std::sqrt(l.squared_distance) - std::sqrt(r.squared_distance)) > 2.0 * kTolerance * size) {
    return false;
  }
  ExtentWorkspace workspace;
  const auto holds = [&](const WitnessPair& around, const WitnessPair& witness) {
    const NicheExtent extent =
        measureExtent(*pair.a, *pair.b, pose, around, kTolerance * size, 1024, workspace);
    return extent.kind != NicheKind::Point && isOnMeasuredSet(workspace, witness, 2.0 * kTolerance * size);
  };
  return holds(l, r) || holds(r, l);
}

}  // namespace

bool isSameNiche(const BenchmarkPair& pair, const Eigen::Isometry3d& pose, const WitnessPair& found,
                 const WitnessPair& reference, double least_prominence) {
  const detail::PairFrame frame = detail::PairFrame::withFacets(*pair.a, *pair.b, pose);
  const double tolerance = frame.samePlaceTolerance();
  if ((found.point_a_in_a - reference.point_a_in_a).norm() <= tolerance &&
      (found.point_b_in_a - reference.point_b_in_a).norm() <= tolerance) {
    return true;
  }
  if (isOnePlateau(pair, pose, found, reference, frame.diameters())) {
    return true;
  }
  std::vector<MinimumCandidate> seeds{frame.candidateOf(found), frame.candidateOf(reference)};
  detail::NicheDecider decider;
  detail::NicheDecider::Request request;
  request.rule.least_prominence = least_prominence;
  WorkLimit none;
  decider.judge(frame, seeds, request, none);
  const auto niche_of = [&](const WitnessPair& witness) {
    return decider.locate(frame, {witness.triangle_a, witness.triangle_b}, request, none);
  };
  return niche_of(found) == niche_of(reference);
}

RecallCount countRecall(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                        const std::vector<WitnessPair>& found, const std::vector<ReferenceNiche>& references,
                        double cutoff, double least_prominence) {
  std::vector<int> hits(references.size(), 0);
  RecallCount count;
  for (const WitnessPair& niche : found) {
    bool met = false;
    for (std::size_t i = 0; i < references.size() && !met; ++i) {
      if (isSameNiche(pair, pose, niche, references[i].witness, least_prominence)) {
        ++hits[i];
        met = true;
      }
    }
    count.others += !met && niche.squared_distance <= cutoff * cutoff ? 1 : 0;
  }
  for (const int hit : hits) {
    count.recalled += hit > 0 ? 1 : 0;
    count.duplicates += hit > 1 ? static_cast<std::size_t>(hit - 1) : 0;
  }
  return count;
}

}  // namespace concave_distance::benchmark
