#include "concave_distance/scene/warning_monitor.h"

#include <gtest/gtest.h>

#include <limits>

#include "concave_distance/base/error.h"
#include "scene/set_warning_distance.h"

namespace concave_distance::warning_monitor_test {
namespace {

constexpr double kWarning = 0.10;
constexpr double kHysteresis = 0.02;

TEST(WarningMonitor, RaisesBelowTheWarningDistanceAndClearsAboveTheHysteresis) {
  WarningMonitor monitor;
  EXPECT_FALSE(monitor.update(0.11, kWarning, kHysteresis));
  EXPECT_EQ(monitor.state(), WarningState::Clear);
  EXPECT_TRUE(monitor.update(0.09, kWarning, kHysteresis));
  EXPECT_EQ(monitor.state(), WarningState::Warning);
  EXPECT_FALSE(monitor.update(0.11, kWarning, kHysteresis)) << "inside the hysteresis nothing changes";
  EXPECT_EQ(monitor.state(), WarningState::Warning);
  EXPECT_TRUE(monitor.update(0.121, kWarning, kHysteresis));
  EXPECT_EQ(monitor.state(), WarningState::Clear);
}

TEST(WarningMonitor, ChattersNotWhileTheDistanceTremblesAroundTheWarningDistance) {
  WarningMonitor monitor;
  int changes = 0;
  for (int i = 0; i < 100; ++i) {
    changes += monitor.update(i % 2 == 0 ? 0.099 : 0.101, kWarning, kHysteresis) ? 1 : 0;
  }
  EXPECT_EQ(changes, 1);
}

TEST(WarningMonitor, IsUnknownWithoutADistanceAndRemembersTheStateBefore) {
  WarningMonitor monitor;
  monitor.update(0.05, kWarning, kHysteresis);
  EXPECT_TRUE(monitor.update(std::nullopt, kWarning, kHysteresis));
  EXPECT_EQ(monitor.state(), WarningState::Unknown);
  EXPECT_FALSE(monitor.update(std::nullopt, kWarning, kHysteresis));
  EXPECT_TRUE(monitor.update(0.11, kWarning, kHysteresis));
  EXPECT_EQ(monitor.state(), WarningState::Warning) << "0.11 alone would not have raised it";
  monitor.reset();
  EXPECT_EQ(monitor.state(), WarningState::Clear);
}

TEST(WarningMonitor, ComesBackClearWhenItWasClearBeforeTheGap) {
  WarningMonitor monitor;
  monitor.update(std::nullopt, kWarning, kHysteresis);
  EXPECT_TRUE(monitor.update(0.11, kWarning, kHysteresis));
  EXPECT_EQ(monitor.state(), WarningState::Clear);
}

Scene threePairs() {
  Scene scene;
  for (const char* name : {"arm/table", "arm/shelf", "hand/shelf"}) {
    ScenePair pair;
    pair.name = name;
    scene.pairs.push_back(pair);
  }
  return scene;
}

TEST(SetWarningDistance, SetsAndTakesAwayWhatAPatternMatches) {
  Scene scene = threePairs();
  EXPECT_EQ(setWarningDistance(scene, "*/shelf", 0.1, 0.02),
            (std::vector<std::string>{"arm/shelf", "hand/shelf"}));
  EXPECT_FALSE(scene.pairs[0].settings.warning_distance);
  EXPECT_EQ(scene.pairs[2].settings.warning_distance, 0.1);
  EXPECT_EQ(scene.pairs[2].settings.warning_hysteresis, 0.02);
  EXPECT_EQ(setWarningDistance(scene, "hand/shelf", std::nullopt, 0.0).size(), 1U);
  EXPECT_FALSE(scene.pairs[2].settings.warning_distance);
  EXPECT_TRUE(scene.pairs[1].settings.warning_distance);
}

TEST(SetWarningDistance, RefusesLengthsThatMeanNothingAndUnknownPairsAndChangesNothing) {
  Scene scene = threePairs();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {-0.1, nan, infinity, -infinity}) {
    EXPECT_THROW(setWarningDistance(scene, "*", bad, 0.0), Error) << bad;
    EXPECT_THROW(setWarningDistance(scene, "*", 0.1, bad), Error) << bad;
  }
  EXPECT_THROW(setWarningDistance(scene, "leg/*", 0.1, 0.0), Error);
  for (const ScenePair& pair : scene.pairs) EXPECT_FALSE(pair.settings.warning_distance);
}

TEST(SetWarningDistance, RefusesAPatternThatIsTooLongWithoutRepeatingIt) {
  Scene scene = threePairs();
  EXPECT_EQ(setWarningDistance(scene, std::string(4096, '*'), 0.1, 0.0).size(), 3U);
  try {
    setWarningDistance(scene, std::string(4097, '*'), 0.2, 0.0);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    const std::string refusal = error.what();
    EXPECT_NE(refusal.find("4097 characters"), std::string::npos) << refusal;
    EXPECT_LT(refusal.size(), 200U);
  }
  EXPECT_EQ(scene.pairs[0].settings.warning_distance, 0.1);
}

}  // namespace
}  // namespace concave_distance::warning_monitor_test
