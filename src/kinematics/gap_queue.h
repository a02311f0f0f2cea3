#pragma once

#include <cstddef>
#include <vector>

#include "clearance_gap.h"

namespace concave_distance::detail {

/// Keeps the gaps that a search has yet to look at, the one with the least order first.
class GapQueue {
 public:
  bool isEmpty() const { return open_.empty(); }
  void push(const ClearanceGap& gap, double order);
  /// Takes out the first gap and returns its place, which it keeps until that is freed.
  std::size_t pop();
  void free(std::size_t place) { free_.push_back(place); }
  const ClearanceGap& operator[](std::size_t place) const { return gaps_[place]; }

  /// Calls visit(gap) for all that were not taken out.
  template <typename Visit>
  void visit(const Visit& visit) const {
    for (const Key& key : open_) visit(gaps_[key.gap]);
  }

 private:
  struct Key {
    double order;
    std::size_t pair;
    double moment;
    std::size_t gap;                         ///< place in gaps_
    bool operator<(const Key& other) const;  ///< for std::push_heap: the first has the least order
  };

  std::vector<ClearanceGap> gaps_;
  std::vector<std::size_t> free_;  ///< places in gaps_
  std::vector<Key> open_;          ///< a heap
};

}  // namespace concave_distance::detail
