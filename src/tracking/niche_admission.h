#pragma once

#include <cstdint>
#include <vector>

#include "niche_archive.h"
#include "pair_geometry.h"

namespace concave_distance {

/// What became of a candidate.
enum class Admission : std::uint8_t { Born, SamePlace, LowProminence, ThroughMaterial };

struct AdmissionResult {
  Admission outcome;
  std::uint64_t id;  ///< of the niche born or the one it belongs to; 0 when through material
};

/// Unites records that have slid into one place. The archive must be settled; it is again afterwards.
void uniteSamePlaces(const PairGeometry& geometry, NicheArchive& archive, std::vector<NicheEvent>& events);

}  // namespace concave_distance
