#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "base/random_engine.h"
#include "search/genetic_search.h"
#include "search/niche_identification.h"
#include "tracking/warm_start.h"

namespace concave_distance::evaluation {

/// comb-GA along a motion, and nothing else (Carretero, sec. 6.2.2): a search at every instant, whose first
/// population inherits from the niches of the last one's final population. No archive, no niche is followed.
class InheritingSearch {
 public:
  /// All but `workspace` and the bodies are copied.
  InheritingSearch(const GeneticParameters& parameters, const Inheritance& inheritance, const BodyMesh& a,
                   const BodyMesh& b, std::uint64_t seed, SearchWorkspace& workspace);

  GeneticResult search(const Eigen::Isometry3d& a_from_b);
  /// Of the final population, the nearest first.
  const std::vector<IdentifiedNiche>& niches() const { return workspace_->niches; }

 private:
  GeneticParameters parameters_;
  Inheritance inheritance_;
  const BodyMesh* a_;
  const BodyMesh* b_;
  RandomEngine engine_;
  SearchWorkspace* workspace_;
  NicheRadii radii_;
  std::vector<TrialPoint> known_;
  std::vector<TrialPoint> inherited_;
  std::vector<double> scratch_;
};

}  // namespace concave_distance::evaluation
