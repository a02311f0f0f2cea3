#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "concave_distance/tracking/pair_solution.h"
#include "niche_archive.h"
#include "niche_placement.h"

namespace concave_distance {

/// Keeps the niches of a pair with a round solid: those of the meshes, each moved to the local minimum
/// between the exact surfaces. What comes to the same place is one niche. Ids belong to the exact niches and
/// go on with the niches of the meshes that they come from, or with the place.
class RoundNiches {
 public:
  struct Cycle {
    std::uint64_t number;
    double displacement;  ///< metres that any point of B has moved since the last one, at most
    double elapsed;       ///< seconds; 0: unknown
  };

  void beginIdsAfter(std::uint64_t id) { archive_.beginIdsAfter(id); }
  std::uint64_t takeId() { return archive_.takeId(); }
  /// Returns how much farther than the solids their meshes may be, metres.
  static double meshExcess(const PairFrame& frame);

  /// Moves the niches of the meshes to the exact surfaces at the frame's pose. Two solids have one niche and
  /// need no others.
  /// @param events receives those of the exact niches
  void update(const PairFrame& frame, const NicheArchive& of_meshes, const Cycle& cycle,
              std::vector<NicheEvent>& events);
  void keepUnchanged(double elapsed) { archive_.keepUnchanged(elapsed); }

  std::vector<NicheRecord>& records() { return archive_.records(); }
  const std::vector<NicheRecord>& records() const { return archive_.records(); }
  void clear();
  /// Says that the next niches of the meshes are others: ids then go on by place.
  void forgetMeshNiches() { members_.clear(); }

 private:
  /// A niche of the meshes and the exact one that it has come to.
  struct Member {
    std::uint64_t mesh_id;
    std::uint64_t id;
  };

  void place(const PairFrame& frame, const NicheArchive& of_meshes);
  void placeShapes(const PairFrame& frame);
  bool areOne(const PairFrame& frame, const NicheRecord& l, const NicheRecord& r) const;
  void identify(const Cycle& cycle);
  const NicheRecord* heritageOf(std::size_t next) const;
  bool isTaken(std::uint64_t id) const;
  void inherit(const NicheRecord& known, const Cycle& cycle, NicheRecord& record);
  void endOthers(std::vector<NicheEvent>& events) const;

  NicheArchive archive_;
  std::vector<Member> members_;
  std::vector<NicheRecord> next_;        ///< without ids until they are identified
  std::vector<std::size_t> next_index_;  ///< of the meshes' records: which of next_ they have come to
  std::vector<std::uint64_t> mesh_ids_;
};

}  // namespace concave_distance
