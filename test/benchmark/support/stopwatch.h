#pragma once

#include <chrono>

namespace concave_distance::benchmark {

inline double microsecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace concave_distance::benchmark
