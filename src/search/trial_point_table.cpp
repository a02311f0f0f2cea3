#include "trial_point_table.h"

#include <algorithm>

namespace concave_distance {

void TrialPointTable::clear() {
  place_of_pair_.clear();
  points_.clear();
  delta_.clear();
}

void TrialPointTable::shrink(std::size_t compared) {
  const std::size_t kept = compared * compared / 2;
  if (delta_.capacity() <= kept) {
    return;
  }
  clear();
  std::vector<float>().swap(delta_);
  delta_.reserve(kept);
}

std::uint32_t TrialPointTable::placeOf(const TrialPoint& point) {
  const auto next = static_cast<std::uint32_t>(points_.size());
  const std::uint32_t place = place_of_pair_.insert(point.node_a, point.node_b, next);
  if (place == next) {
    points_.push_back(point);
    if (next < kPlacesWithDistances) {
      delta_.resize(delta_.size() + next, -1.0F);
    }
  }
  return place;
}

double TrialPointTable::measure(std::uint32_t i, std::uint32_t j, PairMetric& metric) {
  // Rounded as the kept ones are: a distance does not depend on the order in which places were met.
  const auto measured = static_cast<float>(metric.distance(points_[i], points_[j]));
  if (i < kPlacesWithDistances) {
    delta_[std::size_t{i} * (i - 1) / 2 + j] = measured;
  }
  return static_cast<double>(measured);
}

void Census::take(const std::vector<std::uint32_t>& population_places, std::size_t place_count) {
  for (const std::uint32_t place : places) {
    if (place < entry_of_place.size()) {
      entry_of_place[place] = kNone;
    }
  }
  places.clear();
  counts.clear();
  entry_of_place.resize(place_count, kNone);
  for (const std::uint32_t place : population_places) {
    std::uint32_t& entry = entry_of_place[place];
    if (entry == kNone) {
      entry = static_cast<std::uint32_t>(places.size());
      places.push_back(place);
      counts.push_back(0);
    }
    ++counts[entry];
  }
}

void Census::move(std::uint32_t from, std::uint32_t to, std::size_t place_count) {
  entry_of_place.resize(place_count, kNone);
  const std::uint32_t entry = entry_of_place[from];
  if (counts[entry] == 1) {
    places[entry] = to;
    entry_of_place[to] = entry;
    entry_of_place[from] = kNone;
    return;
  }
  --counts[entry];
  entry_of_place[to] = static_cast<std::uint32_t>(places.size());
  places.push_back(to);
  counts.push_back(1);
}

void nichePeaks(const Census& census, double niche_radius, TrialPointTable& places, PairMetric& metric,
                std::vector<std::uint32_t>& order, std::vector<std::uint32_t>& peaks) {
  order.assign(census.places.begin(), census.places.end());
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t l, std::uint32_t r) { return places.point(l) < places.point(r); });
  peaks.clear();
  for (const std::uint32_t place : order) {
    const bool is_member = std::any_of(peaks.begin(), peaks.end(), [&](std::uint32_t peak) {
      return places.delta(peak, place, metric) <= niche_radius;
    });
    if (!is_member) {
      peaks.push_back(place);
    }
  }
}

}  // namespace concave_distance
