#include <Simbody.h>

#include <cmath>

#include "benchmark/engines/engine_differences.h"
#include "mesh/surface/refine_mesh.h"

namespace concave_distance::benchmark {
namespace {

SimTK::Vec3 vectorOf(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}
Eigen::Vector3d vectorOf(const SimTK::Vec3& vector) {
  return {vector[0], vector[1], vector[2]};
}

SimTK::MassProperties massOf(const MassProperties& mass) {
  const Eigen::Matrix3d& m = mass.inertia;
  const SimTK::Inertia about_centre(m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2));
  const SimTK::Vec3 centre = vectorOf(mass.centre_in_body);
  return {mass.mass, centre, about_centre.shiftFromMassCenter(centre, mass.mass)};
}

SimTK::ContactGeometry::TriangleMesh springsOf(const ComparedScene& scene) {
  const SurfaceMesh mesh = refineToEdgeLength(scene.surface(), scene.spring_spacing).mesh;
  SimTK::Array_<SimTK::Vec3> vertices;
  SimTK::Array_<int> corners;
  for (const Eigen::Vector3d& vertex : mesh.vertices()) vertices.push_back(vectorOf(vertex));
  for (const TriangleNodes& triangle : mesh.triangles()) {
    for (const NodeIndex node : triangle) corners.push_back(static_cast<int>(node.value));
  }
  return {vertices, corners};
}

void addForces(const ComparedScene& scene, const SimbodyOptions& options,
               SimTK::GeneralForceSubsystem& forces, SimTK::GeneralContactSubsystem& contacts,
               const SimTK::MobilizedBody& ground, const SimTK::MobilizedBody& body) {
  const SimTK::ContactSetIndex set = contacts.createContactSet();
  // A half space is what lies in the direction of its x axis.
  contacts.addBody(set, ground, SimTK::ContactGeometry::HalfSpace(),
                   SimTK::Transform(SimTK::Rotation(0.5 * SimTK::Pi, SimTK::YAxis)));
  const double friction = scene.friction;
  const SimTK::ContactSurfaceIndex on_ground(0);
  const SimTK::ContactSurfaceIndex on_body(1);
  if (scene.shape == ComparedShape::Sphere) {
    contacts.addBody(set, body, SimTK::ContactGeometry::Sphere(scene.radius), SimTK::Transform());
    // Two bodies of the plane-strain modulus K make K / 2^(3/2) there, (s K^(2/3))^(3/2) with s = 1/2, and E*
    // = K / 2 here.
    const double modulus = scene.material.contact_modulus * (options.convert ? std::pow(2.0, 1.5) : 2.0);
    SimTK::HuntCrossleyForce force(forces, contacts, set);
    for (const SimTK::ContactSurfaceIndex surface : {on_ground, on_body}) {
      force.setBodyParameters(surface, modulus, scene.material.dissipation, friction, friction, 0.0);
    }
    force.setTransitionVelocity(options.transition_speed);
    return;
  }
  contacts.addBody(set, body, springsOf(scene), SimTK::Transform());
  // 1 + c v there, 1 + 3/2 c v here.
  const double dissipation = scene.material.dissipation * (options.convert ? 1.5 : 1.0);
  SimTK::ElasticFoundationForce force(forces, contacts, set);
  force.setBodyParameters(on_body, scene.foundation_stiffness, dissipation, friction, friction, 0.0);
  force.setTransitionVelocity(options.transition_speed);
}

EngineSample sampleOf(const SimTK::MobilizedBody& body, const SimTK::State& state, double time) {
  EngineSample sample;
  sample.time = time;
  const SimTK::Vec3& centre = body.getBodyMassCenterStation(state);
  sample.centre = vectorOf(body.findStationLocationInGround(state, centre));
  sample.velocity = vectorOf(body.findStationVelocityInGround(state, centre));
  sample.angular_velocity = vectorOf(body.getBodyAngularVelocity(state));
  const SimTK::Rotation& rotation = body.getBodyRotation(state);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) sample.world_from_body(i, j) = rotation[i][j];
  }
  return sample;
}

}  // namespace

Trajectory runSimbody(const ComparedScene& scene, double rate, const SimbodyOptions& options) {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);
  SimTK::GeneralContactSubsystem contacts(system);
  const SimTK::Force::UniformGravity gravity(forces, matter, vectorOf(scene.settings().gravity));
  const SimTK::Body::Rigid rigid(massOf(scene.mass));
  SimTK::MobilizedBody::Free body(matter.Ground(), SimTK::Transform(), rigid, SimTK::Transform());
  addForces(scene, options, forces, contacts, matter.Ground(), body);
  SimTK::State state = system.realizeTopology();
  const Eigen::Matrix3d turn = scene.pose.linear();
  SimTK::Mat33 rotation;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation(i, j) = turn(i, j);
  }
  body.setQToFitTransform(state, SimTK::Transform(SimTK::Rotation(rotation),
                                                  vectorOf(Eigen::Vector3d(scene.pose.translation()))));
  SimTK::RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(options.accuracy);
  // Also in free flight it may not step over a contact.
  integrator.setMaximumStepSize(scene.settings().largest_step);
  SimTK::TimeStepper stepper(system, integrator);
  stepper.initialize(state);
  Trajectory trajectory;
  for (std::size_t i = 0; i < sampleCount(scene, rate); ++i) {
    const double time = static_cast<double>(i) / rate;
    if (i > 0) stepper.stepTo(time);
    system.realize(stepper.getState(), SimTK::Stage::Velocity);
    trajectory.push_back(sampleOf(body, stepper.getState(), time));
  }
  return trajectory;
}

}  // namespace concave_distance::benchmark
