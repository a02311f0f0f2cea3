#pragma once

#include <string>

namespace concave_distance {

/// Returns the wanted name, or where that is taken the first of `<wanted>_2`, `<wanted>_3` ... that is not.
template <typename IsTaken>
std::string freeName(const std::string& wanted, const IsTaken& is_taken) {
  std::string name = wanted;
  for (int copy = 2; is_taken(name); ++copy) name = wanted + "_" + std::to_string(copy);
  return name;
}

}  // namespace concave_distance
