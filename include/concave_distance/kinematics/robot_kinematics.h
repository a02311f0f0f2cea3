#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/base/eigen_alignment.h"

namespace concave_distance {

namespace detail {
struct RobotStructure;
class RobotTree;
}  // namespace detail

/// Where a robot is: its links, and what its joints turn about or slide along, all in one frame, the world.
struct RobotState {
  struct Axis {
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit vector
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();     ///< metres, a point of the axis
    bool turns = true;                                    ///< false: slides
  };
  std::vector<Eigen::Isometry3d> world_from_link;  ///< in the order of RobotKinematics::linkNames()
  std::vector<Axis> axes;                          ///< what RobotKinematics needs for Jacobians
};

/// The joints of a URDF: from their positions to the poses of links and the Jacobians of points on them.
/// Immutable, so that threads may share one; each has a RobotState of its own.
///
/// Positions are one vector: joints in the order of the URDF, without fixed ones and those that mimic
/// another. A revolute, continuous or prismatic joint has one number (rad or m). A planar joint has three,
/// named
/// `<joint>/x`, `/y` (m) and `/theta` (rad), in the plane across its axis. A floating joint has seven:
/// `<joint>/trans_x`, `_y`, `_z` (m) and `<joint>/rot_x`, `_y`, `_z`, `_w`, a quaternion that is made a unit
/// one; its velocities are the six `<joint>/trans_x` to `/rot_z`, of its child's origin and angular, in the
/// axes of the joint's frame. All others have as many velocities as positions, of the same names.
class RobotKinematics {
 public:
  /// @param urdf its text @param where names it in errors @param prefix of all names of links and joints, as
  ///        a scene file gives it to the robot
  /// @throws Error when urdfdom cannot parse the text, and for a joint without an axis or one that mimics
  ///         itself, a joint that is not there, or one of another kind than one number can follow
  explicit RobotKinematics(const std::string& urdf, const std::string& where = "URDF",
                           const std::string& prefix = "");
  /// For concave_distance_loading, which has read the text already.
  RobotKinematics(const detail::RobotStructure& structure, const std::string& where,
                  const std::string& prefix);
  ~RobotKinematics();
  RobotKinematics(RobotKinematics&&) noexcept;
  RobotKinematics& operator=(RobotKinematics&&) noexcept;

  /// The robot's name in its URDF, with the prefix before it.
  const std::string& name() const;
  /// Names of the links, which are their tf frames, parents before children: the first is the root.
  const std::vector<std::string>& linkNames() const;
  std::optional<std::size_t> findLink(const std::string& name) const;
  /// The link above a link other than the root.
  std::size_t parentOf(std::size_t link) const;
  /// Returns whether a joint moves the link against the root.
  bool isMoved(std::size_t link) const;

  /// Names of all joints, fixed ones too, parents before children.
  const std::vector<std::string>& jointNames() const;
  const std::vector<std::string>& positionNames() const;
  const std::vector<std::string>& velocityNames() const;
  /// Every number at zero, or in the middle of its range if zero is outside.
  Eigen::VectorXd restPositions() const;
  /// The ranges that the URDF gives; infinite where it gives none.
  Eigen::VectorXd lowestPositions() const;
  Eigen::VectorXd highestPositions() const;
  /// Returns whether the position of a joint is an angle, of revolute, continuous and planar ones.
  bool isAngle(std::size_t position) const;
  /// Puts named numbers, as of a sensor_msgs/JointState, in the order of positionNames(). Those of joints
  /// that mimic another may be among them.
  /// @throws Error for a name that is unknown, given twice or of a fixed joint, for one that is missing, for
  ///         another number of names than values, a value that is not finite, and a joint that mimics another
  ///         and is more than 1e-6 from where it must be
  Eigen::VectorXd positionsOf(const std::vector<std::string>& names, const std::vector<double>& values) const;

  /// A state of the right size, at restPositions() with the root at the origin.
  RobotState restState() const;
  /// Computes where all links are. O(links); allocates nothing.
  /// @param state of restState() or an earlier evaluate()
  /// @throws Error for another number of positions, one that is not finite and a quaternion of zeros
  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& positions, const Eigen::Isometry3d& world_from_root,
                RobotState& state) const;

  /// Returns whether takeLinks() reads the link's pose: the root and what a joint moves against its parent.
  bool isTaken(std::size_t link) const;
  /// Computes a state from poses that are known without positions, as of tf.
  /// @param state with world_from_link set where isTaken(); the other links follow from them
  void takeLinks(RobotState& state) const;

  /// Adds factor * direction^T J to a row, where J is the Jacobian of a point of a link by velocities:
  /// O(joints above the link); allocates nothing.
  /// @param point metres, where the point of the link is in the world
  /// @param row velocityNames().size() numbers
  void addToRow(const RobotState& state, std::size_t link, const Eigen::Vector3d& point,
                const Eigen::Vector3d& direction, double factor,
                Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> row) const;
  /// The Jacobian of a point of a link, a column for each velocity: m/s for a rad/s or m/s. Allocates
  /// nothing.
  /// @param point as in addToRow()
  void jacobian(const RobotState& state, std::size_t link, const Eigen::Vector3d& point,
                Eigen::Ref<Eigen::Matrix3Xd> columns) const;

  /// For concave_distance_loading.
  const detail::RobotTree& tree() const { return *tree_; }

 private:
  std::unique_ptr<const detail::RobotTree> tree_;
};

}  // namespace concave_distance
