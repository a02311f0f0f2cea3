#include "turning_friction.h"

#include "base/across_normal.h"
#include "friction_laws.h"

namespace concave_distance {
namespace {

// Nearly up to the limit nothing slips: a rounded mesh never lies quite still under pressures, and what slips
// then is not bent back.
constexpr double kBreakaway = 0.95;

ContactMaterial withCoefficient(double coefficient) {
  ContactMaterial material{};
  material.static_friction = material.dynamic_friction = coefficient;
  material.breakaway = kBreakaway;
  return material;
}

Eigen::Vector3d resistRolling(const FrictionSettings& settings, double rolling_friction,
                              const TurningContact& contact, const TurningMotion& motion,
                              BristleState& bristles, ContactLinearisation& linearisation) {
  const Eigen::Vector3d& normal = contact.normal_in_a;
  const ContactMaterial material = withCoefficient(rolling_friction / contact.arm);
  const Eigen::Vector3d sliding = contact.arm * acrossNormal(normal, motion.rate);
  const Eigen::Vector3d shift = contact.arm * acrossNormal(normal, motion.angle);
  const Eigen::Vector3d force =
      frictionForce(settings, material, contact.force, normal, sliding, shift, bristles);
  const FrictionTangent tangent =
      frictionTangent(settings, material, contact.force, normal, sliding, {shift, motion.step, bristles});
  addTorsionalFriction(tangent, contact.arm * contact.arm, linearisation);
  return contact.arm * force;
}

// One number each, so that the bristles need no turning with the normal: kept along x.
Eigen::Vector3d resistSpinning(const FrictionSettings& settings, double spinning_friction,
                               const TurningContact& contact, const TurningMotion& motion,
                               BristleState& bristles, ContactLinearisation& linearisation) {
  const Eigen::Vector3d& normal = contact.normal_in_a;
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ();
  const ContactMaterial material = withCoefficient(spinning_friction / contact.arm);
  const Eigen::Vector3d sliding(contact.arm * normal.dot(motion.rate), 0.0, 0.0);
  const Eigen::Vector3d shift(contact.arm * normal.dot(motion.angle), 0.0, 0.0);
  const Eigen::Vector3d force =
      frictionForce(settings, material, contact.force, across, sliding, shift, bristles);
  const FrictionTangent tangent =
      frictionTangent(settings, material, contact.force, across, sliding, {shift, motion.step, bristles});
  const double squared_arm = contact.arm * contact.arm;
  addAxis(squared_arm * tangent.stiffness_along, normal, linearisation.stiffness);
  addAxis(squared_arm * tangent.damping_along, normal, linearisation.damping);
  return contact.arm * force.x() * normal;
}

}  // namespace

Eigen::Vector3d resistTurning(const FrictionSettings& settings, const ContactMaterial& material,
                              const TurningContact& contact, const TurningMotion& motion,
                              TurningBristles& bristles, ContactLinearisation& linearisation) {
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  if (material.rolling_friction > 0.0) {
    torque +=
        resistRolling(settings, material.rolling_friction, contact, motion, bristles.rolling, linearisation);
  }
  if (material.spinning_friction > 0.0) {
    torque += resistSpinning(settings, material.spinning_friction, contact, motion, bristles.spinning,
                             linearisation);
  }
  return torque;
}

}  // namespace concave_distance
