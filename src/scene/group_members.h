#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance::detail {

/// Says which bodies of a scene stand for each of its groups: its members, and what is attached to one of
/// them or to a frame that moves with a robot's link among them.
class GroupMembers {
 public:
  /// One bit for each group.
  using Mask = std::uint64_t;
  static constexpr std::size_t kMostGroups = 64;

  GroupMembers() = default;
  /// Takes the first kMostGroups of scene.groups. O(bodies + members).
  explicit GroupMembers(const Scene& scene);

  const std::vector<std::string>& names() const { return names_; }
  /// Returns the groups that one of two bodies stands for and the other does not. Places in scene.bodies.
  Mask facing(std::size_t body_a, std::size_t body_b) const { return masks_[body_a] ^ masks_[body_b]; }
  /// Counts the enabled pairs by rule of the same scene that face this group. O(bodies x classes).
  std::size_t countFacing(const Scene& scene, std::size_t group) const;

 private:
  std::vector<std::string> names_;
  std::vector<Mask> masks_;  ///< by body
};

}  // namespace concave_distance::detail
