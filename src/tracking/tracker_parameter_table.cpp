#include "tracker_parameter_table.h"

#include <utility>

namespace concave_distance {
namespace {

constexpr double kLeastMemory = 1048576.0;  // bytes, smaller than the first buffers of a pair

using T = TrackerParameters;

ParameterTable<T> ofTheProof() {
  const std::vector<std::pair<std::string, AccuracyLevel>> levels = {{"nodes", AccuracyLevel::Nodes},
                                                                     {"refined", AccuracyLevel::Refined},
                                                                     {"certified", AccuracyLevel::Certified},
                                                                     {"complete", AccuracyLevel::Complete}};
  return {
      choice<T>(
          "accuracy", levels, [](auto& t) -> auto& { return t.accuracy; },
          "`nodes`: between grid nodes; `refined`: exact on the triangles around every niche; `certified`: "
          "the same, and the distance proven in every cycle; `complete`: every niche below the cutoff "
          "proven"),
      number<T>(
          "absolute_tolerance", [](auto& t) -> auto& { return t.absolute_tolerance; },
          "for `certified` and `complete`: how far the proven lower bound may stay below the distance")
          .inUnit("m")
          .atRunTime(),
      number<T>(
          "relative_tolerance", [](auto& t) -> auto& { return t.relative_tolerance; },
          "the same as a share of the distance; the larger of the two applies")
          .to(1.0)
          .atRunTime(),
      limit<T>(
          "time_budget", [](auto& t) -> auto& { return t.time_budget; },
          "time from the start of a pair's solve after which it ends with the results so far, effects "
          "included")
          .inUnit("s")
          .above(0.0)
          .atRunTime(),
  };
}

ParameterTable<T> ofTheNiches() {
  return {
      limit<T>(
          "cutoff", [](auto& t) -> auto& { return t.cutoff; },
          "niches farther than this are not reported, and pairs farther apart are not solved")
          .inUnit("m")
          .above(0.0)
          .atRunTime(),
      number<T>(
          "least_prominence", [](auto& t) -> auto& { return t.least_prominence; },
          "a niche with less prominence is merged into a deeper neighbour")
          .atRunTime(),
      count<T>(
          "largest_niche_count", [](auto& t) -> auto& { return t.largest_niche_count; },
          "niches reported per pair; a cut is reported")
          .from(1.0)
          .atRunTime(),
      flag<T>(
          "keep_through_material", [](auto& t) -> auto& { return t.keep_through_material; },
          "report niches whose segment runs through material too, flagged"),
      count<T>(
          "seed", [](auto& t) -> auto& { return t.seed; },
          "of the random streams: one seed gives one answer, for any number of threads"),
  };
}

ParameterTable<T> expertParameters() {
  return {
      count<T>(
          "memory_limit", [](auto& t) -> auto& { return t.memory_limit; },
          "working memory for the solve of one pair; a solve that needs more ends with the results so far")
          .inUnit("bytes")
          .from(kLeastMemory),
      limit<T>(
          "prominence_limit", [](auto& t) -> auto& { return t.prominence_limit; },
          "for `complete`: prominences are measured up to this; `none`: all below the cutoff"),
      number<T>(
          "inherited_per_niche", [](auto& t) -> auto& { return t.inherited_per_niche; },
          "trial points that a niche hands on to the next cycle")
          .from(1.0),
      count<T>(
          "inherited_limit", [](auto& t) -> auto& { return t.inherited_limit; },
          "inherited trial points in all"),
      count<T>(
          "random_starts", [](auto& t) -> auto& { return t.random_starts; },
          "random trial points that a warm cycle descends as well"),
      number<T>(
          "search_motion", [](auto& t) -> auto& { return t.search_motion; },
          "a warm cycle searches for new niches when the bodies have moved against each other by this many "
          "grid edges since the last search ..."),
      count<T>(
          "search_interval", [](auto& t) -> auto& { return t.search_interval; },
          "... or after this many cycles; 1: in every cycle")
          .from(1.0),
      count<T>(
          "swept_cones", [](auto& t) -> auto& { return t.swept_cones; },
          "groups of four normal cones that a warm cycle compares to find niches that the search has not "
          "found, in proportion to the motion; more: new niches are found earlier; 0: none"),
      count<T>(
          "reviewed_niches", [](auto& t) -> auto& { return t.reviewed_niches; },
          "niches whose prominence a warm cycle decides again, in turn; the nearest besides in every cycle"),
      count<T>(
          "projected_niches", [](auto& t) -> auto& { return t.projected_niches; },
          "niches of which a warm cycle asks, in turn, whether the other body has a closer place"),
      count<T>(
          "projected_nodes", [](auto& t) -> auto& { return t.projected_nodes; },
          "random nodes that a warm cycle projects onto the other body and back; a cold one 16 times as "
          "many"),
      flag<T>(
          "extrapolate", [](auto& t) -> auto& { return t.extrapolate; },
          "start from where the relative velocity has carried the witness points"),
  };
}

}  // namespace

const ParameterTable<TrackerParameters>& trackerParameters() {
  static const ParameterTable<TrackerParameters> table = [] {
    ParameterTable<TrackerParameters> all = joined<T>({ofTheProof(), ofTheNiches()});
    for (Parameter<TrackerParameters>& parameter : expertParameters()) {
      all.push_back(std::move(parameter.forExperts()));
    }
    return all;
  }();
  return table;
}

}  // namespace concave_distance
