#pragma once

#include <cmath>
#include <string>

#include "base/number_text.h"

namespace concave_distance {

/// Returns seconds to the millisecond for messages: 3, 0.25, 2.048.
inline std::string secondsText(double seconds) {
  constexpr int kDigits = 15;
  return numberText(std::round(1e3 * seconds) / 1e3, kDigits);
}

}  // namespace concave_distance
