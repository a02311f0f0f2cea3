#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace concave_distance::detail {

struct FlatBox {
  Eigen::Array3d low;
  Eigen::Array3d high;
};

/// A binary tree over boxes that is built for one query and thrown away: halves along the longest side.
class BoxTree {
 public:
  static constexpr std::uint32_t kLeafSize = 4;
  struct Node {
    FlatBox box;
    std::uint32_t first;  ///< inner: the second child (the first is next to the node); leaf: into order()
    std::uint32_t count;  ///< 0 for an inner node
  };

  void build(const std::vector<FlatBox>& boxes);
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  void buildNode(const std::vector<FlatBox>& boxes, std::uint32_t first, std::uint32_t last);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace concave_distance::detail
