#include "helper_threads.h"

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

}  // namespace concave_distance
