#include "random_engine.h"

namespace concave_distance {
namespace {

std::uint64_t splitMix(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

constexpr std::uint64_t rotateLeft(std::uint64_t x, unsigned k) {
  return (x << k) | (x >> (64U - k));
}

}  // namespace

RandomEngine::RandomEngine(std::uint64_t seed) : state_{} {
  for (std::uint64_t& word : state_) {
    word = splitMix(seed);
  }
}

RandomEngine::result_type RandomEngine::operator()() {
  const std::uint64_t result = rotateLeft(state_[1] * 5, 7) * 9;
  const std::uint64_t t = state_[1] << 17U;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= t;
  state_[3] = rotateLeft(state_[3], 45);
  return result;
}

std::uint32_t uniformIndex(RandomEngine& engine, std::uint32_t count) {
  std::uint64_t product = (engine() >> 32U) * count;
  auto low = static_cast<std::uint32_t>(product);
  if (low < count) {
    const std::uint32_t threshold = (0U - count) % count;
    while (low < threshold) {
      product = (engine() >> 32U) * count;
      low = static_cast<std::uint32_t>(product);
    }
  }
  return static_cast<std::uint32_t>(product >> 32U);
}

double uniformUnit(RandomEngine& engine) {
  return static_cast<double>(engine() >> 11U) * 0x1.0p-53;
}

std::uint64_t streamSeed(std::uint64_t seed, std::string_view pair_name, std::uint64_t cycle) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a over the name
  for (const char c : pair_name) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  std::uint64_t state = seed;
  state = splitMix(state) ^ hash;
  state = splitMix(state) ^ cycle;
  return splitMix(state);
}

}  // namespace concave_distance
