#include "helper_threads.h"

#include <tbb/parallel_for.h>
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

}  // namespace

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
  tbb::parallel_for(std::size_t{0}, stages.size(), [&](std::size_t i) {
    try {
      stages.begin()[i]();
    } catch (...) {
      thrown[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
}

}  // namespace concave_distance
