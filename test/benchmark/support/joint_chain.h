#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace concave_distance::benchmark {

/// The revolute joints of an arm in a row, read with urdfdom alone: kinematics that share nothing with the
/// library's.
class JointChain {
 public:
  /// @throws Error for a URDF that is not an unbranched chain of fixed and revolute joints
  explicit JointChain(const std::string& urdf);

  struct Link {
    std::string name;
    int joint = -1;  ///< that moves it against the link before; -1: none
    Eigen::Isometry3d last_from_link = Eigen::Isometry3d::Identity();  ///< at joint position 0
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();                   ///< unit vector, link frame
    int last_joint = -1;  ///< the last that moves it against the root; -1: none
  };
  const std::vector<Link>& links() const { return links_; }
  int findLink(const std::string& name) const;  ///< -1: no such link
  int jointCount() const { return static_cast<int>(names_.size()); }
  const std::vector<std::string>& jointNames() const { return names_; }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }

  /// Computes where all links are, the root at the origin.
  void place(const Eigen::VectorXd& positions, std::vector<Eigen::Isometry3d>& world_from_link) const;
  /// Returns the link that a joint moves; its axis passes through that link's origin.
  std::size_t linkOf(int joint) const { return link_of_joint_[static_cast<std::size_t>(joint)]; }

 private:
  std::vector<Link> links_;
  std::vector<std::string> names_;
  std::vector<std::size_t> link_of_joint_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
};

}  // namespace concave_distance::benchmark
