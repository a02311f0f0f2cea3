#pragma once

#include <Eigen/Geometry>
#include <variant>
#include <vector>

#include "base/random_engine.h"
#include "first_guess.h"
#include "island_workspaces.h"
#include "niche_motion.h"
#include "search_method.h"
#include "thesis/src/genetic/comb_ga.h"
#include "thesis/src/genetic/niche_identification.h"

namespace concave_distance::evaluation {

/// comb-GA along a motion, and nothing else (Carretero, sec. 6.2.2): a search at every instant, whose first
/// population inherits from the niches of the last one's final population. No archive, no niche is followed.
class InheritingSearch {
 public:
  /// All but `workspace` and the bodies are copied.
  /// @param first what searches at the first instant: a GA or islands of one
  /// @param further the same at all others
  InheritingSearch(const SearchMethod& first, const SearchMethod& further, const FirstGuess& guess,
                   const BodyMesh& a, const BodyMesh& b, std::uint64_t seed, SearchWorkspace& workspace);

  GeneticResult search(const Eigen::Isometry3d& a_from_b);
  /// Of the final population, the nearest first.
  const std::vector<IdentifiedNiche>& niches() const { return niches_; }

 private:
  /// Of one instant.
  struct Step {
    SearchMethod method;
    NicheRadii radii;

    const CombGaParameters& genetic() const;
  };
  GeneticResult run(const PairObjective& objective, Step& step);
  void handOn(const Step& next);

  Step first_;
  Step further_;
  bool is_first_ = true;
  FirstGuess guess_;
  const BodyMesh* a_;
  const BodyMesh* b_;
  RandomEngine engine_;
  SearchWorkspace* workspace_;
  IslandWorkspaces islands_;
  NicheMotion motion_;
  std::vector<IdentifiedNiche> niches_;
  std::vector<TrialPoint> known_;
  std::vector<TrialPoint> inherited_;
  std::vector<double> scratch_;
};

/// The parameters of a GA, alone or on islands; null for any other method.
const CombGaParameters* geneticOf(const SearchMethod& method);

}  // namespace concave_distance::evaluation
