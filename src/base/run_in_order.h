#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>

#include "thread_team.h"

namespace concave_distance {

namespace detail {

template <std::size_t Count, typename Work, typename Take>
class RunInOrder {
 public:
  RunInOrder(std::size_t count, const Work& work, const Take& take)
      : count_(count), work_(work), take_(take), team_(*ThreadTeam::current()) {}

  void run(std::size_t threads) {
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(
          std::size_t{0}, std::min(threads, count_), [&](std::size_t) { team_.share([&] { goOn(); }); },
          tbb::simple_partitioner());
    });
    takeReady();
  }

 private:
  void goOn() {
    for (std::size_t i = next_++; i < count_; i = next_++) {
      work_(i);
      ready_[i] = true;
      if (taking_.exchange(true)) continue;
      takeReady();
      taking_ = false;
    }
  }
  void takeReady() {
    while (taken_ < count_ && ready_[taken_]) take_(taken_++);
  }

  std::size_t count_;
  const Work& work_;
  const Take& take_;
  ThreadTeam& team_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> taking_{false};
  std::size_t taken_ = 0;  ///< of the thread that takes
  std::array<std::atomic<bool>, Count> ready_{};
};

}  // namespace detail

/// Calls work(i) for every i below `count`, on idle threads of the caller's arena as well, and take(i) one
/// after the other, in their order, each as soon as work(i) has ended. While the caller waits, it begins
/// nothing else of its arena. Allocates nothing itself.
/// @param count at most `Count`
/// @param threads at most so many, the caller included
template <std::size_t Count, typename Work, typename Take>
void runInOrder(std::size_t count, std::size_t threads, const Work& work, const Take& take) {
  if (threads > 1 && count > 1) {
    detail::RunInOrder<Count, Work, Take>(count, work, take).run(threads);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    work(i);
    take(i);
  }
}

}  // namespace concave_distance
