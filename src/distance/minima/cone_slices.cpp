#include "cone_slices.h"

#include <algorithm>

namespace concave_distance::detail {
namespace {

// These are sizes of a slice. Few sweeps fill theirs before they are done.
constexpr std::size_t kLeastExpired = 64;
constexpr std::size_t kMostExpired = 512;
constexpr std::size_t kMostOpened = 64;
constexpr std::size_t kOpen = 512;
constexpr std::size_t kMinima = 64;

void clear(SweepLists& lists) {
  lists.open.clear();
  lists.minima.clear();
  lists.undecided.clear();
  lists.candidates.clear();
  lists.kept.clear();
  lists.groups = lists.features = lists.measured = 0;
}

}  // namespace

void ConeSlices::prepare() {
  if (!slices_.empty()) return;
  slices_.resize(kCount);
  for (Slice& slice : slices_) {
    slice.lists.open.reserve(kOpen);
    slice.lists.minima.reserve(kMinima);
    slice.lists.undecided.reserve(kMinima);
    slice.lists.candidates.reserve(kMinima);
    slice.lists.kept.reserve(kMostKept);
  }
}

std::size_t ConeSlices::takeExpired(const SlotPair* first, std::size_t count) {
  // Whole comparisons of four.
  const std::size_t even = 4 * ((count / kCount + 3) / 4);
  const std::size_t size = std::min(std::max(even, kLeastExpired), kMostExpired);
  std::size_t taken = 0;
  for (used_ = 0; used_ < kCount && taken < count; ++used_) {
    const std::size_t end = std::min(taken + size, count);
    clear(slices_[used_].lists);
    slices_[used_].expired = {first + taken, first + end};
    taken = end;
  }
  return taken;
}

void ConeSlices::takeOpen(std::vector<SlotPair>& open) {
  const std::size_t count = std::min(open.size(), kCount * kMostOpened);
  const std::size_t size = (count + kCount - 1) / kCount;
  const SlotPair* const first = open.data() + (open.size() - count);
  std::size_t taken = 0;
  for (used_ = 0; used_ < kCount && taken < count; ++used_) {
    const std::size_t end = std::min(taken + size, count);
    clear(slices_[used_].lists);
    slices_[used_].lists.open.assign(first + taken, first + end);
    slices_[used_].expired = {nullptr, nullptr};
    taken = end;
  }
  open.resize(open.size() - count);
}

}  // namespace concave_distance::detail
