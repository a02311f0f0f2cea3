#include "concave_distance/scene/warning_monitor.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace concave_distance::warning_monitor_test
