#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "concave_distance/kinematics/constraint_rows.h"

namespace concave_distance::detail {

/// Names a niche over time, through edits of the scene.
struct NicheKey {
  std::uint64_t body_a = 0;  ///< SceneBody::serial
  std::uint64_t body_b = 0;
  std::uint64_t niche = 0;

  bool operator==(const NicheKey& other) const {
    return body_a == other.body_a && body_b == other.body_b && niche == other.niche;
  }
};

/// A row that wants a slot.
struct SlotRequest {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  NicheKey key;
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();  ///< metres, in A's own frame
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();  ///< metres, in B's own frame
  double distance = 0.0;                           ///< metres; the nearest go first
  bool may_begin = true;                           ///< false: only a row that has a slot goes on
  std::size_t slot = kNone;                        ///< the answer
};

/// Gives rows their slots. A row goes on where its niche had one: of several the one whose point has moved
/// least on either body. A new row gets the first slot that is free, or else the one that was freed first, or
/// else that of the farthest row, when that is farther.
class SlotTable {
 public:
  struct Slot {
    SlotState state = SlotState::Free;
    std::uint64_t since = 0;  ///< the cycle in which the state began
    NicheKey key;
    Eigen::Vector3d on_a = Eigen::Vector3d::Zero();
    Eigen::Vector3d on_b = Eigen::Vector3d::Zero();
  };

  explicit SlotTable(std::size_t capacity) : slots_(capacity), owners_(capacity) {}

  /// One cycle. @return how many requests that may begin have no slot
  std::size_t assign(std::vector<SlotRequest>& requests);
  void clear();
  /// Lets a used slot's state begin in this cycle.
  void renew(std::size_t slot) { slots_[slot].since = cycle_; }
  const std::vector<Slot>& slots() const { return slots_; }
  std::uint64_t cycle() const { return cycle_; }
  /// Returns whether a niche has a slot.
  bool holds(const NicheKey& key) const;

 private:
  struct Match {
    double moved;  ///< metres
    std::size_t request;
    std::size_t slot;
  };

  void keepKnown(std::vector<SlotRequest>& requests);
  void freeOthers();
  std::size_t findFree() const;
  void take(std::size_t slot, std::size_t request, std::vector<SlotRequest>& requests, bool is_new);

  std::vector<Slot> slots_;
  std::vector<std::size_t> owners_;  ///< of slots: places in the requests of this cycle
  std::vector<Match> matches_;
  std::vector<std::size_t> order_;
  std::uint64_t cycle_ = 0;
};

}  // namespace concave_distance::detail
