#pragma once

#include <cstddef>
#include <cstdint>

#include "concave_distance/base/indices.h"

namespace concave_distance {

/// Two indices as one number; which is the first matters.
template <typename Tag>
constexpr std::uint64_t pairKey(Index<Tag> a, Index<Tag> b) {
  return (std::uint64_t{a.value} << 32U) | b.value;
}

/// Returns the slot of a key in a table of 2^(64 - shift) slots, `shift` in [1, 63], by Fibonacci hashing
/// (Knuth, The Art of Computer Programming 3, section 6.4): the product's upper bits depend on every bit of
/// the key.
constexpr std::size_t slotOfKey(std::uint64_t key, std::uint32_t shift) {
  return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> shift);
}

}  // namespace concave_distance
