#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "concave_distance/tracking/niche_archive.h"
#include "concave_distance/tracking/pair_geometry.h"

namespace concave_distance {

/// Which vertex, edge or face a witness lies on: the same for every triangle that shares it.
struct FeatureKey {
  Feature kind = Feature::Face;
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  bool operator==(const FeatureKey& other) const {
    return kind == other.kind && first == other.first && second == other.second;
  }
};
FeatureKey featureKey(const SurfaceMesh& surface, TriangleIndex triangle, Feature feature);

std::array<FeatureKey, 2> featuresOf(const PairGeometry& geometry, const WitnessPair& witness);

/// A local minimum that is no niche of its own: its prominence is below the least, so that it belongs to a
/// deeper niche. Tessellated valleys are full of them, and the next one may be the deeper in the next cycle.
struct Ripple {
  WitnessPair witness;
  std::array<FeatureKey, 2> features;
  std::uint64_t owner = 0;   ///< id of the niche it belongs to
  std::uint64_t judged = 0;  ///< cycle in which its prominence was last looked at
  std::uint64_t walked = 0;  ///< cycle in which its surroundings were last looked at, plus 1; 0: never
};

/// The ripples of one pair, a fixed number at the most; those longest not judged give way.
class RippleMemory {
 public:
  /// Room for all ripples of a pair, entries.
  static constexpr std::size_t kCapacity = 64;

  void clear() { ripples_.clear(); }
  std::vector<Ripple>& ripples() { return ripples_; }

  /// The ripple on the same features, or null.
  Ripple* find(const PairGeometry& geometry, const WitnessPair& witness);
  /// Enters a witness or judges it again.
  void remember(const PairGeometry& geometry, const WitnessPair& witness, std::uint64_t owner,
                std::uint64_t cycle);
  /// Moves the ripples of one niche to their minima at the geometry's pose; those that have run together, or
  /// into `deepest`, become one. The others stay as they were.
  void follow(std::uint64_t owner, const WitnessPair& deepest, PairGeometry& geometry);

 private:
  std::vector<Ripple> ripples_;
};

/// Looks for the ripples next to a local minimum: from each vertex around its witness on either body, a walk
/// over the other body towards it; the closest few that lie elsewhere are refined from beyond the vertex and
/// appended. Bounded: at most 48 vertices a body.
void stepOverRipples(PairGeometry& geometry, const WitnessPair& from,
                     std::vector<NicheCandidate>& candidates);

}  // namespace concave_distance
