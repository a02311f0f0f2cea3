#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "arrays.h"
#include "concave_distance/scene/scene_tracker.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance::python {

/// A row of Answers.rows: PairSolution without its lists. Metres, seconds, A's frame.
struct AnswerRow {
  double distance;
  double lower_bound;
  double signed_distance;
  Triple point_a;
  Triple point_b;
  Triple normal;
  double closing_speed;
  double solve_seconds;
  std::int64_t triangle_a;  ///< where surfaces meet, a triangle of A that meets triangle_b of B; else -1
  std::int64_t triangle_b;
  std::uint8_t accuracy;  ///< AccuracyLevel that was reached
  std::uint8_t status;    ///< SolveStatus
  bool niches_complete;
  bool niches_cut;
};

/// A row of Answers.niches: TrackedNiche. Metres, A's frame.
struct NicheRow {
  std::uint64_t id;
  double distance;
  double signed_distance;
  Triple point_a;
  Triple point_b;
  Triple normal;
  double closing_speed;
  double extent;
  double prominence;
  Triple signed_point_a;
  Triple signed_point_b;
  Triple signed_pivot;
  Triple signed_gradient;
  std::uint64_t signed_since_cycle;
  std::uint64_t birth_cycle;
  std::uint8_t signed_state;  ///< SignedState
  std::uint8_t kind;          ///< NicheKind
  std::uint8_t outward;       ///< Outwardness
  std::uint8_t origin;        ///< NicheOrigin
  bool visible;
  bool proven_local_minimum;
};

/// Answers of one pair at many poses, or of many pairs in one cycle, as Python reads them.
struct Answers {
  std::vector<AnswerRow> rows;
  std::vector<NicheRow> niches;  ///< of all rows, one after the other
  std::vector<std::int64_t> niche_offsets = {0};

  void append(const PairSolution& solution);
};

struct SceneAnswers : Answers {
  /// @param due_alone pairs that were not due in the last cycle have no row
  SceneAnswers(const SceneTracker& tracker, bool due_alone);

  std::vector<std::string> pairs;      ///< names
  std::vector<std::int64_t> bodies;    ///< A and B of each pair, in Scene.body_names
  std::vector<std::uint8_t> states;    ///< PairState
  std::vector<double> bounds;          ///< metres, proven by boxes where the pair is beyond its cutoff
  std::vector<std::uint8_t> warnings;  ///< 1: below the warning distance
  std::uint64_t beyond;                ///< pairs by rule without a row, being beyond their cutoff
};

}  // namespace concave_distance::python
