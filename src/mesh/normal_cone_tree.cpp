#include "concave_distance/mesh/normal_cone_tree.h"

#include <algorithm>
#include <limits>

#include "normal_cone.h"
#include "normal_cone_items.h"

namespace concave_distance {
namespace {

using Eigen::Vector3d;
using Item = NormalConeTree::Item;
using Node = NormalConeTree::Node;

constexpr std::uint32_t kLargestLeaf = 2;
/// Half splits that put nearly everything on one side are redone by count, so that the depth stays bounded.
constexpr std::uint32_t kMostUneven = 16;
/// A turn of the normals by one radian counts like this fraction of the body's diameter: what directions to
/// a point as far away change by over that length.
constexpr double kDiametersPerRadian = 0.15;

class Builder {
 public:
  Builder(std::vector<Item>& items, std::vector<Node>& nodes, double diameter)
      : items_(items), nodes_(nodes), length_of_radian_(kDiametersPerRadian * diameter) {}

  void build(std::uint32_t first, std::uint32_t last) {
    const std::size_t self = nodes_.size();
    nodes_.push_back(bound(first, last));
    if (last - first <= kLargestLeaf) {
      nodes_[self].first = first;
      nodes_[self].count = last - first;
      return;
    }
    const std::uint32_t middle = split(first, last);
    build(first, middle);
    nodes_[self].first = static_cast<std::uint32_t>(nodes_.size());
    build(middle, last);
  }

 private:
  double coordinate(const Item& item, int which) const {
    if (which < 3) return item.centre[which];
    return item.cap.isFull() ? 0.0 : length_of_radian_ * item.cap.axis[which - 3];
  }

  Node bound(std::uint32_t first, std::uint32_t last) const {
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
    Vector3d high = -low;
    for (std::uint32_t i = first; i < last; ++i) {
      low = low.cwiseMin((items_[i].centre.array() - items_[i].radius).matrix());
      high = high.cwiseMax((items_[i].centre.array() + items_[i].radius).matrix());
    }
    Node node{0.5 * (low + high), 0.0, items_[first].cap, 0, 0};
    for (std::uint32_t i = first; i < last; ++i) {
      node.radius = std::max(node.radius, (items_[i].centre - node.centre).norm() + items_[i].radius);
      node.cap = detail::capAround(node.cap, items_[i].cap);
    }
    node.radius *= 1.0 + 1e-12;
    return node;
  }

  std::uint32_t split(std::uint32_t first, std::uint32_t last) {
    int widest = 0;
    double extent = -1.0;
    double half = 0.0;
    for (int which = 0; which < 6; ++which) {
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      for (std::uint32_t i = first; i < last; ++i) {
        low = std::min(low, coordinate(items_[i], which));
        high = std::max(high, coordinate(items_[i], which));
      }
      if (high - low > extent) {
        extent = high - low;
        half = 0.5 * (low + high);
        widest = which;
      }
    }
    const auto begin = items_.begin();
    const auto cut = std::partition(begin + first, begin + last,
                                    [&](const Item& item) { return coordinate(item, widest) < half; });
    const auto middle = static_cast<std::uint32_t>(cut - begin);
    const std::uint32_t least = (last - first) / kMostUneven;
    if (middle - first > least && last - middle > least) return middle;
    const std::uint32_t by_count = first + (last - first) / 2;
    std::nth_element(begin + first, begin + by_count, begin + last, [&](const Item& l, const Item& r) {
      const double cl = coordinate(l, widest);
      const double cr = coordinate(r, widest);
      if (cl != cr) return cl < cr;
      if (l.triangle != r.triangle) return l.triangle < r.triangle;
      return l.kind != r.kind ? l.kind < r.kind : l.element < r.element;
    });
    return by_count;
  }

  std::vector<Item>& items_;
  std::vector<Node>& nodes_;
  double length_of_radian_;
};

}  // namespace

NormalConeTree::NormalConeTree(const SurfaceMesh& mesh, const MeshTopology& topology, NormalSides sides)
    : items_(detail::collectConeItems(mesh, topology, sides)) {
  items_.shrink_to_fit();
  if (items_.empty()) return;
  nodes_.reserve(items_.size());
  Builder(items_, nodes_, mesh.diameter()).build(0, static_cast<std::uint32_t>(items_.size()));
  nodes_.shrink_to_fit();
}

}  // namespace concave_distance
