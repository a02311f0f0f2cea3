#include "scene/lateness_monitor.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace concave_distance::lateness_monitor_test {
namespace {

constexpr double kWanted = 50.0;

// Cycles at a steady rate, looked at five times a second; what the monitor says meanwhile.
class LatenessMonitorTest : public testing::Test {
 protected:
  std::vector<std::string> run(double seconds, double rate, double late_share, double clock_speed = 1.0) {
    std::vector<std::string> news;
    for (double t = 0.0; t < seconds; t += 0.2) {
      cycles_ += 0.2 * rate * clock_speed;
      late_ += 0.2 * rate * clock_speed * late_share;
      sample_.wall += 0.2;
      sample_.ros_time += 0.2 * clock_speed;
      sample_.cycles = static_cast<std::uint64_t>(cycles_);
      sample_.late = static_cast<std::uint64_t>(late_);
      sample_.wanted_rate = kWanted;
      if (const auto said = monitor_.update(sample_)) news.push_back(said->text);
    }
    return news;
  }

  LatenessMonitor monitor_;
  LatenessSample sample_;
  double cycles_ = 0.0;
  double late_ = 0.0;
};

TEST_F(LatenessMonitorTest, SaysNothingWhileCyclesAreOnTime) {
  EXPECT_TRUE(run(60.0, kWanted, 0.02).empty());
}

TEST_F(LatenessMonitorTest, SaysOnceThatCyclesAreLateAndOnceThatTheyAreNotAnyMore) {
  const auto late = run(60.0, 10.0, 1.0);
  ASSERT_EQ(late.size(), 1U);
  EXPECT_NE(late[0].find("10 cycles a second instead of 50"), std::string::npos) << late[0];
  const auto well = run(60.0, kWanted, 0.0);
  ASSERT_FALSE(well.empty());
  EXPECT_NE(well.back().find("on time again"), std::string::npos) << well.back();
  EXPECT_FALSE(monitor_.isLate());
}

TEST_F(LatenessMonitorTest, SaysAgainWhenItGetsMuchWorseOrMuchBetter) {
  EXPECT_EQ(run(30.0, 20.0, 1.0).size(), 1U);
  const auto worse = run(30.0, 3.0, 1.0);
  ASSERT_FALSE(worse.empty());
  EXPECT_NE(worse.back().find("even later"), std::string::npos) << worse.back();
  const auto better = run(30.0, 20.0, 1.0);
  ASSERT_FALSE(better.empty());
  EXPECT_NE(better.back().find("but less"), std::string::npos) << better.back();
}

TEST_F(LatenessMonitorTest, ACycleThatDoesNotEndIsNoticed) {
  const auto news = run(30.0, 0.0, 0.0);
  ASSERT_EQ(news.size(), 1U);
  EXPECT_NE(news[0].find("no cycle has finished"), std::string::npos) << news[0];
}

// Bodies are made ready in the first cycles.
TEST_F(LatenessMonitorTest, AnOrdinaryStartIsNotLate) {
  for (const double slow : {0.4, 0.8, 2.0, 4.8}) {
    for (const double before : {0.2, 2.4, 4.6}) {
      monitor_.restart();
      std::vector<std::string> news = run(before, kWanted, 0.0);
      for (const auto& later : {run(slow, 0.0, 0.0), run(30.0, kWanted, 0.0)}) {
        news.insert(news.end(), later.begin(), later.end());
      }
      EXPECT_TRUE(news.empty()) << slow << " s, " << before << " s after the start: " << news.front();
    }
  }
}

TEST_F(LatenessMonitorTest, AClockThatStartsOrJumpsIsNotLate) {
  EXPECT_TRUE(run(8.0, kWanted, 0.0, 0.0).empty()) << "no /clock yet";
  for (const double jump : {1.7e9, 60.0, 3.0}) {
    sample_.ros_time += jump;
    const auto news = run(8.0, kWanted, 0.0);
    EXPECT_TRUE(news.empty()) << "after " << jump << " s: " << news.front();
  }
}

TEST_F(LatenessMonitorTest, AFastSimulationThatCannotBeFollowedIsLate) {
  const auto news = run(30.0, 5.0, 1.0, 10.0);
  ASSERT_EQ(news.size(), 1U);
  EXPECT_NE(news[0].find("5 cycles a second instead of 50"), std::string::npos) << news[0];
}

TEST_F(LatenessMonitorTest, AClockThatStandsStillIsNotLate) {
  EXPECT_TRUE(run(60.0, kWanted, 0.0, 0.0).empty());
}

TEST_F(LatenessMonitorTest, ASlowSimulationIsNotLate) {
  EXPECT_TRUE(run(60.0, kWanted, 0.0, 0.1).empty());
}

}  // namespace
}  // namespace concave_distance::lateness_monitor_test
