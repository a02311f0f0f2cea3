#include "run_together.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace concave_distance {
namespace {

struct JoinedThreads {
  std::vector<std::thread> threads;
  ~JoinedThreads() {
    for (std::thread& thread : threads) {
      thread.join();
    }
  }
};

thread_local int own_threads = 0;

}  // namespace

OwnThreads::OwnThreads() {
  ++own_threads;
}

OwnThreads::~OwnThreads() {
  --own_threads;
}

void runWithHelpers(std::size_t helpers, const std::function<void()>& work) {
  JoinedThreads joined;
  try {
    while (joined.threads.size() < helpers) {
      joined.threads.emplace_back(std::cref(work));
    }
  } catch (const std::exception&) {
    // No more threads, or no memory for them.
  }
  work();
}

void runTogether(std::initializer_list<std::function<void()>> stages) {
  std::vector<std::exception_ptr> thrown(stages.size());
  const auto run = [&](std::size_t i) {
    try {
      stages.begin()[i]();
    } catch (...) {
      thrown[i] = std::current_exception();
    }
  };
  if (own_threads > 0) {
    std::atomic<std::size_t> next{0};
    runWithHelpers(stages.size() - 1, [&] {
      tbb::task_arena alone(1);
      for (std::size_t i = next++; i < stages.size(); i = next++) alone.execute([&] { run(i); });
    });
  } else {
    tbb::parallel_for(std::size_t{0}, stages.size(), run);
  }
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
}

}  // namespace concave_distance
