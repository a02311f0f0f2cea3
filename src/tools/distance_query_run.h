#pragma once

#include <cstdint>
#include <iosfwd>
#include <limits>
#include <optional>
#include <string>

#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance::tools {

struct DistanceQueryOptions {
  std::string mesh_a;
  std::string mesh_b;
  std::string poses;
  double scale_a = 1.0;
  double scale_b = 1.0;
  AccuracyLevel accuracy = AccuracyLevel::Certified;
  double cutoff = std::numeric_limits<double>::infinity();  ///< metres; of the niches
  double absolute_tolerance = 0.0;                          ///< metres; of level `certified`
  double relative_tolerance = 0.0;                          ///< of the distance; of level `certified`
  double least_prominence = 1e-2;
  double prominence_limit = 0.0;                                 ///< of level `complete`
  double time_budget = std::numeric_limits<double>::infinity();  ///< seconds per query
  std::optional<double> max_edge_length;                         ///< metres; grid of the search, both bodies
  std::string cache;  ///< folder of prepared bodies; empty: the user's, "off": none
  bool tracking = false;
  std::uint64_t seed = 1;
  std::string output;
  std::string niches_output;  ///< empty: niches are not asked for
};

/// Answers every line of `poses`; what was found while loading goes to `log`.
/// @throws Error naming the file, for tracking also the line, that is at fault
void runDistanceQuery(const DistanceQueryOptions& options, std::ostream& log);

}  // namespace concave_distance::tools
