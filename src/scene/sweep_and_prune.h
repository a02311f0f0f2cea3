#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace concave_distance {

/// Two slots, the lesser first.
struct SlotPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

inline SlotPair slotPair(std::uint32_t a, std::uint32_t b) {
  return a < b ? SlotPair{a, b} : SlotPair{b, a};
}

/// A set of pairs of slots by hash: open addressing in one block, so that nothing is allocated once it has
/// its size.
class SlotPairSet {
 public:
  /// @return false when it was there
  bool insert(SlotPair pair);
  /// @return false when it was not there
  bool erase(SlotPair pair);
  bool contains(SlotPair pair) const;
  std::size_t size() const { return size_; }
  void clear();
  /// Calls act(SlotPair) for each; act must not change the set.
  template <typename Act>
  void visit(const Act& act) const {
    for (const std::uint64_t key : keys_) {
      if (key != kFree) act(pairOf(key));
    }
  }

 private:
  static constexpr std::uint64_t kFree = ~std::uint64_t{0};
  static std::uint64_t keyOf(SlotPair pair) { return std::uint64_t{pair.a} << 32U | pair.b; }
  static SlotPair pairOf(std::uint64_t key) {
    return {static_cast<std::uint32_t>(key >> 32U), static_cast<std::uint32_t>(key)};
  }
  std::size_t homeOf(std::uint64_t key) const;
  std::size_t placeOf(std::uint64_t key) const;
  void grow();

  std::vector<std::uint64_t> keys_;
  std::size_t size_ = 0;
};

/// Finds the pairs of boxes that overlap, from one time to the next: the ends of all boxes are kept sorted
/// along each axis, and what moves little swaps few neighbours (sweep and prune with temporal coherence:
/// Cohen, Lin, Manocha and Ponamgi 1995). Boxes that touch overlap; ends may be infinite. A warm update()
/// takes O(boxes + swaps) and allocates nothing. Many boxes that appear or jump at once are sorted anew.
class SweepAndPrune {
 public:
  /// Places the box of a slot for the next update(). A box with a NaN, or that ends before it begins, takes
  /// its slot out. Slots are numbers from 0 on, better without gaps.
  void set(std::uint32_t slot, const Eigen::Vector3d& lower, const Eigen::Vector3d& upper);
  void remove(std::uint32_t slot);
  void update();
  /// Forgets every box and pair; begun() and ended() are empty then.
  void clear();

  /// Returns the pairs that overlap since the last update(), and those that do not any more.
  const std::vector<SlotPair>& begun() const { return begun_; }
  const std::vector<SlotPair>& ended() const { return ended_; }
  const SlotPairSet& overlaps() const { return overlaps_; }
  /// Returns how many neighbours the last update() swapped; 0 when it sorted anew.
  std::uint64_t swaps() const { return swaps_; }

 private:
  struct Box {
    Eigen::Vector3d lower = Eigen::Vector3d::Zero();
    Eigen::Vector3d upper = Eigen::Vector3d::Zero();
    bool is_wanted = false;
    bool is_listed = false;  ///< its ends are in the lists
  };
  struct End {
    double value = 0.0;
    std::uint32_t slot = 0;
    bool is_upper = false;
  };
  static bool isBefore(const End& l, const End& r) {
    return l.value < r.value || (l.value == r.value && !l.is_upper && r.is_upper);
  }
  bool doOverlap(SlotPair pair) const;
  void takeOutRemoved();
  std::size_t addNew();
  bool sort(std::size_t axis);
  void sortAnew();
  void swap(const End& passing, const End& passed);

  std::vector<Box> boxes_;
  std::array<std::vector<End>, 3> ends_;
  SlotPairSet overlaps_;
  SlotPairSet others_;  ///< of sortAnew()
  std::vector<SlotPair> begun_;
  std::vector<SlotPair> ended_;
  std::vector<std::uint32_t> active_;
  std::uint64_t swaps_ = 0;
  bool has_removed_ = false;
};

}  // namespace concave_distance
