#pragma once

#include <pybind11/pybind11.h>

namespace concave_distance::python {

/// Releases the interpreter's lock while it lives. When the interpreter ends meanwhile, a thread that would
/// take the lock again sleeps until the process is gone: Python would end it through frames of C++.
class Unlocked {
 public:
  Unlocked();
  ~Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* state_;
};

/// Returns whether the interpreter ends, and this is another thread than the one that ends it.
bool isInterpreterEnding();
/// Sleeps until the process is gone where isInterpreterEnding(). Before Python's lock is taken.
void sleepWhereInterpreterEnds();
/// Lets the end of the interpreter wait for threads that solve, for two seconds at most.
void watchEndOfInterpreter();

}  // namespace concave_distance::python
