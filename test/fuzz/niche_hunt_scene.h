#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/niche_families.h"

namespace concave_distance::test {

struct NicheFailure {
  std::size_t cycle;
  bool is_tracked;  ///< wrong in the tracker alone; else the cold answer is wrong
  std::string parameters;
  std::string complaint;
};

struct NicheHuntResult {
  std::size_t poses = 0;
  std::size_t niches = 0;  ///< listed by the cold answers
  /// Poses at which the package's list is that of the enumeration at a pose 4 ulp away and not at the pose
  /// itself.
  std::size_t borderline = 0;
  std::vector<NicheFailure> failures;
};

/// Scene number `scene` of a family: the same in every run with this seed.
NicheScene drawNicheScene(const NicheFamily& family, std::uint64_t seed, std::uint64_t scene);

/// Solves every pose cold and tracked, where count, cutoff, hidden, prominence and the wish for niches change
/// from cycle to cycle, and compares both with the enumeration.
/// @param with_margins the bodies have margins, which change too
NicheHuntResult huntScene(const NicheScene& scene, std::uint64_t seed, bool with_margins = false);

}  // namespace concave_distance::test
