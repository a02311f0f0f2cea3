// Threads of the background give way to the thread that starts them, whatever priority it has.
#include "base/give_way.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

namespace concave_distance::give_way_test {
namespace {

id_t thisThread() {
  return static_cast<id_t>(syscall(SYS_gettid));
}

void setSteps(int steps) {
  ASSERT_EQ(setpriority(PRIO_PROCESS, thisThread(), steps), 0);
}

int steps() {
  return getpriority(PRIO_PROCESS, thisThread());
}

TEST(GiveWay, IsFiveStepsBelowTheThreadThatBeganIt) {
  const int own = steps();
  for (const int more : {0, 3, 8, 19}) {
    const int begin = std::min(own + more, 19);
    std::thread([begin] {
      setSteps(begin);
      giveWay();
      EXPECT_EQ(steps(), std::min(begin + 5, 19));
    }).join();
  }
}

// A thread of real-time priority gives its own to those that it starts, and among these no nice value counts.
TEST(GiveWay, LeavesRealTimePriority) {
  bool may_be_real_time = true;
  std::thread([&] {
    sched_param parameters{};
    parameters.sched_priority = 1;
    may_be_real_time = sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
    if (!may_be_real_time) return;
    const int own = steps();
    giveWay();
    EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);
    EXPECT_EQ(steps(), std::min(own + 5, 19));
  }).join();
  if (!may_be_real_time) GTEST_SKIP() << "no right to real-time priority";
}

}  // namespace
}  // namespace concave_distance::give_way_test
