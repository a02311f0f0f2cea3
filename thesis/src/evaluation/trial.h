#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "experiment.h"
#include "scene_truth.h"

namespace concave_distance::evaluation {

/// Sums over runs at one generation or iteration; averages are made when all runs are there.
struct CurvePoint {
  double best_distance = 0.0;  ///< metres
  double mean_square = 0.0;    ///< of the population: average objective, square metres
  double niches = 0.0;         ///< of the population, by greedy identification
  double acceptance = 0.0;     ///< p_b, of annealing
};

/// A node pair, each point in its body's frame.
struct IndividualPoints {
  double distance = 0.0;  ///< metres
  Eigen::Vector3d point_a;
  Eigen::Vector3d point_b;
};

/// What one run gave (Carretero, sec. 5.1). Along a motion distance, counts, cost, shares and time are means
/// over its instants.
struct TrialRecord {
  double distance = 0.0;             ///< of the best node pair, metres
  std::uint32_t best_iteration = 0;  ///< G_i
  /// Counts for Phi*: the best node pair there is, or for who answers with points of the surfaces the exact
  /// distance; at every instant.
  bool exact = false;
  /// An individual of some generation stood on the best node pair. The same as `exact` but for Baldwinian
  /// searches at one pose, whose answer is the local minimum below an individual.
  bool standing = false;
  bool region = false;  ///< counts for Phi: within the region of the optimum, at every instant
  /// In the region of the optimum by place alone, at any distance: a descent over the nodes from the
  /// answer ends in it. Of runs at one pose.
  bool basin = false;
  double niches = 0.0;  ///< N_Gamma of the final population
  static constexpr std::size_t kNicheCount = 10;
  std::array<std::uint32_t, kNicheCount> members{};   ///< individuals of the nearest niches
  std::array<double, kNicheCount> niche_distances{};  ///< of the same, metres; 0: there are no more
  double best_convergence = 0.0;                      ///< (5.1) over f*_global
  double population_convergence = 0.0;                ///< (5.2) over f*_global
  /// Nearer than the second niche, in its bodies or not: what Table 5.12 counts besides.
  bool below_second = false;
  bool feasible = true;  ///< of the continuous approach: both points lie in their bodies
  SearchCost cost;
  std::uint64_t flops = 0;  ///< by the thesis's rule: 26 a point pair, 6 a constraint (App. D, sec. 2.1.4)
  double microseconds = 0.0;
  double recall = 0.0;          ///< of the outward niches that are proven, in the final population
  double archive_recall = 0.0;  ///< the same of all local minima that the run has met
  double precision = 0.0;       ///< niches of the final population that are one of those, each counted once
  double nearest = 0.0;         ///< 1 where the nearest of those niches is among the minima met
  std::uint32_t wrong_instants = 0;  ///< where the answer is not `exact`
  double worst_excess = 0.0;         ///< of the distance over the one that is, metres
  std::uint32_t most_niches = 0;     ///< at one instant
  /// Instants at which the proof found a nearer place than every niche that the search had met.
  std::uint32_t proof_finds = 0;
  /// The best point pair of the final population, each point in its body's frame. Of runs at one pose.
  Eigen::Vector3d point_a = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d point_b = point_a;
  std::vector<IndividualPoints> population;  ///< of the first run, where the experiment keeps it
};

/// Iterations between two points of a curve: every generation of a GA, every tenth iteration of annealing.
std::uint32_t curveStride(const Method& method);

/// Runs of a row on a scene.
/// @param first_run from 0; a run's number names its stream of random numbers, the same for every row
/// @param curve sums that these runs are added to; null: none
std::vector<TrialRecord> runTrials(const Experiment& experiment, std::size_t row, std::size_t scene,
                                   const SceneTruth& truth, std::uint32_t first_run, std::uint32_t count,
                                   SearchWorkspace& workspace, std::vector<CurvePoint>* curve);

}  // namespace concave_distance::evaluation
