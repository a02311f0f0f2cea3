#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "concave_distance/scene/cycle_counts.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/tracked_pair.h"
#include "sweep_and_prune.h"

namespace concave_distance {

/// True while it is the same body, of the same mesh, whatever else an edit has changed.
inline bool isSameBody(const SceneBody& l, const SceneBody& r) {
  return l.serial == r.serial && l.mesh == r.mesh;
}

/// Holds a tracker for each pair that the rules of a scene watch and whose bodies are near each other: their
/// boxes, each widened by half of the largest cutoff or warning distance that the body has, overlap. The rule
/// of a pair is asked when it comes near. One that has left rests for a while and comes back with its niches
/// and ids. A pair of which one body has no pose may be near and has a tracker too, up to 1000 of them; the
/// scene's limit of pairs holds for all.
class NearPairs {
 public:
  using Pairs = std::vector<std::shared_ptr<TrackedPair>>;

  /// Holds what another scene makes of this; adopt() takes it over and allocates nothing.
  struct Plan {
    Scene scene;
    struct Body {
      std::shared_ptr<const SceneBody> body;
      std::uint32_t slot = 0;
      double half_reach = 0.0;  ///< that its box is widened by, metres; below 0: no rule watches it
    };
    std::vector<Body> bodies;                                  ///< in the order of the scene
    std::unordered_map<std::uint64_t, std::uint32_t> slot_of;  ///< by SceneBody::serial
    std::vector<std::uint32_t> free_slots;
    std::vector<std::uint32_t> freed_slots;
    std::uint32_t slot_count = 0;
    /// For each near pair what it is in the new scene; nullptr: it leaves.
    std::vector<std::shared_ptr<const ScenePair>> pairs;
    std::vector<std::shared_ptr<const ScenePair>> resting;  ///< the same for each pair that rests
    std::size_t ruled = 0;                                  ///< enabled pairs by rule
    bool has_rules = false;
  };
  Plan plan(const Scene& scene, bool settings_changed) const;
  /// Pairs that leave have to be taken from pairs() before.
  void adopt(Plan&& plan, bool settings_changed, std::uint64_t& largest_id);

  /// World poses of the bodies of the scene, in their order; empty where one is not known.
  using Poses = std::vector<std::optional<Eigen::Isometry3d>>;
  /// Finds the pairs that are near. @param now seconds
  /// @param largest_id of niches of pairs that are gone, which it raises
  void update(const Poses& poses, double now, std::uint64_t& largest_id);
  /// After an update() that threw: nothing of the last cycle counts.
  void recover();

  const Pairs& pairs() const { return pairs_; }
  const Scene& scene() const { return now_.scene; }
  /// Changes whenever pairs() does.
  std::uint64_t revision() const { return revision_; }
  const OtherPairs& others() const { return others_; }

 private:
  struct Entry {
    SlotPair slots;
    bool is_by_box = false;      ///< the widened boxes overlap
    bool is_by_unknown = false;  ///< a body has no pose
  };
  struct Resting {
    SlotPair slots;
    double since = 0.0;
    std::shared_ptr<TrackedPair> pair;
  };
  void placeBoxes(const Poses& poses);
  void dropLeft(double now, std::uint64_t& largest_id);
  void dropRested(double now, std::uint64_t& largest_id);
  void admit(SlotPair slots, std::uint64_t largest_id, bool is_by_box);
  void admitUnknown(std::uint64_t largest_id);
  void admitCut(const Poses& poses, std::uint64_t largest_id);
  std::shared_ptr<TrackedPair> takeRested(SlotPair slots);
  std::size_t placeOf(std::uint32_t slot) const { return place_of_slot_[slot]; }
  void fillOthers();

  Plan now_;
  std::vector<std::size_t> place_of_slot_;  ///< in the scene
  SweepAndPrune sweep_;
  std::vector<Entry> entries_;  ///< beside pairs_
  Pairs pairs_;
  std::unordered_map<std::uint64_t, std::size_t> entry_of_;  ///< by both slots
  std::vector<Resting> resting_;                             ///< the oldest first
  std::vector<SlotPair> cut_;
  std::vector<bool> unknown_;
  std::vector<bool> unknown_before_;
  std::uint64_t missing_ = 0;
  double cut_bound_ = 0.0;
  OtherPairs others_;
  std::uint64_t revision_ = 0;
  bool asks_all_ = false;    ///< the rules may have changed
  bool keeps_left_ = false;  ///< nothing is known of the last cycle
};

}  // namespace concave_distance
