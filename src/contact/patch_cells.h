#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace concave_distance {

/// Size, metres, of the cells of a patch of this area; `now`, where that still fits. 0: none yet
double cellSize(double area, double now);

/// The axis that the push is nearest to, with its sign, and a cell of the plane across it: the two walls of a
/// slot do not share a cell, the two surfaces of one contact do. Places and pushes at round numbers are
/// common, so that no limit between cells is at one: else rounding would decide.
std::uint64_t cellOf(const Eigen::Vector3d& point, const Eigen::Vector3d& push, double size);

/// The axis with its sign.
inline std::uint64_t directionOf(std::uint64_t cell) {
  return cell >> 60U;
}

/// Adds up shares by the cell that they are in. A Share has `cell` and join(). Cleared, never freed.
template <typename Share>
class CellSums {
 public:
  void clear() { shares_.clear(); }
  // Neighbours in the list often share a cell.
  void add(const Share& share) {
    if (!shares_.empty() && shares_.back().cell == share.cell) {
      shares_.back().join(share);
    } else {
      shares_.push_back(share);
    }
  }
  /// Calls `visit` with the sum of each cell, by cell.
  template <typename Visit>
  void forEach(const Visit& visit) {
    order_.clear();
    for (const Share& share : shares_)
      order_.emplace_back(share.cell, static_cast<std::uint32_t>(order_.size()));
    std::sort(order_.begin(), order_.end());
    for (std::size_t next = 0; next < order_.size();) {
      Share sum = shares_[order_[next].second];
      for (++next; next < order_.size() && order_[next].first == sum.cell; ++next)
        sum.join(shares_[order_[next].second]);
      visit(sum);
    }
  }

 private:
  std::vector<Share> shares_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order_;
};

}  // namespace concave_distance
