#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
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
};

/// Fills `count` rows, each in the order in which its values come.
/// @param for_each (visit) calls visit(row, value) for each value, the same at both calls
template <typename T, typename ForEach>
CompressedRows<T> compressedRows(std::size_t count, const ForEach& for_each) {
  CompressedRows<T> rows;
  rows.offsets.assign(count + 1, 0);
  for_each([&](std::uint32_t row, const T&) { ++rows.offsets[row + 1]; });
  std::partial_sum(rows.offsets.begin(), rows.offsets.end(), rows.offsets.begin());
  rows.values.resize(rows.offsets.back());
  std::vector<std::uint32_t> place(rows.offsets.begin(), rows.offsets.end() - 1);
  for_each([&](std::uint32_t row, const T& value) { rows.values[place[row]++] = value; });
  return rows;
}

}  // namespace concave_distance
