#include "versions.h"

#include <gnu/libc-version.h>

#include <Eigen/Core>
#include <utility>
#if __has_include(<tbb/version.h>)
#include <tbb/version.h>
#else
#include <tbb/tbb_stddef.h>
#endif

namespace concave_distance {

std::string packageVersion() {
  return CONCAVE_DISTANCE_VERSION;
}

std::string versionsText() {
  const auto joined = [](int major, int minor) {
    return std::to_string(major) + "." + std::to_string(minor);
  };
#ifdef __clang__
  const std::string compiler = __VERSION__;
#else
  const std::string compiler = std::string("GCC ") + __VERSION__;
#endif
#ifdef __x86_64__
  const std::string processor = "x86_64";
#elif defined(__aarch64__)
  const std::string processor = "aarch64";
#else
  const std::string processor = "other";
#endif
  const std::pair<const char*, std::string> versions[] = {
      {"concave_distance", packageVersion()},
      {"compiler", compiler},
      {"processor", processor},
      {"Eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + joined(EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"TBB", joined(TBB_VERSION_MAJOR, TBB_VERSION_MINOR)},
      {"C library", gnu_get_libc_version()}};
  std::string text;
  for (const auto& [part, version] : versions) {
    if (!text.empty()) text += '\n';
    text.append(part).append(" ").append(version);
  }
  return text;
}

}  // namespace concave_distance
