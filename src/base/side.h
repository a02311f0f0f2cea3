#pragma once

#include <cstdint>

namespace concave_distance {

enum class Side : std::uint8_t { A = 0, B = 1 };

}  // namespace concave_distance
