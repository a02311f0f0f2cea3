#pragma once

#include <cmath>
#include <fstream>
#include <string>

namespace concave_distance::benchmark {

/// Resident memory of this program, MB. @param key VmRSS: now; VmHWM: the most so far
inline double residentMegabytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0.0;
    if (word == key + ":" && status >> kilobytes) return kilobytes / 1024.0;
  }
  return std::nan("");
}

}  // namespace concave_distance::benchmark
