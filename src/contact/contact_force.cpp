#include "concave_distance/contact/contact_force.h"

namespace concave_distance {

void setRelativeMotion(const RelativeTwist& b_in_a, ContactPoint& contact) {
  const Eigen::Vector3d velocity = b_in_a.at(contact.point_in_a);
  const double parting = velocity.dot(contact.normal_in_a);
  contact.geometry.depth_rate = -parting;
  contact.sliding_in_a = velocity - parting * contact.normal_in_a;
}

ContactForce contactForce(const NormalForceSettings& normal, const FrictionSettings& friction,
                          const ContactMaterial& material, const ContactPoint& contact, double step,
                          BristleState& state) {
  ContactForce force;
  force.normal = normalForce(normal, material, contact.geometry);
  switch (friction.model) {
    case FrictionModel::None:
      break;
    case FrictionModel::RegularisedCoulomb:
      force.friction_in_a = regularisedCoulombForce(friction, material, force.normal, contact.sliding_in_a);
      break;
    case FrictionModel::Bristle:
      force.friction_in_a = bristleForce(friction, material, force.normal, contact.normal_in_a,
                                         contact.sliding_in_a, step, state);
      break;
  }
  return force;
}

}  // namespace concave_distance
