#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "concave_distance/base/not_computed.h"
#include "concave_distance/kinematics/scene_kinematics.h"
#include "concave_distance/scene/scene_tracker.h"

namespace concave_distance {

struct ConstraintSettings {
  double distance = 0.1;        ///< metres; niches within it have rows
  std::uint32_t capacity = 64;  ///< slots; with more rows than that, the farthest have none
  /// Radians; edges and faces of the smaller body's size that are tilted by less have rows for their corners.
  double tilt = 1e-4;
};

enum class SlotState : std::uint8_t {
  Free,  ///< has no row
  Used,  ///< has one
  Freed  ///< has had one less than ConstraintRows::kQuarantine cycles ago, and gets no other while there is
         ///< room
};

/// One row: what a change of joint positions does to one place where two bodies could touch next. The signed
/// value v changes by `row of jacobian() * velocities - drift` m/s. World frame, where nothing else is said.
struct ConstraintRow {
  SlotState state = SlotState::Free;        ///< all that follows holds where it is Used
  std::shared_ptr<const TrackedPair> pair;  ///< nullptr where it is not
  std::uint64_t niche_id = 0;               ///< several rows have one where the niche is a segment or patch
  std::uint64_t age = 0;              ///< cycles since this row has its slot, or its signed value has jumped
  double value = kNotComputed;        ///< metres: signed distance of the place
  bool is_overlapping = false;        ///< without a signed value: value is 0, and in truth less
  double lower_bound = kNotComputed;  ///< metres, proven: no place of the pair is nearer
  Eigen::Vector3d normal = Eigen::Vector3d::Constant(kNotComputed);   ///< from A to B
  Eigen::Vector3d point_a = Eigen::Vector3d::Constant(kNotComputed);  ///< metres
  Eigen::Vector3d point_b = Eigen::Vector3d::Constant(kNotComputed);
  /// The points in the frames of the bodies (SceneBody::frame): the links, for bodies on robots.
  Eigen::Vector3d point_a_in_frame = Eigen::Vector3d::Constant(kNotComputed);
  Eigen::Vector3d point_b_in_frame = Eigen::Vector3d::Constant(kNotComputed);
  /// m/s, positive when approaching: the part of the closing speed that is of other bodies and of the roots
  /// of robots, from their poses in the last update(); NaN in a first one, and when the time did not advance.
  double drift = kNotComputed;
  double drift_a = kNotComputed;  ///< m/s: the part of `drift` that A's carrier makes
  double drift_b = kNotComputed;  ///< m/s: ... and body B's
};

enum class UnlistedReason : std::uint8_t {
  NoPose,      ///< a body has no pose
  Unsolved,    ///< the pair has no answer
  Unfinished,  ///< its list of niches is not proven complete: the end of a cycle, a limit or its preparation
  BeyondCutoff,  ///< it is not searched beyond its cutoff, which is less than the rows' distance
  NoSlot         ///< all slots have nearer rows
};

/// Says of which pairs places within the rows' distance may have no row, and how near these can be. Such a
/// place comes nearer by at most `row of reach() * |velocities| + drift` m/s.
struct UnlistedPlaces {
  /// A ball around a body, metres, in the world.
  struct Ball {
    Eigen::Vector3d centre = Eigen::Vector3d::Constant(kNotComputed);
    double radius = kNotComputed;
  };
  UnlistedReason reason = UnlistedReason::Unsolved;
  std::shared_ptr<const TrackedPair> pair;  ///< nullptr with NoPose: all pairs of `body`
  std::size_t body = 0;                     ///< place in Scene::bodies, with NoPose
  double lower_bound = kNotComputed;        ///< metres: none of them is nearer; NaN: they can be anywhere
  double drift = kNotComputed;              ///< m/s, at most; NaN: not known
  Ball ball_a;
  Ball ball_b;
};

/// Rows for those who act: for every niche within a distance, of pairs that a joint can move, how its
/// distance changes with the joints of all robots. A row keeps its place (slot) while its niche lives, so
/// that a solver may keep its factors and multipliers. One thread at a time. After the first cycles an update
/// allocates nothing.
class ConstraintRows {
 public:
  static constexpr std::uint64_t kQuarantine = 10;  ///< cycles

  /// @throws Error for a distance that is not positive and for no capacity, or one of more than 100000
  explicit ConstraintRows(std::shared_ptr<const SceneKinematics> joints, ConstraintSettings settings = {});
  ~ConstraintRows();
  ConstraintRows(ConstraintRows&&) noexcept;
  ConstraintRows& operator=(ConstraintRows&&) noexcept;

  /// Another revision of the scene: rows of bodies that are in both go on.
  void setScene(std::shared_ptr<const SceneKinematics> joints);
  /// Frees all slots. The next rows get them in the order of their distance.
  void reset();

  /// Makes the rows of one cycle. @param pairs of a SceneTracker, with niches @param state that the cycle was
  /// run at; pairs of bodies without a pose have no rows
  /// @param time seconds, as of the cycle
  /// @throws Error for a state of another number of bodies or robots
  void update(const SceneTracker::Pairs& pairs, const SceneState& state, double time);

  /// One for each slot, always as many as the capacity.
  const std::vector<ConstraintRow>& rows() const;
  /// A row for each slot, zero where it is not Used; columns as SceneKinematics::velocityNames().
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& jacobian() const;
  /// How many rows of the last update() have no slot: the farthest.
  std::size_t overflow() const;
  /// Lists what may be near without a row, of the last update(). At levels below `certified`, which prove no
  /// list, only pairs without an answer and rows without a slot are here.
  const std::vector<UnlistedPlaces>& unlisted() const;
  /// A row for each of unlisted(): m/s for a rad/s or m/s at most; columns as those of jacobian().
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& reach() const;
  const SceneKinematics& joints() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace concave_distance
