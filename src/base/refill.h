#pragma once

#include <cstddef>
#include <vector>

namespace concave_distance {

/// vector::assign() that grows to twice what is needed, so that a buffer used again and again settles.
template <typename T>
void refill(std::vector<T>& buffer, std::size_t count, const T& value) {
  if (buffer.capacity() < count) buffer.reserve(2 * count);
  buffer.assign(count, value);
}

/// The same for copy assignment.
template <typename T>
void refill(std::vector<T>& buffer, const std::vector<T>& values) {
  if (buffer.capacity() < values.size()) buffer.reserve(2 * values.size());
  buffer.assign(values.begin(), values.end());
}

}  // namespace concave_distance
