#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace concave_distance {

/// A list of lists in two contiguous arrays (compressed sparse row form).
template <typename T>
struct CompressedRows {
  std::vector<std::uint32_t> offsets;  ///< row count + 1 entries
  std::vector<T> values;

  struct Row {
    const T* first;
    const T* last;
    const T* begin() const { return first; }
    const T* end() const { return last; }
    std::size_t size() const { return static_cast<std::size_t>(last - first); }
    bool empty() const { return first == last; }
    const T& operator[](std::size_t i) const { return first[i]; }
  };
  Row row(std::size_t i) const { return {values.data() + offsets[i], values.data() + offsets[i + 1]}; }
  std::size_t memoryBytes() const {
    return offsets.capacity() * sizeof(std::uint32_t) + values.capacity() * sizeof(T);
  }
};

}  // namespace concave_distance
