#include "box_tree.h"

#include <algorithm>
#include <numeric>

namespace concave_distance::detail {

void BoxTree::build(const std::vector<FlatBox>& boxes) {
  nodes_.clear();
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0U);
  if (!boxes.empty()) buildNode(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
}

void BoxTree::buildNode(const std::vector<FlatBox>& boxes, std::uint32_t first, std::uint32_t last) {
  Node node{boxes[order_[first]], first, last - first};
  for (std::uint32_t i = first + 1; i < last; ++i) {
    node.box.low = node.box.low.min(boxes[order_[i]].low);
    node.box.high = node.box.high.max(boxes[order_[i]].high);
  }
  const std::size_t index = nodes_.size();
  nodes_.push_back(node);
  if (node.count <= kLeafSize) return;
  Eigen::Index axis = 0;
  (node.box.high - node.box.low).maxCoeff(&axis);
  const std::uint32_t middle = first + node.count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t l, std::uint32_t r) {
                     const double at_l = boxes[l].low[axis] + boxes[l].high[axis];
                     const double at_r = boxes[r].low[axis] + boxes[r].high[axis];
                     return at_l != at_r ? at_l < at_r : l < r;
                   });
  buildNode(boxes, first, middle);
  nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[index].count = 0;
  buildNode(boxes, middle, last);
}

}  // namespace concave_distance::detail
