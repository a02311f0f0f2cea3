#include "contact_point.h"

namespace concave_distance {

void setRelativeMotion(const RelativeTwist& b_in_a, ContactPoint& contact) {
  const Eigen::Vector3d velocity = b_in_a.at(contact.point_in_a);
  const double parting = velocity.dot(contact.normal_in_a);
  contact.geometry.depth_rate = -parting;
  contact.sliding_in_a = velocity - parting * contact.normal_in_a;
}

}  // namespace concave_distance
