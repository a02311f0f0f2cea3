#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace concave_distance {

/// Disjoint sets of the numbers 0 to count - 1. Each set has one representative.
class UnionFind {
 public:
  UnionFind() = default;
  explicit UnionFind(std::size_t count) { reset(count); }

  /// Makes each number a set of its own; the capacity is kept.
  void reset(std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /// Makes a set of one more number and returns it.
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  std::size_t size() const { return parent_.size(); }

  /// Returns the representative of the set that holds `i`.
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  bool areJoined(std::uint32_t i, std::uint32_t j) { return find(i) == find(j); }

  /// Joins two sets. The lower representative becomes that of both.
  void unite(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    if (i != j) attach(i < j ? j : i, i < j ? i : j);
  }

  /// Joins two sets, given by their representatives: that of the second becomes that of both.
  void attach(std::uint32_t root, std::uint32_t new_root) { parent_[root] = new_root; }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace concave_distance
