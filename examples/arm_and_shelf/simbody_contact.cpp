#include "simbody_contact.h"

using namespace concave_distance;

namespace {

Eigen::Vector3d toEigen(const SimTK::Vec3& v) {
  return {v[0], v[1], v[2]};
}
SimTK::Vec3 toSimbody(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Eigen::Isometry3d toEigen(const SimTK::Transform& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) result.linear()(row, column) = pose.R()[row][column];
  }
  result.translation() = toEigen(pose.p());
  return result;
}

/// Of a body against the world, at the world's origin, in its axes.
RelativeTwist twistOf(const SimTK::MobilizedBody& body, const SimTK::State& state) {
  const Eigen::Vector3d angular = toEigen(body.getBodyAngularVelocity(state));
  const Eigen::Vector3d at_frame = toEigen(body.getBodyOriginVelocity(state));
  return {at_frame - angular.cross(toEigen(body.getBodyOriginLocation(state))), angular};
}

}  // namespace

void SimbodyContact::add(const ContactBody& a, const ContactBody& b, const EffectSettings& settings,
                         const Material& material) {
  TrackerParameters parameters;
  parameters.niches_wanted = false;  // the proof that the bodies are apart is all that is needed
  const std::string name = a.mesh->name() + "/" + b.mesh->name();
  pairs_.push_back(
      std::make_unique<Pair>(Pair{a,
                                  b,
                                  PairTracker(name, a.mesh, b.mesh, parameters),
                                  PairEffects(a.mesh, b.mesh, settings, inContact(material, material)),
                                  {},
                                  {}}));
}

void SimbodyContact::evaluate(const SimTK::State& state, Pair& pair) const {
  const Eigen::Isometry3d world_from_a = toEigen(pair.a.body.getBodyTransform(state));
  const Eigen::Isometry3d world_from_b = toEigen(pair.b.body.getBodyTransform(state));
  const RelativeTwist a = twistOf(pair.a.body, state);
  const RelativeTwist b = twistOf(pair.b.body, state);
  const RelativeTwist b_in_world{b.linear - a.linear, b.angular - a.angular};
  const Eigen::Matrix3d into_a = world_from_a.linear().transpose();
  const RelativeTwist b_in_a{into_a * b_in_world.at(world_from_a.translation()), into_a * b_in_world.angular};
  pair.tracker.update(world_from_a.inverse(Eigen::Isometry) * world_from_b, state.getTime(), pair.solution);
  pair.effects.goBack();
  pair.effects.update(pair.solution, b_in_a, state.getTime() - accepted_time_, pair.contacts);
}

void SimbodyContact::calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                               SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector&) const {
  for (const std::unique_ptr<Pair>& pair : pairs_) {
    evaluate(state, *pair);
    // On B about A's origin, in A's axes; the engine wants each about its body's origin, in the world's.
    const SimTK::Transform& world_from_a = pair->a.body.getBodyTransform(state);
    const Wrench& wrench = pair->contacts.on_b_in_a;
    const SimTK::Vec3 force = world_from_a.R() * toSimbody(wrench.force);
    const SimTK::Vec3 torque = world_from_a.R() * toSimbody(wrench.torque);
    const SimTK::Vec3 a_to_b = pair->b.body.getBodyOriginLocation(state) - world_from_a.p();
    pair->b.body.applyBodyForce(state, SimTK::SpatialVec(torque - a_to_b % force, force), body_forces);
    pair->a.body.applyBodyForce(state, SimTK::SpatialVec(-torque, -force), body_forces);
  }
}

void SimbodyContact::accept(const SimTK::State& state) {
  for (const std::unique_ptr<Pair>& pair : pairs_) {
    evaluate(state, *pair);
    pair->effects.keep();
  }
  accepted_time_ = state.getTime();
}
