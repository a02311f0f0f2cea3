#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "concave_distance/scene/scene.h"

namespace concave_distance::tools {

/// The tool's defaults: more niches than any scene of rigid bodies has shown; a cut is logged.
inline PairSettings querySettings() {
  PairSettings settings;
  settings.tracker.largest_niche_count = 1000;
  return settings;
}

struct DistanceQueryOptions {
  std::string mesh_a;
  std::string mesh_b;
  std::string poses;
  double scale_a = 1.0;
  double scale_b = 1.0;
  PairSettings settings = querySettings();
  std::optional<double> max_edge_length;  ///< metres; grid of the search, both bodies
  std::string cache;                      ///< folder of prepared bodies; empty: the user's, "off": none
  bool tracking = false;
  std::string output;
  std::string niches_output;  ///< empty: niches are not asked for
};

/// Answers every line of `poses`; what was found while loading goes to `log`.
/// @throws Error naming the file, for tracking also the line, that is at fault
void runDistanceQuery(const DistanceQueryOptions& options, std::ostream& log);

}  // namespace concave_distance::tools
