#pragma once

#include <exception>
#include <utility>

namespace concave_distance {

/// Logs that a callback was ended by an exception; of each callback once in five seconds.
/// @param reason nullptr: not even a std::exception
void reportEscape(const char* callback, const char* reason) noexcept;

/// Runs the body of a callback. An exception is logged and ends here: past a callback's border it would end
/// the process. @param callback its name, for the log. @return false after an exception
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
