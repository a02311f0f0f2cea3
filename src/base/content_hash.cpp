#include "content_hash.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <vector>

namespace concave_distance {
namespace {

constexpr std::size_t kBlockSize = std::size_t{1} << 20U;

std::uint64_t rotateLeft(std::uint64_t value, unsigned bits) {
  return (value << bits) | (value >> (64U - bits));
}

std::uint64_t finalMix(std::uint64_t k) {
  k ^= k >> 33U;
  k *= 0xff51afd7ed558ccdULL;
  k ^= k >> 33U;
  k *= 0xc4ceb9fe1a85ec53ULL;
  return k ^ (k >> 33U);
}

struct State {
  std::uint64_t low;
  std::uint64_t high;

  void mixLow(std::uint64_t k) { low ^= rotateLeft(k * 0x87c37b91114253d5ULL, 31) * 0x4cf5ad432745937fULL; }
  void mixHigh(std::uint64_t k) { high ^= rotateLeft(k * 0x4cf5ad432745937fULL, 33) * 0x87c37b91114253d5ULL; }
  void mix(std::uint64_t k1, std::uint64_t k2) {
    mixLow(k1);
    low = (rotateLeft(low, 27) + high) * 5 + 0x52dce729U;
    mixHigh(k2);
    high = (rotateLeft(high, 31) + low) * 5 + 0x38495ab5U;
  }
};

ContentKey hashBlock(const unsigned char* data, std::size_t size, const ContentKey& seed) {
  State state{seed.low, seed.high};
  std::array<std::uint64_t, 2> words{};
  std::size_t at = 0;
  for (; at + sizeof(words) <= size; at += sizeof(words)) {
    std::memcpy(words.data(), data + at, sizeof(words));
    state.mix(words[0], words[1]);
  }
  if (at < size) {
    words = {};
    std::memcpy(words.data(), data + at, size - at);
    state.mixHigh(words[1]);
    state.mixLow(words[0]);
  }
  state.low ^= size;
  state.high ^= size;
  state.low += state.high;
  state.high += state.low;
  state.low = finalMix(state.low);
  state.high = finalMix(state.high);
  state.low += state.high;
  state.high += state.low;
  return {state.low, state.high};
}

}  // namespace

std::string ContentKey::text() const {
  std::array<char, 33> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx%016llx", static_cast<unsigned long long>(high),
                static_cast<unsigned long long>(low));
  return digits.data();
}

ContentKey hashBytes(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  if (size <= kBlockSize) {
    return hashBlock(bytes, size, {});
  }
  std::vector<ContentKey> blocks((size + kBlockSize - 1) / kBlockSize);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.size()),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        const std::size_t first = i * kBlockSize;
                        blocks[i] = hashBlock(bytes + first, std::min(kBlockSize, size - first), {});
                      }
                    });
  ContentHasher whole;
  for (const ContentKey& block : blocks) whole.add(block);
  return whole.key();
}

ContentHasher& ContentHasher::addBytes(const void* data, std::size_t size) {
  if (size > kBlockSize) {
    const ContentKey piece = hashBytes(data, size);
    const std::array<std::uint64_t, 3> summary{piece.low, piece.high, size};
    key_ = hashBlock(reinterpret_cast<const unsigned char*>(summary.data()), sizeof(summary), key_);
  } else {
    key_ = hashBlock(static_cast<const unsigned char*>(data), size, key_);
  }
  return *this;
}

}  // namespace concave_distance
