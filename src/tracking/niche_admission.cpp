#include "concave_distance/tracking/niche_admission.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "concave_distance/distance/pass_level.h"

namespace concave_distance {
namespace {

constexpr int kPassSamples = 8;
// Before two places are taken for one niche: between coarse samples both points may slip round a corner at
// once.
constexpr int kPassSamplesToUnite = 64;
constexpr std::size_t kNeighbours = 4;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Below this distance, relative to the bodies, prominence is measured against it: it would diverge at
// contact.
constexpr double kRelativeDistanceFloor = 1e-6;

struct Neighbour {
  std::size_t record = 0;
  double gap = kInfinity;  // sum of both witnesses' squared separations, each in its body's frame
};
using Neighbours = std::array<Neighbour, kNeighbours>;

// The nearest records that satisfy `wanted`, ascending by gap; unused places have an infinite gap.
template <typename Wanted>
Neighbours nearestRecords(const NicheArchive& archive, const Eigen::Vector3d& point_a_in_a,
                          const Eigen::Vector3d& point_b_in_b, Wanted&& wanted) {
  Neighbours nearest;
  for (std::size_t i = 0; i < archive.records().size(); ++i) {
    const NicheRecord& record = archive.records()[i];
    if (!wanted(i, record)) {
      continue;
    }
    Neighbour next{i, (record.niche.point_a_in_a - point_a_in_a).squaredNorm() +
                          (record.point_b_in_b - point_b_in_b).squaredNorm()};
    for (Neighbour& place : nearest) {
      if (next.gap < place.gap) {
        std::swap(next, place);
      }
    }
  }
  return nearest;
}

}  // namespace

namespace {

// Hysteresis: a niche that users know is given up only at half the least prominence.
double leastProminence(const NicheRecord& record, const TrackerParameters& parameters) {
  return (record.reported ? 0.5 : 1.0) * parameters.least_prominence;
}

}  // namespace

double prominenceBound(const PairGeometry& geometry, const WitnessPair& shallow, const WitnessPair& deep,
                       double least_prominence) {
  const double distance =
      std::max(std::sqrt(shallow.squared_distance), kRelativeDistanceFloor * geometry.scale());
  const double good_enough = (1.0 + least_prominence) * distance;
  const auto pass = [&](int samples) {
    return passLevel(*geometry.a, *geometry.b, geometry.a_from_b, shallow, deep, samples,
                     good_enough * good_enough);
  };
  double level = pass(kPassSamples);
  if (level < good_enough * good_enough) {
    level = pass(kPassSamplesToUnite);
  }
  return std::max(0.0, std::sqrt(level) / distance - 1.0);
}

AdmissionResult admitCandidate(const NicheCandidate& candidate, const PairGeometry& geometry,
                               const TrackerParameters& parameters, double zero_distance_radius,
                               std::uint64_t cycle, NicheArchive& archive, std::vector<NicheEvent>& events) {
  const WitnessPair& witness = candidate.witness;
  const Eigen::Vector3d point_b_in_b = geometry.b_from_a * witness.point_b_in_a;
  const NicheRecord* known =
      archive.findSamePlace(witness.point_a_in_a, point_b_in_b, geometry.samePlaceTolerance());
  if (known == nullptr && witness.squared_distance == 0.0) {
    // Touching or crossing surfaces meet in whole curves of pairs at distance 0: one niche per neighbourhood.
    known = archive.findTouching(witness.point_a_in_a, point_b_in_b, zero_distance_radius);
  }
  if (known != nullptr) {
    return {Admission::SamePlace, known->niche.id};
  }
  const Outwardness outward = classifyOutwardness(*geometry.a, *geometry.b, geometry.a_from_b, witness);
  if (outward == Outwardness::ThroughMaterial && !parameters.keep_through_material) {
    return {Admission::ThroughMaterial, 0};
  }

  const double distance = std::sqrt(witness.squared_distance);
  double prominence = kInfinity;
  const Neighbours deeper = nearestRecords(
      archive, witness.point_a_in_a, point_b_in_b,
      [&](std::size_t, const NicheRecord& record) { return record.niche.distance <= distance; });
  for (const Neighbour& neighbour : deeper) {
    if (neighbour.gap == kInfinity) {
      break;
    }
    const NicheRecord& record = archive.records()[neighbour.record];
    const double bound =
        prominenceBound(geometry, witness, record.niche.witness, parameters.least_prominence);
    if (bound < parameters.least_prominence) {
      return {Admission::LowProminence, record.niche.id};
    }
    prominence = std::min(prominence, bound);
  }

  NicheRecord newborn;
  newborn.niche.id = archive.takeId();
  newborn.niche.birth_cycle = cycle;
  newborn.niche.node_pair = candidate.node_pair;
  newborn.niche.proven_local_minimum = candidate.proven;
  newborn.niche.outward = outward;
  newborn.niche.prominence = prominence;
  placeRecord(newborn, geometry, witness);
  archive.records().push_back(newborn);
  const std::uint64_t id = newborn.niche.id;

  // Known shallower neighbours that the newborn is the true bottom of.
  const Neighbours shallower = nearestRecords(
      archive, witness.point_a_in_a, point_b_in_b, [&](std::size_t, const NicheRecord& record) {
        return record.niche.id != id && record.niche.distance > distance;
      });
  std::uint64_t living_id = id;
  std::array<std::uint64_t, kNeighbours> ids{};
  for (std::size_t k = 0; k < kNeighbours && shallower[k].gap < kInfinity; ++k) {
    ids[k] = archive.records()[shallower[k].record].niche.id;
  }
  const auto index_of = [&](std::uint64_t wanted) {
    const auto& records = archive.records();
    return static_cast<std::size_t>(std::find_if(records.begin(), records.end(),
                                                 [&](const NicheRecord& r) { return r.niche.id == wanted; }) -
                                    records.begin());
  };
  for (const std::uint64_t shallow_id : ids) {
    if (shallow_id == 0) {
      break;
    }
    const std::size_t shallow = index_of(shallow_id);
    const double least = leastProminence(archive.records()[shallow], parameters);
    const double bound = prominenceBound(geometry, archive.records()[shallow].niche.witness, witness, least);
    archive.records()[shallow].niche.prominence =
        std::min(archive.records()[shallow].niche.prominence, bound);
    if (bound < least) {
      living_id = archive.unite(index_of(living_id), shallow, events);
    }
  }
  return {Admission::Born, living_id};
}

bool reviewProminence(std::size_t i, const PairGeometry& geometry, const TrackerParameters& parameters,
                      NicheArchive& archive, std::vector<NicheEvent>& events) {
  NicheRecord& record = archive.records()[i];
  const double least = leastProminence(record, parameters);
  const Neighbours deeper = nearestRecords(archive, record.niche.point_a_in_a, record.point_b_in_b,
                                           [&](std::size_t k, const NicheRecord& other) {
                                             return k != i && other.niche.distance <= record.niche.distance;
                                           });
  double prominence = kInfinity;
  for (const Neighbour& neighbour : deeper) {
    if (neighbour.gap == kInfinity) {
      break;
    }
    const double bound = prominenceBound(geometry, record.niche.witness,
                                         archive.records()[neighbour.record].niche.witness, least);
    if (bound < least) {
      archive.unite(neighbour.record, i, events);
      return true;
    }
    prominence = std::min(prominence, bound);
  }
  record.niche.prominence = prominence;
  return false;
}

void uniteSamePlaces(const PairGeometry& geometry, NicheArchive& archive, std::vector<NicheEvent>& events) {
  const double tolerance = geometry.samePlaceTolerance();
  const double squared_tolerance = tolerance * tolerance;
  std::vector<NicheRecord>& records = archive.records();
  for (std::size_t i = 0; i < records.size(); ++i) {
    std::size_t k = i + 1;
    // Points that agree within the tolerance have distances that agree within twice as much.
    while (k < records.size() && records[k].niche.distance - records[i].niche.distance <= 2.0 * tolerance) {
      if ((records[k].niche.point_a_in_a - records[i].niche.point_a_in_a).squaredNorm() <=
              squared_tolerance &&
          (records[k].point_b_in_b - records[i].point_b_in_b).squaredNorm() <= squared_tolerance) {
        archive.unite(i, k, events);
        archive.settle();
        k = i;
      }
      ++k;
    }
  }
}

}  // namespace concave_distance
