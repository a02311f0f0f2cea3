#include "region_identity.h"

#include <algorithm>
#include <tuple>

namespace concave_distance {
namespace {

/// Returns how far from its middle a region's niche can lie: on its curves, but for rounding.
double reachOf(const InterferenceRegion& overlap) {
  return 1.001 * overlap.reach + (overlap.depth > 0.0 ? overlap.depth : 0.0);
}

/// The squared distance of two points; -1 beyond the reach.
double within(const Eigen::Vector3d& p, const Eigen::Vector3d& q, double reach) {
  const double squared_distance = (p - q).squaredNorm();
  return squared_distance <= reach * reach ? squared_distance : -1.0;
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

void RegionIdentity::inherit() {
  for (const Match& match : matches_) {
    RegionMemory& now = memory_[match.region];
    RegionMemory& before = before_[match.other];
    now.id = before.id;
    now.normal_in_a = before.normal_in_a;
    now.bristles = before.bristles;
    now.turning = before.turning;
    std::swap(now.patch, before.patch);
    before.patch.entered_in_a = now.patch.entered_in_a;
  }
  loose_.clear();
  if (before_.empty() || (matches_.size() == memory_.size() && matches_.size() == before_.size())) return;
  for (const Match& match : matches_) loosen(memory_[match.region].patch);
  for (std::size_t o = 0; o < before_.size(); ++o) {
    if (other_taken_[o] == 0) loosen(before_[o].patch);
  }
  splitOff();
}

void RegionIdentity::loosen(const PatchMemory& patch) {
  for (const SiteBristles& site : patch.bristles) loose_.push_back({site, patch.cell_size});
}

// A new region in the midst of a known one is a part of it. Both turn and slide as one.
void RegionIdentity::splitOff() {
  for (std::size_t r = 0; r < memory_.size(); ++r) {
    if (region_taken_[r] != 0) continue;
    for (const RegionMemory& before : before_) {
      if ((memory_[r].point_in_a - before.point_in_a).norm() > before.reach) continue;
      memory_[r].normal_in_a = before.normal_in_a;
      memory_[r].bristles = before.bristles;
      memory_[r].turning = before.turning;
      memory_[r].patch.entered_in_a = before.patch.entered_in_a;
      break;
    }
  }
}

void RegionIdentity::keepNormals(const std::vector<ContactRegion>& regions) {
  for (std::size_t r = 0; r < regions.size(); ++r) memory_[r].normal_in_a = regions[r].overlap.normal_in_a;
}

// Takes each niche's id for one region: first known ids stay where their niches still are, then niches that
// touch give theirs to the regions they lie on, at last a region keeps the id of a niche that has gone on.
void RegionIdentity::takeIds(const std::vector<TrackedNiche>& niches, double displacement) {
  region_taken_.assign(memory_.size(), 0);
  other_taken_.assign(niches.size(), 0);
  const auto squared_distance_of = [&](std::size_t r, std::size_t o) {
    return within(memory_[r].point_in_a, niches[o].point_a_in_a, memory_[r].reach + displacement);
  };
  const auto keep_known = [&](const auto& accept) {
    takeNearest(memory_.size(), niches.size(), [&](std::size_t r, std::size_t o) {
      const bool is_known = niches[o].id != 0 && niches[o].id == memory_[r].id && other_taken_[o] == 0;
      return is_known ? accept(r, o) : -1.0;
    });
  };
  keep_known(squared_distance_of);
  takeNearest(memory_.size(), niches.size(), [&](std::size_t r, std::size_t o) {
    // Regions are those of the bare bodies: where only margins overlap there is none.
    const bool has_depth = niches[o].signed_place.value <= 0.0;
    const bool touches = !(niches[o].distance > 0.0) && (has_depth || !(niches[o].signed_distance < 0.0));
    const bool is_free = other_taken_[o] == 0 && niches[o].id != 0 && touches;
    return is_free ? squared_distance_of(r, o) : -1.0;
  });
  found_ = matches_;
  keep_known([](std::size_t, std::size_t) { return 0.0; });
  for (std::size_t r = 0; r < memory_.size(); ++r) {
    if (region_taken_[r] == 0) memory_[r].id = 0;
  }
  for (const Match& match : found_) memory_[match.region].id = niches[match.other].id;
}

void RegionIdentity::update(const std::vector<TrackedNiche>& niches, double displacement,
                            std::vector<ContactRegion>& regions) {
  before_.swap(memory_);
  memory_.resize(regions.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    memory_[r].id = 0;
    memory_[r].point_in_a = regions[r].point_in_a;
    memory_[r].reach = reachOf(regions[r].overlap);
    memory_[r].normal_in_a.setZero();
    memory_[r].bristles = {};
    memory_[r].turning = {};
    memory_[r].patch.clear();
  }
  region_taken_.assign(regions.size(), 0);
  other_taken_.assign(before_.size(), 0);
  takeNearest(regions.size(), before_.size(), [&](std::size_t r, std::size_t o) {
    return within(memory_[r].point_in_a, before_[o].point_in_a,
                  memory_[r].reach + before_[o].reach + displacement);
  });
  inherit();

  takeIds(niches, displacement);
  for (std::size_t r = 0; r < regions.size(); ++r) regions[r].id = memory_[r].id;
}

}  // namespace concave_distance
