#include "verdict_memory.h"

#include "base/refill.h"

namespace concave_distance::detail {
namespace {

/// Cycles that a path is kept without being used.
constexpr std::uint64_t kKeptCycles = 64;
/// Cells that are kept without being looked through.
constexpr std::size_t kSmallTable = 256;

}  // namespace

void VerdictMemory::clear() {
  table_.clear();
  cells_.clear();
  links_.clear();
  memberships_.clear();
  free_membership_ = kNone;
  regions_.clear();
  free_regions_.clear();
  borders_.clear();
  live_cells_ = 0;
}

void VerdictMemory::beginCycle(bool is_tracked) {
  for (std::uint32_t i = 0; i < regions_.size(); ++i) {
    if (regions_[i].id != 0 && !regions_[i].confirmed) drop(i);
  }
  compact();
  if (is_tracked) {
    cells_.reserve(kSmallTable);
    links_.reserve(kSmallTable);
  }
  ++cycle_;
  for (Region& region : regions_) {
    region.first = kNone;
    region.confirmed = false;
  }
}

std::uint32_t VerdictMemory::cellOf(TriangleIndex a, TriangleIndex b, WorkLimit& limit) {
  const std::uint32_t known = table_.find(a, b);
  if (known != PairTable::kAbsent) return known;
  if (!table_.makeRoom(limit) || !limit.makeRoom(cells_)) return kNone;
  const auto number = static_cast<std::uint32_t>(cells_.size());
  Cell cell;
  cell.a = a;
  cell.b = b;
  cells_.push_back(cell);
  table_.insert(a, b, number);
  return number;
}

void VerdictMemory::enterSeed(std::uint32_t number, std::uint32_t seed) {
  Cell& cell = cells_[number];
  if (cell.cycle == cycle_) return;
  cell.cycle = cycle_;
  cell.seed = seed;
  for (std::uint32_t m = cell.regions; m != kNone; m = memberships_[m].next) {
    Region& region = regions_[memberships_[m].region];
    if (region.first == kNone) region.first = seed;
  }
}

bool VerdictMemory::keepLink(std::uint32_t& number, const Link& link, WorkLimit& limit) {
  if (number == kNone) {
    if (!limit.makeRoom(links_)) return false;
    number = static_cast<std::uint32_t>(links_.size());
    links_.emplace_back();
  }
  links_[number] = link;
  use(number);
  return true;
}

std::uint32_t VerdictMemory::regionOf(std::uint32_t number, std::uint32_t first) const {
  for (std::uint32_t m = cells_[number].regions; m != kNone; m = memberships_[m].next) {
    if (regions_[memberships_[m].region].first == first) return memberships_[m].region;
  }
  return kNone;
}

std::uint32_t VerdictMemory::regionWith(std::uint64_t id) const {
  const auto index = static_cast<std::uint32_t>(id & 0xffffffffU);
  return id != 0 && index < regions_.size() && regions_[index].id == id ? index : kNone;
}

bool VerdictMemory::isIn(TriangleIndex a, TriangleIndex b, std::uint32_t region) const {
  const std::uint32_t number = table_.find(a, b);
  if (number == PairTable::kAbsent) return false;
  for (std::uint32_t m = cells_[number].regions; m != kNone; m = memberships_[m].next) {
    if (memberships_[m].region == region) return true;
  }
  return false;
}

std::uint32_t VerdictMemory::takeRegion(std::uint64_t id, WorkLimit& limit) {
  if (free_regions_.empty()) {
    if (!limit.makeRoom(regions_) || !limit.makeRoom(free_regions_)) return kNone;
    free_regions_.push_back(static_cast<std::uint32_t>(regions_.size()));
    regions_.emplace_back();
  }
  // The one that was dropped last comes first: an id keeps its place.
  const std::uint32_t index = free_regions_.back();
  free_regions_.pop_back();
  regions_[index].id = id != 0 ? id : (++regions_made_ << 32U) | index;
  return index;
}

bool VerdictMemory::join(std::uint32_t number, std::uint32_t region, WorkLimit& limit) {
  std::uint32_t m = free_membership_;
  if (m != kNone) {
    free_membership_ = memberships_[m].next;
  } else {
    if (!limit.makeRoom(memberships_)) return false;
    m = static_cast<std::uint32_t>(memberships_.size());
    memberships_.emplace_back();
  }
  Region& owner = regions_[region];
  memberships_[m] = {region, number, cells_[number].regions, owner.members};
  cells_[number].regions = owner.members = m;
  ++owner.cells;
  return true;
}

void VerdictMemory::drop(std::uint32_t index) {
  Region& region = regions_[index];
  for (std::uint32_t m = region.members; m != kNone;) {
    Membership& membership = memberships_[m];
    std::uint32_t* at = &cells_[membership.cell].regions;
    while (*at != m) at = &memberships_[*at].next;
    *at = membership.next;
    const std::uint32_t next = membership.next_of_region;
    membership.next = free_membership_;
    free_membership_ = m;
    m = next;
  }
  region.members = kNone;
  region.cells = 0;
  region.border.clear(borders_);
  region.id = 0;
  free_regions_.push_back(index);
}

bool VerdictMemory::isUsed(std::uint32_t link) const {
  return link != kNone && links_[link].used + kKeptCycles > cycle_;
}

/// Cells of which nothing is known any more go.
void VerdictMemory::compact() {
  if (cells_.size() <= 2 * live_cells_ + kSmallTable) return;
  std::vector<char>& live = live_;
  refill(live, cells_.size(), char{0});
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    const bool is_hidden = cell.cycle == cycle_ && cell.occluder.triangle != kNoTriangle;
    if (is_hidden || cell.regions != kNone || isUsed(cell.low)) live[i] = 1;
    if (isUsed(cell.link)) live[i] = live[links_[cell.link].next] = 1;
  }
  std::vector<std::uint32_t>& places = places_;
  refill(places, cells_.size(), kNone);
  table_.clear();
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (live[i] == 0) continue;
    places[i] = count;
    cells_[count] = cells_[i];
    table_.insert(cells_[count].a, cells_[count].b, count);
    ++count;
  }
  cells_.resize(count);
  live_cells_ = count;
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
  for (Cell& cell : cells_) {
    keep(cell.link);
    keep(cell.low);
  }
  links_.swap(links);
  for (const Region& region : regions_) {
    for (std::uint32_t m = region.members; m != kNone; m = memberships_[m].next_of_region) {
      memberships_[m].cell = places[memberships_[m].cell];
    }
  }
}

std::size_t VerdictMemory::memoryBytes() const {
  return borders_.memoryBytes() + table_.memoryBytes() + cells_.capacity() * sizeof(Cell) +
         (links_.capacity() + spare_links_.capacity()) * sizeof(Link) +
         memberships_.capacity() * sizeof(Membership) + regions_.capacity() * sizeof(Region) +
         live_.capacity() + places_.capacity() * sizeof(std::uint32_t);
}

}  // namespace concave_distance::detail
