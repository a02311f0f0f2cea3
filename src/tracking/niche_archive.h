#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance {

/// A niche with what the next cycle needs of it.
struct NicheRecord {
  TrackedNiche niche;
  Eigen::Vector3d point_b_in_b = Eigen::Vector3d::Zero();
  std::uint64_t basin = 0;  ///< LocalMinimum::basin
  bool carried = false;     ///< not descended since the bodies moved: the time ran out
  bool reported = false;    ///< users have seen its id: its end is an event
  /// Nearer than this, metres, its id cannot have come since the last cycle: a deeper place is another niche.
  double least_distance = 0.0;
};

/// The niches of one pair, apart from the population: the population is not the memory. Ascending
/// by distance after settle(). Ids are never used twice.
class NicheArchive {
 public:
  std::vector<NicheRecord>& records() { return records_; }
  const std::vector<NicheRecord>& records() const { return records_; }
  std::uint64_t takeId() { return next_id_++; }
  /// Ids that come are greater than this.
  void beginIdsAfter(std::uint64_t id) { next_id_ = id + 1; }

  void reserve(std::size_t count) {
    records_.reserve(count);
    order_.reserve(count);
  }

  /// Forgets the niches, not the count of ids.
  void clear() { records_.clear(); }

  /// The record at the same place (both points within `tolerance`, metres), or null.
  NicheRecord* findSamePlace(const Eigen::Vector3d& point_a_in_a, const Eigen::Vector3d& point_b_in_b,
                             double tolerance);

  /// Keeps the niches at a pose that has not changed: all are inherited and rest.
  /// @param elapsed seconds since the last cycle; 0 when not known, then the speeds are not either
  void keepUnchanged(double elapsed);

  /// Sorts by distance, then by id.
  void settle();

  /// Unites two records: the deeper place, the older id, unless that would make a known niche fall farther
  /// than it can have moved. Reports the other id's merge if it was known. @return the id that lives on
  /// `loser` is removed by swapping with the last record: references to records are void afterwards.
  std::uint64_t unite(std::size_t survivor, std::size_t loser, std::vector<NicheEvent>& events);

  /// Removes record i, reporting a death if it was known; the last record takes its place.
  void remove(std::size_t i, std::vector<NicheEvent>& events);

 private:
  struct Key {
    double distance;
    std::uint64_t id;
    std::size_t from;
  };
  std::vector<NicheRecord> records_;
  std::vector<Key> order_;  ///< of settle()
  std::uint64_t next_id_ = 1;
};

}  // namespace concave_distance
