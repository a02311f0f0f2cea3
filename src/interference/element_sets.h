#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace concave_distance::detail {

/// Disjoint sets of crossing nodes and inside vertices: what hangs together.
class ElementSets {
 public:
  void reset(std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  std::uint32_t find(std::uint32_t element) {
    while (parent_[element] != element) {
      parent_[element] = parent_[parent_[element]];
      element = parent_[element];
    }
    return element;
  }
  void unite(std::uint32_t l, std::uint32_t r) {
    l = find(l);
    r = find(r);
    if (l < r) {
      parent_[r] = l;
    } else {
      parent_[l] = r;
    }
  }
  std::size_t size() const { return parent_.size(); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace concave_distance::detail
