#include "normal_cone_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "normal_cone.h"
#include "normal_cone_items.h"

namespace concave_distance {
namespace {

using Eigen::Vector3d;
using Item = NormalConeTree::Item;
using Node = NormalConeTree::Node;

/// Half splits that put nearly everything on one side are redone by count, so that the depth stays bounded.
constexpr std::uint32_t kMostUneven = 16;
/// A turn of the normals by one radian counts like this fraction of the body's diameter: what directions to
/// a point as far away change by over that length.
constexpr double kDiametersPerRadian = 0.15;

/// Smaller bodies are compared in this unit: its reciprocal must not overflow.
constexpr int kLeastExponent = -1000;

/// What lies around some items, in double precision.
struct Bound {
  Vector3d centre;
  double radius;
  DirectionCap cap;
};

/// Single precision errs by less than this, relative to a body's size or as an angle.
constexpr double kFloatMargin = 0x1.0p-21;

class ConeTreeBuilder {
 public:
  ConeTreeBuilder(std::vector<Item>& items, std::vector<Node>& nodes, const Vector3d& origin, double unit,
                  double diameter)
      : items_(items),
        nodes_(nodes),
        origin_(origin),
        unit_(unit),
        length_of_radian_(kDiametersPerRadian * diameter) {}

  void build() {
    const auto count = static_cast<std::uint32_t>(items_.size());
    nodes_.emplace_back();
    const std::uint32_t child = count == 1 ? NormalConeTree::kItemFlag : buildNode({0, count});
    Node root{};
    setLane(root, 0, bound({0, count}), child);
    repeatLast(root, 1);
    nodes_[0] = root;
  }

 private:
  struct Range {
    std::uint32_t first;
    std::uint32_t last;
    std::uint32_t count() const { return last - first; }
  };

  /// A node over two items or more; returns where it stands.
  std::uint32_t buildNode(Range range) {
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    std::array<Range, NormalConeTree::kWidth> parts{range};
    std::size_t count = 1;
    while (count < parts.size()) {
      const auto largest =
          std::max_element(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count),
                           [](const Range& l, const Range& r) { return l.count() < r.count(); });
      if (largest->count() < 2) break;
      const std::uint32_t middle = split(largest->first, largest->last);
      parts[count++] = {middle, largest->last};
      largest->last = middle;
    }
    Node node{};
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Range& part = parts[lane];
      const std::uint32_t child =
          part.count() == 1 ? part.first | NormalConeTree::kItemFlag : buildNode(part);
      setLane(node, lane, bound(part), child);
    }
    repeatLast(node, count);
    nodes_[self] = node;
    return self;
  }

  void setLane(Node& node, std::size_t lane, const Bound& bound, std::uint32_t child) const {
    const Vector3d centre = (bound.centre - origin_) / unit_;
    double missed = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      node.centre[k][lane] = static_cast<float>(centre[axis]);
      missed += std::abs(centre[axis] - static_cast<double>(node.centre[k][lane]));
      node.axis[k][lane] = static_cast<float>(bound.cap.axis[axis]);
    }
    node.radius[lane] = static_cast<float>((bound.radius / unit_ + missed) * (1.0 + kFloatMargin));
    const double angle = bound.cap.isFull()
                             ? M_PI
                             : std::min(M_PI, std::atan2(bound.cap.sine, bound.cap.cosine) + kFloatMargin);
    node.angle[lane] = static_cast<float>(angle);
    node.cosine[lane] = static_cast<float>(std::cos(angle));
    node.sine[lane] = static_cast<float>(std::sin(angle));
    node.child[lane] = child;
  }

  static void repeatLast(Node& node, std::size_t count) {
    for (std::size_t lane = count; lane < NormalConeTree::kWidth; ++lane) {
      for (std::size_t k = 0; k < 3; ++k) {
        node.centre[k][lane] = node.centre[k][count - 1];
        node.axis[k][lane] = node.axis[k][count - 1];
      }
      node.radius[lane] = node.radius[count - 1];
      node.angle[lane] = node.angle[count - 1];
      node.cosine[lane] = node.cosine[count - 1];
      node.sine[lane] = node.sine[count - 1];
      node.child[lane] = NormalConeTree::kNoChild;
    }
  }

  double coordinate(const Item& item, int which) const {
    if (which < 3) return item.centre[which];
    return item.cap.isFull() ? 0.0 : length_of_radian_ * item.cap.axis[which - 3];
  }

  Bound bound(Range range) const {
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
    Vector3d high = -low;
    for (std::uint32_t i = range.first; i < range.last; ++i) {
      low = low.cwiseMin((items_[i].centre.array() - items_[i].radius).matrix());
      high = high.cwiseMax((items_[i].centre.array() + items_[i].radius).matrix());
    }
    Bound result{0.5 * (low + high), 0.0, items_[range.first].cap};
    for (std::uint32_t i = range.first; i < range.last; ++i) {
      result.radius = std::max(result.radius, (items_[i].centre - result.centre).norm() + items_[i].radius);
      result.cap = detail::capAround(result.cap, items_[i].cap);
    }
    result.radius *= 1.0 + 1e-12;
    return result;
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
  Vector3d origin_;
  double unit_;
  double length_of_radian_;
};

}  // namespace

NormalConeTree::NormalConeTree(const SurfaceMesh& mesh, const MeshTopology& topology, NormalSides sides,
                               const std::vector<bool>& hidden)
    : items_(detail::collectConeItems(mesh, topology, sides, hidden)) {
  items_.shrink_to_fit();
  if (items_.empty()) return;
  origin_ = mesh.boundingBox().center();
  const int exponent = mesh.diameter() > 0.0 ? std::ilogb(mesh.diameter()) : 0;
  unit_ = std::ldexp(1.0, std::max(exponent, kLeastExponent));
  nodes_.reserve(items_.size() / 2);
  ConeTreeBuilder(items_, nodes_, origin_, unit_, mesh.diameter()).build();
  nodes_.shrink_to_fit();
  chooseRegions();
}

Eigen::Vector3d NormalConeTree::centreOf(Slot slot) const {
  const Node& node = nodes_[slot / kWidth];
  const std::size_t lane = slot % kWidth;
  return unit_ * Vector3d(node.centre[0][lane], node.centre[1][lane], node.centre[2][lane]);
}

void NormalConeTree::chooseRegions() {
  // The largest spheres are opened until there are enough.
  const auto radius = [this](Slot slot) { return nodes_[slot / kWidth].radius[slot % kWidth]; };
  const auto isItem = [this](Slot slot) { return (child(slot) & kItemFlag) != 0; };
  std::vector<Slot> tops{kRoot};
  std::vector<Slot> opened;
  while (tops.size() + kWidth - 1 <= kMostRegions) {
    const auto largest = std::max_element(tops.begin(), tops.end(), [&](Slot l, Slot r) {
      return isItem(l) != isItem(r) ? isItem(l) : radius(l) < radius(r);
    });
    if (isItem(*largest)) break;
    const Slot slot = *largest;
    tops.erase(largest);
    opened.push_back(slot);
    for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
      const Slot below = child(slot) * static_cast<Slot>(kWidth) + lane;
      if (child(below) != kNoChild) tops.push_back(below);
    }
  }
  region_of_slot_.assign(nodes_.size() * kWidth, 0);
  const double rounding = kFloatMargin * unit_;
  const auto put = [&](Slot slot, std::size_t region) {
    region_of_slot_[slot] = static_cast<std::uint8_t>(region);
    regions_[region].arm =
        std::max(regions_[region].arm, (centreOf(slot) - regions_[region].centre).norm() + 4.0 * rounding);
  };
  regions_.reserve(tops.size());
  for (const Slot top : tops) regions_.push_back({centreOf(top), 0.0});
  std::vector<Slot> open;
  for (std::size_t region = 0; region < tops.size(); ++region) {
    open.assign(1, tops[region]);
    while (!open.empty()) {
      const Slot slot = open.back();
      open.pop_back();
      put(slot, region);
      if (isItem(slot)) continue;
      for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
        const Slot below = child(slot) * static_cast<Slot>(kWidth) + lane;
        if (child(below) != kNoChild) open.push_back(below);
      }
    }
  }
  for (const Slot slot : opened) {
    const auto nearest =
        std::min_element(regions_.begin(), regions_.end(), [&](const Region& l, const Region& r) {
          return (l.centre - centreOf(slot)).squaredNorm() < (r.centre - centreOf(slot)).squaredNorm();
        });
    put(slot, static_cast<std::size_t>(nearest - regions_.begin()));
  }
}

}  // namespace concave_distance
