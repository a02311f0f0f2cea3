#pragma once

#include <chrono>

namespace concave_distance::python {

/// Lets Ctrl-C end a loop that runs without the interpreter's lock.
class SignalCheck {
 public:
  /// Looks for signals ten times a second. @throws pybind11::error_already_set, e.g. KeyboardInterrupt
  void operator()();

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace concave_distance::python
