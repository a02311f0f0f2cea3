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

}  // namespace concave_distance
