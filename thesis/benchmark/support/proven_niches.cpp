#include "thesis/benchmark/support/proven_niches.h"

#include <algorithm>
#include <cmath>

#include "concave_distance/tracking/pair_tracker.h"
#include "distance/kernels/witness_refinement.h"
#include "search/grid/body_grid.h"

namespace concave_distance::benchmark {

std::vector<TrackedNiche> provenNiches(const std::string& name, const std::shared_ptr<const BodyMesh>& a,
                                       const std::shared_ptr<const BodyMesh>& b,
                                       const Eigen::Isometry3d& pose) {
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Certified;
  parameters.hidden = true;
  parameters.least_prominence = 1e-2;
  parameters.largest_niche_count = 10000;
  parameters.niches_wanted = true;
  PairSolution solution = solveOnce(name, a, b, parameters, pose);
  const double smaller = std::min(a->diameter(), b->diameter());
  const double cutoff = std::max(5.0 * solution.distance, 0.25 * smaller);
  std::vector<TrackedNiche> niches;
  for (const TrackedNiche& niche : solution.niches) {
    // A prominence that was too high to be measured is not a number.
    if (niche.distance <= cutoff && !(niche.prominence < 1e-2)) niches.push_back(niche);
  }
  return niches;
}

double shareMet(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& pose,
                const std::vector<TrackedNiche>& niches, const std::vector<TrialPoint>& minima) {
  if (niches.empty()) return 1.0;
  const double size = std::min(a.diameter(), b.diameter());
  RefinementWorkspace workspace;
  std::vector<bool> met(niches.size());
  for (const TrialPoint& minimum : minima) {
    const WitnessPair found = refineWitness(a, b, pose, gridOf(a).nodes().originalTriangle(minimum.node_a),
                                            gridOf(b).nodes().originalTriangle(minimum.node_b), workspace)
                                  .witness;
    for (std::size_t i = 0; i < met.size(); ++i) {
      const TrackedNiche& niche = niches[i];
      if (std::abs(std::sqrt(found.squared_distance) - niche.distance) > 1e-6 * size) continue;
      if (niche.extent > 0.0 || (found.point_a_in_a - niche.point_a_in_a).norm() < 1e-3 * size) met[i] = true;
    }
  }
  return static_cast<double>(std::count(met.begin(), met.end(), true)) / static_cast<double>(met.size());
}

}  // namespace concave_distance::benchmark
