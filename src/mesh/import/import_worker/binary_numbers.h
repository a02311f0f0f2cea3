#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace concave_distance::detail {

/// The unsigned number that up to eight bytes hold.
inline std::uint64_t wholeNumber(std::string_view bytes, bool little_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    value = (value << 8U) | static_cast<unsigned char>(bytes[little_endian ? bytes.size() - 1 - i : i]);
  }
  return value;
}

/// The IEEE 754 number of four or eight bytes.
inline double brokenNumber(std::string_view bytes, bool little_endian) {
  const std::uint64_t bits = wholeNumber(bytes, little_endian);
  if (bytes.size() == 4) {
    const auto half = static_cast<std::uint32_t>(bits);
    float value = 0.0F;
    std::memcpy(&value, &half, sizeof value);
    return static_cast<double>(value);
  }
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace concave_distance::detail
