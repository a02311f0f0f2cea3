#include "urdf_values.h"

#include "frame_name.h"

namespace concave_distance::detail {

Eigen::Isometry3d toIsometry(const urdf::Pose& pose) {
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  const urdf::Rotation& r = pose.rotation;
  isometry.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
  isometry.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return isometry;
}

std::optional<MassProperties> inertiaOf(const urdf::Link& link) {
  if (!link.inertial) return std::nullopt;
  const urdf::Inertial& given = *link.inertial;
  const Eigen::Isometry3d link_from_inertial = toIsometry(given.origin);
  MassProperties inertia;
  inertia.mass = given.mass;
  inertia.centre_in_body = link_from_inertial.translation();
  inertia.inertia << given.ixx, given.ixy, given.ixz, given.ixy, given.iyy, given.iyz, given.ixz, given.iyz,
      given.izz;
  inertia.inertia = link_from_inertial.linear() * inertia.inertia * link_from_inertial.linear().transpose();
  return inertia;
}

RobotJoint toJoint(const urdf::Joint& given) {
  RobotJoint joint;
  joint.name = given.name;
  joint.parent = withoutLeadingSlash(given.parent_link_name);
  joint.child = withoutLeadingSlash(given.child_link_name);
  joint.fixed = given.type == urdf::Joint::FIXED;
  joint.floating = given.type == urdf::Joint::FLOATING;
  joint.parent_from_joint = toIsometry(given.parent_to_joint_origin_transform);
  const bool turns = given.type == urdf::Joint::REVOLUTE || given.type == urdf::Joint::CONTINUOUS;
  const Eigen::Vector3d axis(given.axis.x, given.axis.y, given.axis.z);
  if ((turns || given.type == urdf::Joint::PRISMATIC) && axis.norm() > 0.0) {
    joint.motion = turns ? JointMotion::Turns : JointMotion::Slides;
    joint.axis = axis.normalized();
  }
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
