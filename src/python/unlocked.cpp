#include "unlocked.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace concave_distance::python {
namespace {

constexpr std::chrono::seconds kLongestWait{2};
constexpr std::chrono::milliseconds kBetweenLooks{5};

std::atomic<int> unlocked_threads{0};  // that do not sleep
std::atomic<bool> is_ending{false};
std::thread::id ending_thread;  // written before is_ending

void end() {
  ending_thread = std::this_thread::get_id();
  is_ending = true;
  const pybind11::gil_scoped_release released;
  const auto deadline = std::chrono::steady_clock::now() + kLongestWait;
  while (unlocked_threads > 0 && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(kBetweenLooks);
}

}  // namespace

Unlocked::Unlocked() : state_(PyEval_SaveThread()) {
  ++unlocked_threads;
}

Unlocked::~Unlocked() {
  sleepWhereInterpreterEnds();
  --unlocked_threads;
  PyEval_RestoreThread(state_);
}

bool isInterpreterEnding() {
  return is_ending && std::this_thread::get_id() != ending_thread;
}

void sleepWhereInterpreterEnds() {
  if (!isInterpreterEnding()) return;
  --unlocked_threads;
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

void watchEndOfInterpreter() {
  pybind11::module::import("atexit").attr("register")(pybind11::cpp_function(&end));
}

}  // namespace concave_distance::python
