#include "signal_check.h"

#include <pybind11/pybind11.h>

#include <future>

#include "unlocked.h"

namespace concave_distance::python {
namespace {

constexpr std::chrono::milliseconds kBetweenChecks{100};

void checkSignals() {
  sleepWhereInterpreterEnds();
  const pybind11::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
}

}  // namespace

void SignalCheck::operator()() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < kBetweenChecks) return;
  last_ = now;
  checkSignals();
}

void runWatched(const std::function<void()>& work, std::atomic<bool>& stop) {
  std::future<void> done = std::async(std::launch::async, work);
  while (done.wait_for(kBetweenChecks) != std::future_status::ready) {
    if (isInterpreterEnding()) {
      stop = true;
      done.wait();
    }
    try {
      checkSignals();
    } catch (...) {
      stop = true;
      done.wait();
      stop = false;
      throw;
    }
  }
  done.get();
}

}  // namespace concave_distance::python
