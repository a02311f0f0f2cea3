#include <Simbody.h>

#include "engines.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kAccuracy = 1e-8;
constexpr double kTransitionVelocity = 1e-3;  // as `regularised_coulomb` has it by default

// A half-space is where its own x is positive: turned so that this is z < 0.
SimTK::Transform belowTheGround() {
  return SimTK::Transform(SimTK::Rotation(0.5 * SimTK::Pi, SimTK::YAxis), SimTK::Vec3(0));
}

Trajectory integrate(SimTK::MultibodySystem& system, const SimTK::MobilizedBody& body, int axis, double start,
                     double duration, double interval, const SimTK::State& initial) {
  SimTK::RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(kAccuracy);
  integrator.setMaximumStepSize(1e-3);
  SimTK::TimeStepper stepper(system, integrator);
  stepper.initialize(initial);
  Trajectory trajectory;
  for (int line = 0; line * interval <= duration + 1e-9; ++line) {
    if (line > 0) stepper.stepTo(line * interval);
    const SimTK::State& state = integrator.getState();
    system.realize(state, SimTK::Stage::Velocity);
    trajectory.push_back({line * interval, body.getBodyOriginLocation(state)[axis] - start,
                          body.getBodyOriginVelocity(state)[axis]});
  }
  return trajectory;
}

}  // namespace

Trajectory simbodyBall(const BallScene& scene) {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);
  SimTK::Force::UniformGravity gravity(forces, matter, SimTK::Vec3(0, 0, -9.81));
  SimTK::GeneralContactSubsystem contacts(system);
  const SimTK::ContactSetIndex set = contacts.createContactSet();
  contacts.addBody(set, matter.updGround(), SimTK::ContactGeometry::HalfSpace(), belowTheGround());
  const double inertia = 0.4 * scene.mass * scene.radius * scene.radius;
  SimTK::Body::Rigid sphere(SimTK::MassProperties(scene.mass, SimTK::Vec3(0), SimTK::Inertia(inertia)));
  SimTK::MobilizedBody::Free ball(matter.updGround(), SimTK::Transform(), sphere, SimTK::Transform());
  contacts.addBody(set, ball, SimTK::ContactGeometry::Sphere(scene.radius), SimTK::Transform());
  SimTK::HuntCrossleyForce contact(forces, contacts, set);
  // Simbody combines equal moduli E1 into (E1^(2/3) / 2)^(3/2).
  const double modulus = scene.contact_modulus * std::pow(2.0, 1.5);
  for (int surface = 0; surface < 2; ++surface) {
    contact.setBodyParameters(SimTK::ContactSurfaceIndex(surface), modulus, scene.dissipation, 0, 0, 0);
  }
  SimTK::State state = system.realizeTopology();
  ball.setQToFitTransform(state, SimTK::Transform(SimTK::Vec3(0, 0, scene.height)));
  return integrate(system, ball, 2, 0.0, scene.duration, scene.interval, state);
}

Trajectory simbodyBox(const BoxScene& scene) {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);
  SimTK::Force::UniformGravity gravity(forces, matter,
                                       SimTK::Vec3(scene.gravity.x(), scene.gravity.y(), scene.gravity.z()));
  SimTK::GeneralContactSubsystem contacts(system);
  const SimTK::ContactSetIndex set = contacts.createContactSet();
  contacts.addBody(set, matter.updGround(), SimTK::ContactGeometry::HalfSpace(), belowTheGround());
  const SimTK::Vec3 half(0.5 * scene.size.x(), 0.5 * scene.size.y(), 0.5 * scene.size.z());
  SimTK::Body::Rigid brick(
      SimTK::MassProperties(scene.mass, SimTK::Vec3(0), scene.mass * SimTK::UnitInertia::brick(half)));
  SimTK::MobilizedBody::Free box(matter.updGround(), SimTK::Transform(), brick, SimTK::Transform());
  contacts.addBody(set, box,
                   SimTK::ContactGeometry::TriangleMesh(SimTK::PolygonalMesh::createBrickMesh(half, 12)),
                   SimTK::Transform());
  SimTK::ElasticFoundationForce contact(forces, contacts, set);
  // Its damping is 1 + c d', ours 1 + 3/2 c d'.
  contact.setBodyParameters(SimTK::ContactSurfaceIndex(1), scene.foundation_stiffness,
                            1.5 * scene.dissipation, scene.friction, scene.friction, 0);
  contact.setTransitionVelocity(kTransitionVelocity);
  SimTK::State state = system.realizeTopology();
  box.setQToFitTransform(state, SimTK::Transform(SimTK::Vec3(0, 0, half[2])));
  return integrate(system, box, 0, 0.0, scene.duration, scene.interval, state);
}

}  // namespace concave_distance::benchmark
