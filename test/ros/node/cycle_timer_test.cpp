#include "ros/node/cycle_timer.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

namespace concave_distance::cycle_timer_test {
namespace {

bool comesTrue(const std::function<bool()>& condition, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition() && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return condition();
}

class CycleTimerTest : public ::testing::Test {
 protected:
  CycleTimerTest() {
    ros::Time::init();
    ros::Time::setNow(ros::Time(0));  // simulated from now on
  }
  ~CycleTimerTest() override { ros::Time::init(); }

  // The clock goes on from `start` in steps of three periods until calls come again.
  bool callsGoOnFrom(const ros::Time& start) {
    const int before = calls;
    for (int step = 0; step < 15; ++step) {
      ros::Time::setNow(start + ros::Duration(0.3 * step));
      if (comesTrue([&] { return calls > before; }, 1.0)) return true;
    }
    return false;
  }
  std::atomic<int> calls{0};
  CycleTimer timer{[this](std::int64_t /*due*/) { ++calls; }};
};

TEST_F(CycleTimerTest, FollowsASimulatedClockOverEveryJump) {
  timer.start(10.0);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(calls, 0) << "simulated time has not begun";
  for (const std::uint32_t seconds : {1000U, 4'000'000'000U, 4'294'967'290U, 10U, 2'147'483'647U, 5U}) {
    EXPECT_TRUE(callsGoOnFrom(ros::Time(seconds, 0))) << seconds;
  }
}

TEST_F(CycleTimerTest, StandsAtTheLastTimeThatRosCanCount) {
  timer.start(10.0);
  ros::Time::setNow(ros::Time(4'294'967'295U, 999'999'999U));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // nothing can come after this time
  EXPECT_TRUE(callsGoOnFrom(ros::Time(1, 0)));
}

TEST_F(CycleTimerTest, TakesAnotherRate) {
  timer.start(0.1);
  timer.setRate(10.0);
  EXPECT_TRUE(callsGoOnFrom(ros::Time(100, 0)));
}

}  // namespace
}  // namespace concave_distance::cycle_timer_test
