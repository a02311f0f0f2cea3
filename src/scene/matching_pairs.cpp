#include "matching_pairs.h"

#include "concave_distance/base/error.h"
#include "name_pattern.h"

namespace concave_distance::detail {
std::vector<std::size_t> matchingPairs(const Scene& scene, const std::string& pattern) {
  requirePatternLength(pattern, "pair");
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const std::string& name = scene.pairs[i].name;
    if (name == pattern || matchesPattern(pattern, name)) found.push_back(i);
  }
  if (found.empty()) {
    throw Error("pair", "there is no pair '" + pattern + "'",
                "list_bodies has their names; * matches any characters, ? one");
  }
  return found;
}

}  // namespace concave_distance::detail
