#include "decision_cache.h"

#include "base/refill.h"

namespace concave_distance::detail {
namespace {

/// Cycles that a path, and while cycles are cut a basin, is kept without being used.
constexpr std::uint64_t kKeptCycles = 64;
/// Facet pairs that are kept without being looked through.
constexpr std::size_t kSmallTable = 256;
/// Facet pairs that leave a dropped basin at once; of larger ones, as many leave in each cycle.
constexpr std::size_t kMostUnlinked = 8192;

}  // namespace

void DecisionCache::clear() {
  table_.clear();
  facet_pairs_.clear();
  links_.clear();
  memberships_.clear();
  free_membership_ = kNone;
  basins_.clear();
  free_basins_.clear();
  boundaries_.clear();
  live_facet_pairs_ = 0;
  was_cut_ = false;
}

void DecisionCache::beginCycle(bool is_tracked) {
  for (std::uint32_t i = 0; i < basins_.size(); ++i) {
    KeptBasin& basin = basins_[i];
    if (basin.confirmed) basin.used = cycle_;
    const bool is_kept = basin.confirmed || (was_cut_ && basin.used + kKeptCycles > cycle_);
    if (basin.is_whole && !is_kept) drop(i);
    if (basin.id == 0 && basin.members != kNone) unlink(i);
  }
  was_cut_ = false;
  compact();
  if (is_tracked) {
    facet_pairs_.reserve(kSmallTable);
    links_.reserve(kSmallTable);
  }
  ++cycle_;
  for (KeptBasin& basin : basins_) {
    basin.first = kNone;
    basin.confirmed = false;
  }
}

std::uint32_t DecisionCache::facetPairOf(TriangleIndex a, TriangleIndex b, WorkLimit& limit) {
  const std::uint32_t known = table_.find(a, b);
  if (known != PairTable::kAbsent) return known;
  if (!limit.admits(facet_pairs_.size() + 1)) return kNone;
  const auto number = static_cast<std::uint32_t>(facet_pairs_.size());
  FacetPair facet_pair;
  facet_pair.a = a;
  facet_pair.b = b;
  facet_pairs_.push_back(facet_pair);
  table_.insert(a, b, number);
  return number;
}

void DecisionCache::enterCandidate(std::uint32_t number, std::uint32_t candidate) {
  FacetPair& facet_pair = facet_pairs_[number];
  if (facet_pair.cycle == cycle_) return;
  facet_pair.cycle = cycle_;
  facet_pair.candidate = candidate;
  for (std::uint32_t m = facet_pair.basins; m != kNone; m = memberships_[m].next) {
    KeptBasin& basin = basins_[memberships_[m].basin];
    if (basin.is_whole && basin.first == kNone) basin.first = candidate;
  }
}

void DecisionCache::keepLink(std::uint32_t& number, const Link& link) {
  if (number == kNone) {
    number = static_cast<std::uint32_t>(links_.size());
    links_.emplace_back();
  }
  links_[number] = link;
  use(number);
}

std::uint32_t DecisionCache::basinOf(std::uint32_t number, std::uint32_t first) const {
  for (std::uint32_t m = facet_pairs_[number].basins; m != kNone; m = memberships_[m].next) {
    if (basins_[memberships_[m].basin].first == first) return memberships_[m].basin;
  }
  return kNone;
}

std::uint32_t DecisionCache::basinWith(std::uint64_t id) const {
  const auto index = static_cast<std::uint32_t>(id & 0xffffffffU);
  return id != 0 && index < basins_.size() && basins_[index].id == id ? index : kNone;
}

bool DecisionCache::isIn(TriangleIndex a, TriangleIndex b, std::uint32_t basin) const {
  const std::uint32_t number = table_.find(a, b);
  if (number == PairTable::kAbsent) return false;
  for (std::uint32_t m = facet_pairs_[number].basins; m != kNone; m = memberships_[m].next) {
    if (memberships_[m].basin == basin) return true;
  }
  return false;
}

std::uint32_t DecisionCache::takeBasin(std::uint64_t id) {
  if (free_basins_.empty()) {
    free_basins_.push_back(static_cast<std::uint32_t>(basins_.size()));
    basins_.emplace_back();
  }
  // The one that was dropped last comes first: an id keeps its place.
  const std::uint32_t index = free_basins_.back();
  free_basins_.pop_back();
  basins_[index].id = id != 0 ? id : (++basins_made_ << 32U) | index;
  return index;
}

bool DecisionCache::join(std::uint32_t number, std::uint32_t basin, WorkLimit& limit) {
  std::uint32_t m = free_membership_;
  if (m != kNone) {
    free_membership_ = memberships_[m].next;
  } else {
    if (!limit.admits(memberships_.size() + 1)) return false;
    m = static_cast<std::uint32_t>(memberships_.size());
    memberships_.emplace_back();
  }
  KeptBasin& owner = basins_[basin];
  memberships_[m] = {basin, number, facet_pairs_[number].basins, owner.members};
  facet_pairs_[number].basins = owner.members = m;
  ++owner.facet_pairs;
  return true;
}

bool DecisionCache::drop(std::uint32_t index) {
  KeptBasin& basin = basins_[index];
  basin.boundary.clear(boundaries_);
  basin.id = 0;
  basin.first = kNone;
  basin.is_whole = basin.confirmed = false;
  return unlink(index);
}

/// Takes facet pairs out of a dropped basin. Its place is free when none is left.
bool DecisionCache::unlink(std::uint32_t index) {
  KeptBasin& basin = basins_[index];
  std::uint32_t m = basin.members;
  for (std::size_t count = 0; m != kNone && count < kMostUnlinked; ++count) {
    Membership& membership = memberships_[m];
    std::uint32_t* at = &facet_pairs_[membership.facet_pair].basins;
    while (*at != m) at = &memberships_[*at].next;
    *at = membership.next;
    const std::uint32_t next = membership.next_of_basin;
    membership.next = free_membership_;
    free_membership_ = m;
    m = next;
  }
  basin.members = m;
  if (m != kNone) return false;
  basin.facet_pairs = 0;
  free_basins_.push_back(index);
  return true;
}

bool DecisionCache::isUsed(std::uint32_t link) const {
  return link != kNone && links_[link].used + kKeptCycles > cycle_;
}

/// Facet pairs of which nothing is known any more go.
void DecisionCache::compact() {
  if (facet_pairs_.size() <= 2 * live_facet_pairs_ + kSmallTable) return;
  std::vector<char>& live = live_;
  refill(live, facet_pairs_.size(), char{0});
  for (std::size_t i = 0; i < facet_pairs_.size(); ++i) {
    const FacetPair& facet_pair = facet_pairs_[i];
    const bool is_hidden = facet_pair.cycle == cycle_ && facet_pair.occluder.triangle != kNoTriangle;
    if (is_hidden || facet_pair.basins != kNone || isUsed(facet_pair.low)) live[i] = 1;
    if (isUsed(facet_pair.link)) live[i] = live[links_[facet_pair.link].next] = 1;
  }
  std::vector<std::uint32_t>& places = places_;
  refill(places, facet_pairs_.size(), kNone);
  table_.clear();
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < facet_pairs_.size(); ++i) {
    if (live[i] == 0) continue;
    places[i] = count;
    facet_pairs_[count] = facet_pairs_[i];
    table_.insert(facet_pairs_[count].a, facet_pairs_[count].b, count);
    ++count;
  }
  facet_pairs_.resize(count);
  live_facet_pairs_ = count;
  std::vector<Link>& links = spare_links_;
  links.clear();
  const auto keep = [&](std::uint32_t& link) {
    if (!isUsed(link)) {
      link = kNone;
      return;
    }
    links.push_back(links_[link]);
    links.back().next = places[links.back().next];
    link = static_cast<std::uint32_t>(links.size() - 1);
  };
  for (FacetPair& facet_pair : facet_pairs_) {
    keep(facet_pair.link);
    keep(facet_pair.low);
  }
  links_.swap(links);
  for (const KeptBasin& basin : basins_) {
    for (std::uint32_t m = basin.members; m != kNone; m = memberships_[m].next_of_basin) {
      memberships_[m].facet_pair = places[memberships_[m].facet_pair];
    }
  }
}

}  // namespace concave_distance::detail
