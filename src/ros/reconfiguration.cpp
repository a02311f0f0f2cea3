#include "concave_distance/ros/reconfiguration.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace concave_distance {

ConcaveDistanceConfig toConfig(const NodeParameters& parameters) {
  ConcaveDistanceConfig config = ConcaveDistanceConfig::__getDefault__();
  const TrackerParameters& tracker = parameters.pair.tracker;
  config.rate = parameters.rate;
  config.marker_rate = parameters.marker_rate;
  config.publish_markers = parameters.publish_markers;
  config.publish_contact_markers = parameters.publish_contact_markers;
  config.absolute_tolerance = tracker.absolute_tolerance;
  config.relative_tolerance = tracker.relative_tolerance;
  config.time_budget = std::isfinite(tracker.time_budget) ? tracker.time_budget : 0.0;
  config.cutoff = std::isfinite(tracker.cutoff) ? tracker.cutoff : 0.0;
  config.least_prominence = tracker.least_prominence;
  config.largest_niche_count = static_cast<int>(tracker.largest_niche_count);
  config.warm_population_size = static_cast<int>(tracker.warm.population_size);
  config.warm_generations = static_cast<int>(tracker.warm.max_generations);
  config.immigrants = static_cast<int>(tracker.immigrants);
  return config;
}

ConcaveDistanceConfig lowestConfig() {
  ConcaveDistanceConfig config = ConcaveDistanceConfig::__getDefault__();
  config.rate = config.marker_rate = 0.1;
  config.publish_markers = config.publish_contact_markers = false;
  config.absolute_tolerance = config.relative_tolerance = 0.0;
  config.time_budget = config.cutoff = config.least_prominence = 0.0;
  config.largest_niche_count = 1;
  config.warm_population_size = 2;
  config.warm_generations = config.immigrants = 0;
  return config;
}

ConcaveDistanceConfig highestConfig() {
  ConcaveDistanceConfig config = ConcaveDistanceConfig::__getDefault__();
  config.rate = 2000.0;
  config.marker_rate = 200.0;
  config.publish_markers = config.publish_contact_markers = true;
  config.absolute_tolerance = config.time_budget = config.cutoff = 1e6;
  config.relative_tolerance = 1.0;
  config.least_prominence = 1e3;
  config.largest_niche_count = 100'000;
  config.warm_population_size = config.warm_generations = config.immigrants = 10'000;
  return config;
}

// The values are read like private parameters, so that the ranges are defined only once.
void checkConfig(const ConcaveDistanceConfig& config) {
  XmlRpc::XmlRpcValue values;
  values["rate"] = config.rate;
  values["marker_rate"] = config.marker_rate;
  values["absolute_tolerance"] = config.absolute_tolerance;
  values["relative_tolerance"] = config.relative_tolerance;
  values["time_budget"] = config.time_budget;
  values["cutoff"] = config.cutoff;
  values["least_prominence"] = config.least_prominence;
  values["largest_niche_count"] = config.largest_niche_count;
  values["warm_population_size"] = config.warm_population_size;
  values["warm_generations"] = config.warm_generations;
  values["immigrants"] = config.immigrants;
  std::vector<std::string> unknown;
  parseNodeParameters(values, unknown);
}

void applyChanges(const ConcaveDistanceConfig& before, const ConcaveDistanceConfig& after,
                  PairSettings& settings) {
  TrackerParameters& tracker = settings.tracker;
  if (after.absolute_tolerance != before.absolute_tolerance) {
    tracker.absolute_tolerance = after.absolute_tolerance;
  }
  if (after.relative_tolerance != before.relative_tolerance) {
    tracker.relative_tolerance = after.relative_tolerance;
  }
  if (after.time_budget != before.time_budget) {
    tracker.time_budget =
        after.time_budget == 0.0 ? std::numeric_limits<double>::infinity() : after.time_budget;
  }
  if (after.cutoff != before.cutoff) {
    tracker.cutoff = after.cutoff == 0.0 ? std::numeric_limits<double>::infinity() : after.cutoff;
  }
  if (after.least_prominence != before.least_prominence) {
    tracker.least_prominence = after.least_prominence;
  }
  const auto assign = [](int was, int is, std::uint32_t& value) {
    if (is != was) {
      value = static_cast<std::uint32_t>(is);
    }
  };
  assign(before.largest_niche_count, after.largest_niche_count, tracker.largest_niche_count);
  assign(before.warm_population_size, after.warm_population_size, tracker.warm.population_size);
  assign(before.warm_generations, after.warm_generations, tracker.warm.max_generations);
  assign(before.immigrants, after.immigrants, tracker.immigrants);
}

bool concernsPairs(const ConcaveDistanceConfig& before, const ConcaveDistanceConfig& after) {
  return after.absolute_tolerance != before.absolute_tolerance ||
         after.relative_tolerance != before.relative_tolerance || after.time_budget != before.time_budget ||
         after.cutoff != before.cutoff || after.least_prominence != before.least_prominence ||
         after.largest_niche_count != before.largest_niche_count ||
         after.warm_population_size != before.warm_population_size ||
         after.warm_generations != before.warm_generations || after.immigrants != before.immigrants;
}

}  // namespace concave_distance
