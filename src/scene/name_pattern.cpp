#include "name_pattern.h"

#include <fnmatch.h>

namespace concave_distance::detail {

bool isPattern(const std::string& text) {
  return text.find_first_of("*?[") != std::string::npos;
}

bool matchesPattern(const std::string& pattern, const std::string& name) {
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

}  // namespace concave_distance::detail
