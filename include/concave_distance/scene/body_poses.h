#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace concave_distance {

/// Where the bodies of a scene are in one cycle, in one frame, the world: each at its newest time and at the
/// newest times of other bodies before that, so that a pair has both its bodies at the earlier of two times.
struct BodyPoses {
  static constexpr std::int32_t kUnknown = -1;  ///< its pose is not known
  static constexpr std::int32_t kFixed = -2;    ///< it never moves in the world

  /// Gives body B in A at a time, where that is more exact than by the world (far from its origin).
  using Relative = std::function<Eigen::Isometry3d(std::size_t a, std::size_t b, std::size_t time)>;

  std::vector<double> times;         ///< seconds from any beginning, ascending
  double now = 0.0;                  ///< the time of two fixed bodies
  std::vector<std::int32_t> newest;  ///< of each body: place in `times`, kUnknown or kFixed
  std::vector<std::int32_t> oldest;  ///< likewise: its pose is known from here on
  /// world_from_body, stride() for each body, at the times up to its newest one; of a fixed body the first.
  std::vector<Eigen::Isometry3d> poses;
  Relative relative;  ///< empty: by the world

  std::size_t stride() const { return times.empty() ? 1 : times.size(); }
  const Eigen::Isometry3d& pose(std::size_t body, std::size_t time) const {
    return poses[body * stride() + (newest[body] == kFixed ? 0 : time)];
  }
  /// Makes room for `count` bodies at the times that stand in `times`, none of them known.
  void reset(std::size_t count) {
    newest.assign(count, kUnknown);
    oldest.assign(count, 0);
    poses.resize(count * stride());
  }
};

/// Counts the pairs that the rules of a scene watch and that have no tracker in a cycle.
struct OtherPairs {
  std::uint64_t beyond = 0;   ///< proven farther apart than their cutoff and warning distance
  std::uint64_t missing = 0;  ///< a body's pose is not known
  std::uint64_t cut = 0;      ///< near, but more than SceneLimits::pairs
  /// No pair of `beyond` or `cut` is nearer, metres, proven.
  double lower_bound = std::numeric_limits<double>::infinity();
};

}  // namespace concave_distance
