#include "marker_selection.h"

#include <algorithm>
#include <utility>

namespace concave_distance {
namespace {

// Assigns the rest of the count to further niches of the pairs, nearest first.
void addFartherNiches(std::vector<DrawnPair>& drawn, std::size_t count) {
  std::vector<std::pair<double, DrawnPair*>> others;
  std::size_t used = 0;
  for (DrawnPair& pair : drawn) {
    used += pair.niche_count;
    for (std::size_t k = 1; k < pair.pair->niches.size(); ++k) {
      others.emplace_back(pair.pair->niches[k].distance, &pair);
    }
  }
  std::stable_sort(others.begin(), others.end(),
                   [](const auto& left, const auto& right) { return left.first < right.first; });
  const std::size_t left = count == 0 ? others.size() : count - std::min(count, used);
  for (std::size_t k = 0; k < std::min(left, others.size()); ++k) {
    ++others[k].second->niche_count;
  }
}

}  // namespace

bool hasMarkers(const PairNiches& pair) {
  const bool swallowed = pair.nearest.status.code == PairStatus::PENETRATING && pair.nearest.has_points != 0;
  return pair.nearest.has_distance != 0 && (!pair.niches.empty() || swallowed);
}

std::vector<DrawnPair> selectPairs(const std::vector<PairNiches>& pairs, const MarkerStyle& style) {
  std::vector<DrawnPair> drawn;
  for (const PairNiches& pair : pairs) {
    if (hasMarkers(pair)) {
      drawn.push_back({&pair, std::min<std::size_t>(1, pair.niches.size())});
    }
  }
  std::stable_sort(drawn.begin(), drawn.end(), [](const DrawnPair& left, const DrawnPair& right) {
    return left.pair->nearest.distance < right.pair->nearest.distance;
  });
  if (style.pair_count != 0 && drawn.size() > style.pair_count) {
    const auto farther = drawn.begin() + static_cast<std::ptrdiff_t>(style.pair_count);
    drawn.erase(std::remove_if(farther, drawn.end(),
                               [](const DrawnPair& pair) { return pair.pair->nearest.warning == 0; }),
                drawn.end());
  }
  addFartherNiches(drawn, style.niche_count);
  return drawn;
}

}  // namespace concave_distance
