#include "site_friction.h"

#include "friction_laws.h"

namespace concave_distance {
namespace {

/// Coordinates of one site: two directions across the normal, and spinning about it as metres at the spread.
class SiteAxes {
 public:
  explicit SiteAxes(const FrictionSite& site) : site_(site) {
    axes_.row(0) = site.push_in_a.unitOrthogonal();
    axes_.row(1) = site.push_in_a.cross(axes_.row(0).transpose());
    axes_.row(2).setZero();
  }
  Eigen::Vector3d across(const Eigen::Vector3d& in_a, double spun) const {
    return axes_ * in_a + spun * Eigen::Vector3d::UnitZ();
  }
  Eigen::Vector3d of(const RelativeTwist& twist) const {
    return across(twist.at(site_.point_in_a), site_.spread * twist.angular.dot(site_.push_in_a));
  }
  Eigen::Vector3d inPlane(const Eigen::Vector3d& local) const { return axes_.transpose() * local; }
  /// The wrench about A's origin of a force along `local`.
  Vector6d row(const Eigen::Vector3d& local) const {
    Vector6d row = wrenchRow(inPlane(local), site_.point_in_a);
    row.tail<3>() += local.z() * site_.spread * site_.push_in_a;
    return row;
  }

 private:
  const FrictionSite& site_;
  Eigen::Matrix3d axes_;
};

void addRow(double coefficient, const Vector6d& row, Matrix6d& sum) {
  if (!(coefficient > 0.0)) return;
  const Vector6d scaled = coefficient * row;
  sum.noalias() += row * scaled.transpose();
}

}  // namespace

Wrench siteFriction(const FrictionSettings& settings, const ContactMaterial& material,
                    const FrictionSite& site, const PatchMotion& motion, SiteBristles& state,
                    ContactLinearisation& linearisation) {
  const SiteAxes axes(site);
  const Eigen::Vector3d sliding = axes.of(motion.b_in_a);
  const Eigen::Vector3d shift = axes.of(motion.displacement);
  BristleState local;
  local.deflection = axes.across(turnedInto(site.push_in_a, state.bristles.deflection), state.spun);
  const Vector6d wrench = axes.row(frictionAlong(settings, material, site.force, sliding, shift, local));
  state.bristles.deflection = axes.inPlane(local.deflection);
  state.spun = local.deflection.z();

  const FrictionTangent slopes =
      frictionSlopes(settings, material, site.force, sliding, {shift, motion.step, local});
  const double speed = sliding.norm();
  const Eigen::Vector3d along = speed > 0.0 ? Eigen::Vector3d(sliding / speed) : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d across = along.unitOrthogonal();
  const Vector6d row = axes.row(along);
  addRow(slopes.stiffness_along, row, linearisation.stiffness);
  addRow(slopes.damping_along, row, linearisation.damping);
  for (const Eigen::Vector3d& direction : {across, Eigen::Vector3d(along.cross(across))}) {
    const Vector6d row_across = axes.row(direction);
    addRow(slopes.stiffness_across, row_across, linearisation.stiffness);
    addRow(slopes.damping_across, row_across, linearisation.damping);
  }
  return {wrench.head<3>(), wrench.tail<3>()};
}

}  // namespace concave_distance
