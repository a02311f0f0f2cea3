#include "tracker_parameter_table.h"

#include <utility>

namespace concave_distance {
namespace {

constexpr double kLeastFacetPairs = 1000.0;  // a pair of simple bodies needs no more

using T = TrackerParameters;

ParameterTable<T> ofTheProof() {
  const std::vector<std::pair<std::string, AccuracyLevel>> levels = {{"nodes", AccuracyLevel::Nodes},
                                                                     {"refined", AccuracyLevel::Refined},
                                                                     {"certified", AccuracyLevel::Certified},
                                                                     {"complete", AccuracyLevel::Certified}};
  return {
      choice<T>(
          "accuracy", levels, [](auto& t) -> auto& { return t.accuracy; },
          "`nodes`: between grid nodes; `refined`: exact on the triangles around every niche found; "
          "`certified`: the distance and every niche below the cutoff proven in every cycle (`complete`: the "
          "same)"),
      number<T>(
          "absolute_tolerance", [](auto& t) -> auto& { return t.absolute_tolerance; },
          "for `certified`: how far the proven lower bound may stay below the distance")
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
          "hidden", [](auto& t) -> auto& { return t.hidden; },
          "report niches whose segment meets a surface too, flagged"),
      count<T>(
          "seed", [](auto& t) -> auto& { return t.seed; },
          "of the random streams: one seed gives one answer, for any number of threads"),
  };
}

ParameterTable<T> expertParameters() {
  return {
      count<T>(
          "facet_pair_limit", [](auto& t) -> auto& { return t.facet_pair_limit; },
          "facet pairs that a stage of a pair's solve may hold at once, at most 250 bytes each; a solve that "
          "needs "
          "more ends with the results so far")
          .from(kLeastFacetPairs),
      limit<T>(
          "prominence_limit", [](auto& t) -> auto& { return t.prominence_limit; },
          "prominences are measured up to this; `none`: all below the cutoff"),
      flag<T>(
          "keep_through_material", [](auto& t) -> auto& { return t.keep_through_material; },
          "report niches whose segment runs through material too, flagged"),
      flag<T>(
          "signed_values", [](auto& t) -> auto& { return t.signed_values; },
          "give each niche a signed value through contact, with its gradient: the distance, or minus the "
          "depth of the overlap"),
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
          "search_share", [](auto& t) -> auto& { return t.search_share; },
          "for `certified`: work of the genetic search as a share of all other, for more than two "
          "individuals; 0: no search")
          .to(1.0),
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

const ParameterTable<TrackerParameters>& marginParameters() {
  static const ParameterTable<T> table = {
      number<T>(
          "margin_a", [](auto& t) -> auto& { return t.margin_a; },
          "how far A's surface is moved out: a ball of this radius is swept along it")
          .inUnit("m"),
      number<T>(
          "margin_b", [](auto& t) -> auto& { return t.margin_b; }, "the same for B")
          .inUnit("m"),
  };
  return table;
}

}  // namespace concave_distance
