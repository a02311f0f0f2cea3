#pragma once

#include <exception>
#include <utility>

namespace concave_distance {

/// Logs that an exception ended a callback; for each callback once in five seconds.
/// @param reason nullptr: the exception is no std::exception
void reportEscape(const char* callback, const char* reason) noexcept;

/// Runs the body of a callback and logs an exception, because one that leaves a callback ends the process.
/// @param callback its name, for the log
/// @return false after an exception
template <typename Body>
bool guarded(const char* callback, Body&& body) noexcept {
  try {
    std::forward<Body>(body)();
    return true;
  } catch (const std::exception& problem) {
    reportEscape(callback, problem.what());
  } catch (...) {
    reportEscape(callback, nullptr);
  }
  return false;
}

}  // namespace concave_distance
