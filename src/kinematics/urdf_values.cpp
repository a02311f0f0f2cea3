#include "urdf_values.h"

#include "frame_name.h"

namespace concave_distance::detail {
namespace {

JointType typeOf(const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return JointType::Revolute;
    case urdf::Joint::CONTINUOUS:
      return JointType::Continuous;
    case urdf::Joint::PRISMATIC:
      return JointType::Prismatic;
    case urdf::Joint::PLANAR:
      return JointType::Planar;
    case urdf::Joint::FLOATING:
      return JointType::Floating;
    default:  // urdfdom refuses a text with a type that it does not know
      return JointType::Fixed;
  }
}

}  // namespace

Eigen::Isometry3d toIsometry(const urdf::Pose& pose) {
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  const urdf::Rotation& r = pose.rotation;
  isometry.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
  isometry.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return isometry;
}

RobotJoint toJoint(const urdf::Joint& given) {
  RobotJoint joint;
  joint.name = given.name;
  joint.parent = withoutLeadingSlash(given.parent_link_name);
  joint.child = withoutLeadingSlash(given.child_link_name);
  joint.type = typeOf(given);
  joint.parent_from_joint = toIsometry(given.parent_to_joint_origin_transform);
  joint.axis = Eigen::Vector3d(given.axis.x, given.axis.y, given.axis.z);
  if (given.limits && given.type != urdf::Joint::CONTINUOUS && given.limits->lower <= given.limits->upper) {
    joint.has_limits = true;
    joint.lower = given.limits->lower;
    joint.upper = given.limits->upper;
  }
  if (given.mimic) {
    joint.mimicked = given.mimic->joint_name;
    joint.mimic_factor = given.mimic->multiplier;
    joint.mimic_offset = given.mimic->offset;
  }
  return joint;
}

}  // namespace concave_distance::detail
