#include "base/run_together.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

namespace concave_distance::run_together_test {
namespace {

std::size_t runs(std::size_t helpers) {
  std::atomic<std::size_t> count{0};
  runWithHelpers(helpers, [&] { ++count; });
  return count;
}

TEST(RunWithHelpers, RunsTheWorkOnEveryThreadAndWaitsForAll) {
  EXPECT_EQ(runs(0), 1U);
  EXPECT_EQ(runs(3), 4U);
}

// Leaves address space for a few stacks of threads.
void limitAddressSpace() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t bytes = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{20} << 20U);
  const rlimit limit{bytes, bytes};
  if (setrlimit(RLIMIT_AS, &limit) != 0) std::_Exit(2);
}

TEST(RunWithHelpersDeathTest, GoesOnWithTheThreadsThatThereAre) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need the address space";
#endif
  const auto with_few_threads = [] {
    limitAddressSpace();
    std::atomic<std::size_t> count{0};
    runWithHelpers(1000, [&] {
      ++count;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));  // its stack stays taken
    });
    std::_Exit(count > 1 && count < 1000 ? 0 : 3);
  };
  EXPECT_EXIT(with_few_threads(), ::testing::ExitedWithCode(0), "");
}

// Waits until the other stage runs too, or for five seconds.
bool meet(std::atomic<int>& here) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  ++here;
  while (here < 2 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  return here == 2;
}

TEST(OwnThreads, StagesRunBesideEachOtherWithoutAWorker) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto meet_and_exit = [] {
    std::atomic<int> here{0};
    bool met = true;
    {
      const OwnThreads own;
      runTogether({[&] { met = meet(here) && met; }, [&] { meet(here); }});
    }
    const std::filesystem::directory_iterator threads("/proc/self/task");
    std::_Exit(met ? static_cast<int>(std::distance(begin(threads), end(threads))) : 99);
  };
  EXPECT_EXIT(meet_and_exit(), ::testing::ExitedWithCode(1), "");
}

TEST(OwnThreads, WhatTheFirstStageThrowsArrivesOnceAllHaveEnded) {
  const OwnThreads own;
  std::atomic<int> ended{0};
  try {
    runTogether({[&] { ++ended; }, [&] { throw 2; }, [&] { throw 3; }, [&] { ++ended; }});
    ADD_FAILURE() << "nothing was thrown";
  } catch (int stage) {
    EXPECT_EQ(stage, 2);
  }
  EXPECT_EQ(ended, 2);
}

}  // namespace
}  // namespace concave_distance::run_together_test
