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
using Group = NormalConeTree::Group;

/// Half splits that put nearly everything on one side are redone by count, so that the depth stays bounded.
constexpr std::uint32_t kMostUneven = 16;
/// A turn of the normals by one radian counts like this fraction of the body's diameter: what directions to
/// a point as far away change by over that length.
constexpr double kDiametersPerRadian = 0.15;

/// Bodies with few items have few subtrees.
constexpr std::size_t kLeastItemsOfSubtree = 16;

/// Smaller bodies are compared in this unit: its reciprocal must not overflow.
constexpr int kLeastExponent = -1000;

/// Bounds some items, in double precision.
struct Bound {
  Vector3d centre;
  double radius;
  DirectionCap cap;
};

/// Single precision errs by less than this, relative to a body's size or as an angle.
constexpr double kFloatMargin = 0x1.0p-21;

class ConeTreeBuilder {
 public:
  ConeTreeBuilder(std::vector<Item>& items, std::vector<Group>& groups, const Vector3d& origin, double unit,
                  double diameter)
      : items_(items),
        groups_(groups),
        origin_(origin),
        unit_(unit),
        length_of_radian_(kDiametersPerRadian * diameter) {}

  void build() {
    const auto count = static_cast<std::uint32_t>(items_.size());
    groups_.resize(NormalConeTree::kWidth);
    const std::uint32_t child = count == 1 ? NormalConeTree::kItemFlag : buildParts({0, count});
    groups_[0] = groupOf(bound({0, count}), child);
    repeatLast(0, 1);
  }

 private:
  struct Range {
    std::uint32_t first;
    std::uint32_t last;
    std::uint32_t count() const { return last - first; }
  };

  /// Builds the groups of two items or more; returns the first one's slot.
  std::uint32_t buildParts(Range range) {
    const auto first = static_cast<std::uint32_t>(groups_.size());
    groups_.resize(groups_.size() + NormalConeTree::kWidth);
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
    for (std::size_t k = 0; k < count; ++k) {
      const Range& part = parts[k];
      const std::uint32_t child =
          part.count() == 1 ? part.first | NormalConeTree::kItemFlag : buildParts(part);
      groups_[first + k] = groupOf(bound(part), child);
    }
    repeatLast(first, count);
    return first;
  }

  Group groupOf(const Bound& bound, std::uint32_t child) const {
    const Vector3d centre = (bound.centre - origin_) / unit_;
    double missed = 0.0;
    Group group{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      group.centre[k] = static_cast<float>(centre[axis]);
      missed += std::abs(centre[axis] - static_cast<double>(group.centre[k]));
      group.axis[k] = static_cast<float>(bound.cap.axis[axis]);
    }
    group.radius = static_cast<float>((bound.radius / unit_ + missed) * (1.0 + kFloatMargin));
    const double angle = bound.cap.isFull()
                             ? M_PI
                             : std::min(M_PI, std::atan2(bound.cap.sine, bound.cap.cosine) + kFloatMargin);
    group.angle = static_cast<float>(angle);
    group.cosine = static_cast<float>(std::cos(angle));
    group.sine = static_cast<float>(std::sin(angle));
    group.child = child;
    return group;
  }

  void repeatLast(std::size_t first, std::size_t count) {
    for (std::size_t k = count; k < NormalConeTree::kWidth; ++k) {
      groups_[first + k] = groups_[first + count - 1];
      groups_[first + k].child = NormalConeTree::kNoChild;
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
  std::vector<Group>& groups_;
  Vector3d origin_;
  double unit_;
  double length_of_radian_;
};

}  // namespace

NormalConeTree::NormalConeTree(const SurfaceMesh& mesh, const MeshTopology& topology, NormalSides sides,
                               const ShellContacts& joints)
    : items_(detail::collectConeItems(mesh, topology, sides, joints)) {
  items_.shrink_to_fit();
  if (items_.empty()) return;
  origin_ = mesh.boundingBox().center();
  const int exponent = mesh.diameter() > 0.0 ? std::ilogb(mesh.diameter()) : 0;
  unit_ = std::ldexp(1.0, std::max(exponent, kLeastExponent));
  groups_.reserve(2 * items_.size());
  ConeTreeBuilder(items_, groups_, origin_, unit_, mesh.diameter()).build();
  groups_.shrink_to_fit();
  chooseSubtrees();
}

Eigen::Vector3d NormalConeTree::centreOf(Slot slot) const {
  const Group& group = groups_[slot];
  return unit_ * Vector3d(group.centre[0], group.centre[1], group.centre[2]);
}

void NormalConeTree::chooseSubtrees() {
  // The largest spheres are opened until there are enough.
  const auto radius = [this](Slot slot) { return groups_[slot].radius; };
  const std::size_t most = std::min(kMostSubtrees, 1 + items_.size() / kLeastItemsOfSubtree);
  const auto is_item = [this](Slot slot) { return (child(slot) & kItemFlag) != 0; };
  std::vector<Slot> tops{kRoot};
  std::vector<Slot> opened;
  while (tops.size() + kWidth - 1 <= most) {
    const auto largest = std::max_element(tops.begin(), tops.end(), [&](Slot l, Slot r) {
      return is_item(l) != is_item(r) ? is_item(l) : radius(l) < radius(r);
    });
    if (is_item(*largest)) break;
    const Slot slot = *largest;
    tops.erase(largest);
    opened.push_back(slot);
    for (Slot below = child(slot); below < child(slot) + kWidth; ++below) {
      if (child(below) != kNoChild) tops.push_back(below);
    }
  }
  const double rounding = kFloatMargin * unit_;
  const auto put = [&](Slot slot, std::size_t subtree) {
    groups_[slot].subtree = static_cast<std::uint32_t>(subtree);
    subtrees_[subtree].arm = std::max(subtrees_[subtree].arm,
                                      (centreOf(slot) - subtrees_[subtree].centre).norm() + 4.0 * rounding);
  };
  subtrees_.reserve(tops.size());
  for (const Slot top : tops) subtrees_.push_back({centreOf(top), 0.0});
  std::vector<Slot> open;
  for (std::size_t subtree = 0; subtree < tops.size(); ++subtree) {
    open.assign(1, tops[subtree]);
    while (!open.empty()) {
      const Slot slot = open.back();
      open.pop_back();
      put(slot, subtree);
      if (is_item(slot)) continue;
      for (Slot below = child(slot); below < child(slot) + kWidth; ++below) {
        if (child(below) != kNoChild) open.push_back(below);
      }
    }
  }
  for (const Slot slot : opened) {
    const auto nearest =
        std::min_element(subtrees_.begin(), subtrees_.end(), [&](const Subtree& l, const Subtree& r) {
          return (l.centre - centreOf(slot)).squaredNorm() < (r.centre - centreOf(slot)).squaredNorm();
        });
    put(slot, static_cast<std::size_t>(nearest - subtrees_.begin()));
  }
}

}  // namespace concave_distance
