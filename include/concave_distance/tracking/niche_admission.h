#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/tracking/niche_archive.h"
#include "concave_distance/tracking/pair_geometry.h"
#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance {

/// What became of a candidate.
enum class Admission : std::uint8_t { Born, SamePlace, LowProminence, ThroughMaterial };

struct AdmissionResult {
  Admission outcome;
  std::uint64_t id;  ///< of the niche born or the one it belongs to; 0 when through material
};

/// Pass over which record `shallow` reaches a deeper place, relative to its own distance: an upper bound of
/// its prominence (doc/algorithm.md). `distance_floor`, metres, keeps it finite near contact.
double prominenceBound(const PairGeometry& geometry, const WitnessPair& shallow, const WitnessPair& deep,
                       double least_prominence);

/// Decides whether a refined candidate is a niche of its own: not at a known place, not through material, not
/// joined to a deeper niche by a way lower than the least prominence. Also unites known shallower neighbours
/// that the newborn has become the bottom of.
AdmissionResult admitCandidate(const NicheCandidate& candidate, const PairGeometry& geometry,
                               const TrackerParameters& parameters, double zero_distance_radius,
                               std::uint64_t cycle, NicheArchive& archive, std::vector<NicheEvent>& events);

/// Looks again whether record i is part of a deeper neighbour; unites them if its prominence is below the
/// least, half the least where users know the niche (hysteresis). True when it did.
bool reviewProminence(std::size_t i, const PairGeometry& geometry, const TrackerParameters& parameters,
                      NicheArchive& archive, std::vector<NicheEvent>& events);

/// Unites records that have slid into one place. The archive must be settled; it is again afterwards.
void uniteSamePlaces(const PairGeometry& geometry, NicheArchive& archive, std::vector<NicheEvent>& events);

}  // namespace concave_distance
