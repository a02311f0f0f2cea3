#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/pair_table.h"
#include "concave_distance/search/trial_point.h"
#include "pair_metric.h"

namespace concave_distance {

/// The distinct trial points ("places") of one run, numbered in the order they came, and the mesh distances
/// between them. After Lamarckian descent most individuals stand on few places: operators that compare all
/// with all work on places, and look up each distance once a run.
class TrialPointTable {
 public:
  void clear();
  /// Room for so many places, and for the distances between the first `compared` of them.
  void reserve(std::size_t places, std::size_t compared) {
    points_.reserve(places);
    place_of_pair_.reserve(kUsualPlacesLog2);
    delta_.reserve(compared * compared / 2);
  }
  /// Clears the table and frees the memory of distances beyond the first `compared` places.
  void shrink(std::size_t compared);
  std::uint32_t placeOf(const TrialPoint& point);
  const TrialPoint& point(std::uint32_t place) const { return points_[place]; }
  std::size_t size() const { return points_.size(); }
  /// Delta of two places (Carretero, eq. (4.5)), metres; infinite between shells.
  double delta(std::uint32_t i, std::uint32_t j, PairMetric& metric) {
    if (i == j) {
      return 0.0;
    }
    if (i < j) {
      std::swap(i, j);
    }
    if (i < kPlacesWithDistances) {
      const float kept = delta_[std::size_t{i} * (i - 1) / 2 + j];
      if (kept >= 0.0F) {
        return static_cast<double>(kept);
      }
    }
    return measure(i, j, metric);
  }

 private:
  // Distances between the first places are kept: 2 MB. A run that meets more computes the others each time.
  static constexpr std::uint32_t kPlacesWithDistances = 1024;

  static constexpr std::uint32_t kUsualPlacesLog2 = 10;
  double measure(std::uint32_t i, std::uint32_t j, PairMetric& metric);

  PairTable place_of_pair_{6};
  std::vector<TrialPoint> points_;
  std::vector<float> delta_;  ///< lower triangle, row by row; negative: not computed yet
};

/// How many individuals stand where: the places present in a population.
struct Census {
  std::vector<std::uint32_t> places;          ///< the distinct ones
  std::vector<std::uint32_t> counts;          ///< beside them
  std::vector<std::uint32_t> entry_of_place;  ///< index into the two above; kNone where nobody stands

  static constexpr std::uint32_t kNone = 0xffffffffU;
  void reserve(std::size_t place_count) {
    places.reserve(place_count);
    counts.reserve(place_count);
    entry_of_place.reserve(place_count);
  }
  /// Counts anew; the places come in order of their first individual.
  /// @param population_places the place of each individual
  void take(const std::vector<std::uint32_t>& population_places, std::size_t place_count);
  /// One individual has moved from its place to one where nobody stood. O(1).
  void move(std::uint32_t from, std::uint32_t to, std::size_t place_count);
};

/// Greedy niche identification (Carretero, sec. 4.6.4) on places: the best one, all within `niche_radius`
/// (metres) of it stripped, repeat. O(places * niches) distances.
/// @param order buffer
/// @param peaks the place of each niche's best point, best first; keeps its capacity
void nichePeaks(const Census& census, double niche_radius, TrialPointTable& places, PairMetric& metric,
                std::vector<std::uint32_t>& order, std::vector<std::uint32_t>& peaks);

}  // namespace concave_distance
