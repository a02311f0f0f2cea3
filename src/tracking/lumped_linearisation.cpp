#include "lumped_linearisation.h"

#include <cmath>

#include "contact/friction_linearisation.h"

namespace concave_distance {
namespace {

// Second moment over area of a square is reach^2 / 6 with the reach to its corners, of a disc reach^2 / 4, of
// a narrow strip reach^2 / 3 about its short axis. Too stiff is stable, too soft is not.
constexpr double kSquaredSpread = 2.0 / 3.0;

}  // namespace

void addLumpedContact(const EffectSettings& settings, const ContactMaterial& material,
                      const ContactRegion& region, const RecentSliding& recent,
                      ContactLinearisation& linearisation) {
  const Eigen::Vector3d& normal = region.overlap.normal_in_a;
  const NormalForce force = normalForce(*settings.normal_force, material,
                                        {region.overlap.depth_along_normal, region.depth_rate,
                                         region.overlap.contact_area, region.overlap.volume});
  const FrictionTangent friction =
      frictionTangent(settings.friction, material, region.normal_force, normal, region.sliding_in_a, recent);
  const double spread = std::sqrt(kSquaredSpread) * region.overlap.reach;
  for (const Eigen::Vector3d& side : {friction.along, friction.across}) {
    for (const double sign : {-spread, spread}) {
      const Eigen::Vector3d point = region.point_in_a + sign * side;
      addDirection(0.25 * force.stiffness, normal, point, linearisation.stiffness);
    }
  }
  const Eigen::Vector3d& point = region.point_in_a;
  addDirection(force.damping, normal, point, linearisation.damping);
  addFriction(friction, point, linearisation);
}

}  // namespace concave_distance
