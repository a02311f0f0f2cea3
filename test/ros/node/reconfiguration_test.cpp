#include "ros/node/reconfiguration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "concave_distance/base/error.h"

namespace concave_distance::reconfiguration_test {
namespace {

using Config = ConcaveDistanceConfig;

void expectRefusal(const std::string& parameter, const std::function<void(Config&)>& change) {
  Config config = Config::__getDefault__();
  change(config);
  try {
    checkConfig(config);
    ADD_FAILURE() << parameter;
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "~" + parameter);
  }
}

TEST(Reconfiguration, RefusesWhatIsOutOfRangeAndNamesIt) {
  for (const double value : {-1.0, std::nan(""), -std::numeric_limits<double>::infinity()}) {
    expectRefusal("cutoff", [&](Config& config) { config.cutoff = std::to_string(value); });
    expectRefusal("time_budget", [&](Config& config) { config.time_budget = std::to_string(value); });
    expectRefusal("rate", [&](Config& config) { config.rate = value; });
    expectRefusal("marker_rate", [&](Config& config) { config.marker_rate = value; });
    expectRefusal("absolute_tolerance", [&](Config& config) { config.absolute_tolerance = value; });
    expectRefusal("relative_tolerance", [&](Config& config) { config.relative_tolerance = value; });
    expectRefusal("least_prominence", [&](Config& config) { config.least_prominence = value; });
  }
  for (const int value : {-1, 0}) {
    expectRefusal("largest_niche_count", [&](Config& config) { config.largest_niche_count = value; });
  }
}

TEST(Reconfiguration, TakesTheEndsOfTheRangesThatClientsAreShown) {
  EXPECT_NO_THROW(checkConfig(Config::__getDefault__()));
  EXPECT_NO_THROW(checkConfig(lowestConfig()));
  EXPECT_NO_THROW(checkConfig(highestConfig()));
}

TEST(Reconfiguration, IsNotClampedBeforeTheNodeSeesIt) {
  Config config = Config::__getDefault__();
  config.least_prominence = -1.0;
  config.rate = 1e9;
  config.largest_niche_count = -5;
  config.__clamp__();
  EXPECT_EQ(config.least_prominence, -1.0);
  EXPECT_EQ(config.rate, 1e9);
  EXPECT_EQ(config.largest_niche_count, -5);
}

}  // namespace
}  // namespace concave_distance::reconfiguration_test
