#include "content_hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cstdio>

namespace concave_distance {

std::string ContentKey::text() const {
  std::array<char, 33> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx%016llx", static_cast<unsigned long long>(high),
                static_cast<unsigned long long>(low));
  return digits.data();
}

ContentKey hashBytes(const void* data, std::size_t size) {
  const XXH128_hash_t hash = XXH3_128bits(data, size);
  return {hash.low64, hash.high64};
}

ContentHasher& ContentHasher::addBytes(const void* data, std::size_t size) {
  const ContentKey piece = hashBytes(data, size);
  const std::array<std::uint64_t, 5> summary{key_.low, key_.high, piece.low, piece.high, size};
  key_ = hashBytes(summary.data(), sizeof(summary));
  return *this;
}

}  // namespace concave_distance
