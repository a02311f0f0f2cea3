#pragma once

#include <atomic>
#include <chrono>
#include <functional>

namespace concave_distance::python {

/// Lets Ctrl-C end a loop that runs without the interpreter's lock.
class SignalCheck {
 public:
  /// Looks for signals ten times a second. @throws pybind11::error_already_set, e.g. KeyboardInterrupt
  void operator()();

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Runs work in a thread of its own while this one, without the interpreter's lock, waits and looks for
/// signals. A signal's exception sets `stop`, which the work is to obey, until the work has ended, and is
/// thrown then.
void runWatched(const std::function<void()>& work, std::atomic<bool>& stop);

}  // namespace concave_distance::python
