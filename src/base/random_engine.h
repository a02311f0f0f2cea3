#pragma once

#include <cstdint>
#include <string_view>

namespace concave_distance {

/// Small, fast generator with the same stream on every platform (xoshiro256**, Blackman and Vigna 2018).
/// Satisfies UniformRandomBitGenerator. Draw through the functions below: standard distributions differ
/// between libraries.
class RandomEngine {
 public:
  using result_type = std::uint64_t;
  explicit RandomEngine(std::uint64_t seed);
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }
  result_type operator()();

 private:
  std::uint64_t state_[4];
};

/// Uniform in [0, count); count >= 1. Unbiased (Lemire 2019).
std::uint32_t uniformIndex(RandomEngine& engine, std::uint32_t count);

/// Uniform in [0, 1).
double uniformUnit(RandomEngine& engine);

/// Seed of an independent stream, keyed by the scene's seed, the pair's name and the cycle, never by a
/// thread: one seed gives one answer whatever the number of threads.
std::uint64_t streamSeed(std::uint64_t seed, std::string_view pair_name, std::uint64_t cycle);

}  // namespace concave_distance
