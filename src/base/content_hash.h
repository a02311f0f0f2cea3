#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace concave_distance {

/// 128 bits that stand for some content: equal contents have equal keys, others do not by all odds. Not made
/// against somebody who wants two contents to have one key.
struct ContentKey {
  std::uint64_t low = 0;
  std::uint64_t high = 0;

  friend bool operator==(const ContentKey& l, const ContentKey& r) {
    return l.low == r.low && l.high == r.high;
  }
  friend bool operator!=(const ContentKey& l, const ContentKey& r) { return !(l == r); }
  /// 32 hexadecimal digits.
  std::string text() const;
};

/// XXH3 with 128 bits (Y. Collet). O(size), some GB/s.
ContentKey hashBytes(const void* data, std::size_t size);

/// Puts a key together from several pieces; their order and their sizes count.
class ContentHasher {
 public:
  ContentHasher& addBytes(const void* data, std::size_t size);
  ContentHasher& add(std::string_view text) { return addBytes(text.data(), text.size()); }
  /// Numbers and enumerations, by their bits.
  template <typename T, typename = std::enable_if_t<std::is_arithmetic_v<T> || std::is_enum_v<T>>>
  ContentHasher& add(T value) {
    return addBytes(&value, sizeof(value));
  }
  ContentHasher& add(const ContentKey& key) { return add(key.low).add(key.high); }
  const ContentKey& key() const { return key_; }

 private:
  ContentKey key_;
};

}  // namespace concave_distance
