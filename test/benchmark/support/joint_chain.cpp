#include "benchmark/support/joint_chain.h"

#include <urdf_parser/urdf_parser.h>

#include "concave_distance/base/error.h"

namespace concave_distance::benchmark {
namespace {

Eigen::Isometry3d poseFromUrdf(const urdf::Pose& pose) {
  Eigen::Quaterniond turn;
  pose.rotation.getQuaternion(turn.x(), turn.y(), turn.z(), turn.w());
  return Eigen::Translation3d(pose.position.x, pose.position.y, pose.position.z) * turn.normalized();
}

}  // namespace

JointChain::JointChain(const std::string& urdf) {
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(urdf);
  if (!model) throw Error("URDF", "it cannot be read", "name one that check_urdf accepts");
  std::vector<double> lower;
  std::vector<double> upper;
  for (urdf::LinkConstSharedPtr link = model->getRoot(); link;) {
    Link read;
    read.name = link->name;
    if (const auto joint = link->parent_joint) {
      read.last_from_link = poseFromUrdf(joint->parent_to_joint_origin_transform);
      if (joint->type == urdf::Joint::REVOLUTE) {
        read.joint = static_cast<int>(names_.size());
        read.axis = Eigen::Vector3d(joint->axis.x, joint->axis.y, joint->axis.z).normalized();
        names_.push_back(joint->name);
        link_of_joint_.push_back(links_.size());
        lower.push_back(joint->limits->lower);
        upper.push_back(joint->limits->upper);
      } else if (joint->type != urdf::Joint::FIXED) {
        throw Error(joint->name, "it is neither fixed nor revolute", "use an arm of such joints");
      }
    }
    read.last_joint = static_cast<int>(names_.size()) - 1;
    links_.push_back(read);
    if (link->child_links.size() > 1)
      throw Error(link->name, "the arm branches here", "use one that does not");
    link = link->child_links.empty() ? nullptr : urdf::LinkConstSharedPtr(link->child_links.front());
  }
  lower_ = Eigen::Map<Eigen::VectorXd>(lower.data(), static_cast<Eigen::Index>(lower.size()));
  upper_ = Eigen::Map<Eigen::VectorXd>(upper.data(), static_cast<Eigen::Index>(upper.size()));
}

int JointChain::findLink(const std::string& name) const {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

void JointChain::place(const Eigen::VectorXd& positions,
                       std::vector<Eigen::Isometry3d>& world_from_link) const {
  world_from_link.resize(links_.size());
  Eigen::Isometry3d last = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    last = last * links_[i].last_from_link;
    if (links_[i].joint >= 0) last.rotate(Eigen::AngleAxisd(positions[links_[i].joint], links_[i].axis));
    world_from_link[i] = last;
  }
}

}  // namespace concave_distance::benchmark
