#include "region_identity.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace concave_distance {
namespace {

/// How far from its middle a region's niche can lie: on its curves, but for rounding.
double reachOf(const InterferenceRegion& overlap) {
  return 1.001 * overlap.reach + (overlap.depth > 0.0 ? overlap.depth : 0.0);
}

}  // namespace

// All pairs that may belong together, nearest first; every region and every other only once. `accept` gives
// the squared distance of a pair, or a negative number for one that does not belong together.
template <typename Accept>
void RegionIdentity::takeNearest(std::size_t regions, std::size_t others, const Accept& accept) {
  matches_.clear();
  for (std::size_t r = 0; r < regions; ++r) {
    if (region_taken_[r] != 0) continue;
    for (std::size_t o = 0; o < others; ++o) {
      const double squared_distance = accept(r, o);
      if (squared_distance >= 0.0) matches_.push_back({squared_distance, r, o});
    }
  }
  std::sort(matches_.begin(), matches_.end(), [](const Match& l, const Match& r) {
    return std::tie(l.squared_distance, l.region, l.other) < std::tie(r.squared_distance, r.region, r.other);
  });
  std::size_t kept = 0;
  for (const Match& match : matches_) {
    if (region_taken_[match.region] != 0 || other_taken_[match.other] != 0) continue;
    region_taken_[match.region] = other_taken_[match.other] = 1;
    matches_[kept++] = match;
  }
  matches_.resize(kept);
}

void RegionIdentity::update(const std::vector<TrackedNiche>& niches, double displacement,
                            std::vector<ContactRegion>& regions) {
  before_.swap(memory_);
  memory_.resize(regions.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    memory_[r].id = 0;
    memory_[r].point_in_a = regions[r].point_in_a;
    memory_[r].reach = reachOf(regions[r].overlap);
    memory_[r].bristles = {};
    memory_[r].patch.clear();
  }
  const auto within = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q, double reach) {
    const double squared_distance = (p - q).squaredNorm();
    return squared_distance <= reach * reach ? squared_distance : -1.0;
  };
  region_taken_.assign(regions.size(), 0);
  other_taken_.assign(before_.size(), 0);
  takeNearest(regions.size(), before_.size(), [&](std::size_t r, std::size_t o) {
    return within(memory_[r].point_in_a, before_[o].point_in_a,
                  memory_[r].reach + before_[o].reach + displacement);
  });
  for (const Match& match : matches_) {
    memory_[match.region].id = before_[match.other].id;
    memory_[match.region].bristles = before_[match.other].bristles;
    std::swap(memory_[match.region].patch, before_[match.other].patch);
  }

  // The ids: of the niches that touch, each for one region. A known id stays where its niche still is.
  other_taken_.assign(niches.size(), 0);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const auto niche = std::find_if(niches.begin(), niches.end(), [&](const TrackedNiche& n) {
      return n.id != 0 && n.id == memory_[r].id;
    });
    region_taken_[r] = niche != niches.end() ? 1 : 0;
    if (niche != niches.end()) other_taken_[static_cast<std::size_t>(niche - niches.begin())] = 1;
  }
  takeNearest(regions.size(), niches.size(), [&](std::size_t r, std::size_t o) {
    const TrackedNiche& niche = niches[o];
    if (other_taken_[o] != 0 || niche.id == 0 || niche.distance > 0.0) return -1.0;
    return within(memory_[r].point_in_a, niche.point_a_in_a, memory_[r].reach + displacement);
  });
  for (const Match& match : matches_) memory_[match.region].id = niches[match.other].id;
  for (std::size_t r = 0; r < regions.size(); ++r) regions[r].id = memory_[r].id;
}

}  // namespace concave_distance
