#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace concave_distance::detail {

/// Disjoint sets of 0 .. count - 1; the representative of a set is its lowest member.
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }

  void unite(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    if (i != j) {
      parent_[i < j ? j : i] = i < j ? i : j;
    }
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace concave_distance::detail
