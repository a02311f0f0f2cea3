#include "base/content_hash.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <xxhash.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace concave_distance::content_hash_test {
namespace {

TEST(ContentHash, DependsOnOrderSizesAndEveryByteAndNotOnThreads) {
  const auto key_of = [](std::string_view first, std::string_view second) {
    return ContentHasher().add(first).add(second).key();
  };
  EXPECT_EQ(key_of("ab", "c"), key_of("ab", "c"));
  EXPECT_NE(key_of("ab", "c"), key_of("a", "bc"));
  EXPECT_NE(key_of("a", "b"), key_of("b", "a"));
  EXPECT_NE(key_of("", "a"), key_of("a", ""));
  EXPECT_NE(ContentHasher().add(0.0).key(), ContentHasher().add(-0.0).key());
  std::vector<unsigned char> bytes(3'000'001);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(i * i);
  const ContentKey whole = hashBytes(bytes.data(), bytes.size());
  for (const std::size_t threads : {1U, 2U, 3U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(hashBytes(bytes.data(), bytes.size()), whole);
  }
  for (const std::size_t i : {0U, 1'048'575U, 1'048'576U, 3'000'000U}) {
    bytes[i] ^= 1U;
    EXPECT_NE(hashBytes(bytes.data(), bytes.size()), whole) << i;
    bytes[i] ^= 1U;
  }
  EXPECT_NE(hashBytes(bytes.data(), bytes.size() - 1), whole);
}

// Before version 0.8 the values of XXH3 were not final, and others.
#if XXH_VERSION_NUMBER >= 800
TEST(ContentHash, IsXxh3) {
  // As `xxhsum -H2` gives it.
  const std::string text = "The quick brown fox jumps over the lazy dog";
  EXPECT_EQ(hashBytes(text.data(), text.size()).text(), "ddd650205ca3e7fa24a1cc2e3a8a7651");
  EXPECT_EQ(hashBytes(text.data(), 0).text(), "99aa06d3014798d86001c324468d497f");
}
#endif

}  // namespace
}  // namespace concave_distance::content_hash_test
