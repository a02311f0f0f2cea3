#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "carrier_motion.h"
#include "concave_distance/kinematics/constraint_rows.h"

namespace concave_distance::detail {

/// Finds what ConstraintRows::unlisted() says of one cycle, and how fast each can come nearer. Allocates
/// only where there is more of it than ever before.
class UnlistedSearch {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// Begins a cycle; the references are kept to its end. @param distance metres, of the rows
  void begin(const SceneKinematics& joints, const SceneState& state, const CarrierMotion& carriers,
             double distance);
  void addPairs(const SceneTracker::Pairs& pairs);
  /// @param distance metres, of the row that has no slot
  void addWithoutSlot(const std::shared_ptr<const TrackedPair>& pair, double distance);

  const std::vector<UnlistedPlaces>& found() const { return found_; }
  const Rows& reach() const { return reach_; }

 private:
  /// The velocity of a link by one joint: of its point at a reference point, and angular.
  struct Field {
    Eigen::Vector3d linear;
    Eigen::Vector3d angular;
    double largestIn(const UnlistedPlaces::Ball& ball, const Eigen::Vector3d& reference) const;
  };

  void addPair(const std::shared_ptr<const TrackedPair>& pair);
  void add(const std::shared_ptr<const TrackedPair>& pair, UnlistedReason reason, double lower_bound);
  void measure(UnlistedPlaces& places);
  void readFields(std::size_t body, const Eigen::Vector3d& reference, std::vector<Field>& fields);

  const SceneKinematics* joints_ = nullptr;
  const SceneState* state_ = nullptr;
  const CarrierMotion* carriers_ = nullptr;
  double distance_ = 0.0;
  bool has_moved_bodies_ = false;
  std::vector<UnlistedPlaces> found_;
  Rows reach_;  ///< with at least as many rows as found_
  std::vector<Field> of_a_;
  std::vector<Field> of_b_;
  Eigen::Matrix3Xd columns_;
};

}  // namespace concave_distance::detail
