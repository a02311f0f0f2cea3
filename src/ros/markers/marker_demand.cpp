#include "marker_demand.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "ros/time_difference.h"

namespace concave_distance {
namespace {

constexpr double kHeldSeconds = 1.0;
// Cycles that the next question waits at most: a first solve may take seconds.
constexpr double kLargestDebt = 200.0;

}  // namespace

void MarkerDemand::begin(double seconds) {
  if (entries_.empty()) return;
  credit_ = std::clamp(credit_ + seconds, -kLargestDebt * seconds, seconds);
  std::vector<Entry*> oldest_first;
  for (auto& [name, entry] : entries_) {
    entry.is_asked = false;
    oldest_first.push_back(&entry);
  }
  std::sort(oldest_first.begin(), oldest_first.end(),
            [](const Entry* left, const Entry* right) { return left->asked < right->asked; });
  double left = credit_;
  for (Entry* entry : oldest_first) {
    if (left <= 0.0) return;
    entry->is_asked = true;
    entry->asked = ++questions_;
    left -= entry->seconds < 0.0 ? left : entry->seconds;  // the first one alone
  }
}

bool MarkerDemand::wantsNiches(const std::string& pair) const {
  const auto entry = entries_.find(pair);
  return entry != entries_.end() && entry->second.is_asked;
}

void MarkerDemand::take(const PublishedPairs& pairs) {
  if (entries_.empty()) return;
  for (const auto& pair : pairs) {
    if (!pair->demand().due || !pair->heading.with_niches || !pair->tracked->solved()) continue;
    const auto found = entries_.find(pair->heading.pair);
    if (found == entries_.end() || !found->second.is_asked) continue;
    Entry& entry = found->second;
    if (!pair->tracked->repeated) {
      entry.seconds = pair->tracked->solution.solve_seconds;
      credit_ -= entry.seconds;
    }
    entry.niches = toNiches(pair->heading, pair->tracked->solution);
    entry.known = true;
  }
}

void MarkerDemand::select(const std::vector<DrawnPair>& drawn, ros::Time now) {
  for (const DrawnPair& pair : drawn) entries_[pair.pair->nearest.pair].selected = now;
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    // Also after the clock has jumped back.
    const bool ends = std::abs(secondsBetween(entry->second.selected, now)) > kHeldSeconds;
    entry = ends ? entries_.erase(entry) : std::next(entry);
  }
}

std::vector<const PairNiches*> MarkerDemand::withKeptNiches(const std::vector<PairNiches>& messages) {
  std::vector<const PairNiches*> pairs;
  pairs.reserve(messages.size());
  for (const PairNiches& message : messages) {
    pairs.push_back(message.niches.empty() ? withKeptNiches(message) : &message);
  }
  return pairs;
}

const PairNiches* MarkerDemand::withKeptNiches(const PairNiches& message) {
  const auto found = entries_.find(message.nearest.pair);
  if (found == entries_.end() || !found->second.known) return &message;
  PairNiches& kept = found->second.niches;
  kept.header = message.header;
  if (message.nearest.status.code == PairStatus::STALE_TRANSFORM) {
    kept.nearest.status = message.nearest.status;
    return &kept;
  }
  kept.nearest = message.nearest;
  // The shortest distance is always that of the present cycle.
  if (!kept.niches.empty() && message.nearest.has_points != 0) {
    Niche& nearest = kept.niches.front();
    nearest.distance = message.nearest.distance;
    nearest.point_a = message.nearest.point_a;
    nearest.point_b = message.nearest.point_b;
  }
  return &kept;
}

void MarkerDemand::forget() {
  entries_.clear();
  credit_ = 0.0;
}

}  // namespace concave_distance
