#include <Simbody.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "benchmark/engines/engine_table.h"
#include "mesh/surface/refine_mesh.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kAccuracy = 1e-5;  // of the integrator, relative
constexpr double kLowAccuracy = 1e-3;
constexpr double kTransitionSpeed = 1e-3;  // of the friction, m/s

SimTK::Vec3 vectorOf(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}
Eigen::Vector3d vectorOf(const SimTK::Vec3& vector) {
  return {vector[0], vector[1], vector[2]};
}

SimTK::ContactGeometry::TriangleMesh springsOf(const SurfaceMesh& surface, double spacing) {
  const SurfaceMesh mesh = refineToEdgeLength(surface, spacing).mesh;
  SimTK::Array_<SimTK::Vec3> vertices;
  SimTK::Array_<int> corners;
  for (const Eigen::Vector3d& vertex : mesh.vertices()) vertices.push_back(vectorOf(vertex));
  for (const TriangleNodes& triangle : mesh.triangles()) {
    for (const NodeIndex node : triangle) corners.push_back(static_cast<int>(node.value));
  }
  return {vertices, corners};
}

/// All bodies of a scene with the forces between them.
class SimbodyTable {
 public:
  explicit SimbodyTable(const TableScene& scene)
      : scene_(scene),
        matter_(system_),
        forces_(system_),
        contacts_(system_),
        gravity_(forces_, matter_, vectorOf(scene.stage.settings.gravity)),
        set_(contacts_.createContactSet()) {
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) addBody(i);
    if (scene.spring_spacing > 0.0) {
      addBeds();
    } else {
      addRoundContact();
    }
    state_ = system_.realizeTopology();
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) place(i);
  }

  const SimTK::MultibodySystem& system() const { return system_; }
  const SimTK::State& state() const { return state_; }

  void sample(const SimTK::State& state, double time, std::vector<Trajectory>& trajectories) const {
    system_.realize(state, SimTK::Stage::Velocity);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      EngineSample sample;
      sample.time = time;
      if (scene_.stage.settings.bodies[i].motion != BodyMotion::Fixed) {
        sample.centre = vectorOf(bodies_[i].getBodyOriginLocation(state));
        sample.velocity = vectorOf(bodies_[i].getBodyOriginVelocity(state));
        sample.angular_velocity = vectorOf(bodies_[i].getBodyAngularVelocity(state));
      }
      trajectories[i].push_back(sample);
    }
  }

 private:
  const SurfaceMesh& surfaceOf(std::size_t i) const { return scene_.stage.scene.bodies[i].mesh->surface(); }

  void addBody(std::size_t i) {
    const SimulatedBodySettings& settings = scene_.stage.settings.bodies[i];
    if (settings.motion == BodyMotion::Fixed) {
      bodies_.push_back(matter_.Ground());
      addShape(i, SimTK::Transform(vectorOf(Eigen::Vector3d(settings.pose.translation()))));
      return;
    }
    const MassProperties mass = settings.inertia
                                    ? *settings.inertia
                                    : massPropertiesOfMass(surfaceOf(i), *settings.mass, settings.body);
    const Eigen::Matrix3d& m = mass.inertia;
    const SimTK::Inertia inertia(m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2));
    const SimTK::Body::Rigid rigid(SimTK::MassProperties(mass.mass, SimTK::Vec3(0), inertia));
    bodies_.push_back(
        SimTK::MobilizedBody::Free(matter_.Ground(), SimTK::Transform(), rigid, SimTK::Transform()));
    addShape(i, SimTK::Transform());
    for (const AppliedLoad& load : settings.loads) {
      SimTK::Force::ConstantForce(forces_, bodies_[i], SimTK::Vec3(0), vectorOf(load.force));
    }
  }

  /// Free bodies have the springs, fixed ones only where a ball meets them.
  bool hasBed(std::size_t i) const {
    const auto isBall = [](TableShape shape) { return shape == TableShape::Sphere; };
    if (scene_.shapes[i] == TableShape::HalfSpace || isBall(scene_.shapes[i])) return false;
    return scene_.stage.settings.bodies[i].motion != BodyMotion::Fixed ||
           std::any_of(scene_.shapes.begin(), scene_.shapes.end(), isBall);
  }

  void addShape(std::size_t i, const SimTK::Transform& in_body) {
    if (scene_.shapes[i] == TableShape::HalfSpace) {
      // A half-space holds what lies in the direction of its x axis.
      contacts_.addBody(set_, bodies_[i], SimTK::ContactGeometry::HalfSpace(),
                        SimTK::Transform(SimTK::Rotation(0.5 * SimTK::Pi, SimTK::YAxis)));
    } else if (scene_.shapes[i] == TableShape::Sphere) {
      contacts_.addBody(set_, bodies_[i], SimTK::ContactGeometry::Sphere(scene_.radius), in_body);
    } else {
      const double spacing = hasBed(i) ? scene_.spring_spacing : surfaceOf(i).diameter();
      contacts_.addBody(set_, bodies_[i], springsOf(surfaceOf(i), spacing), in_body);
    }
  }

  void addBeds() {
    SimTK::ElasticFoundationForce force(forces_, contacts_, set_);
    force.setTransitionVelocity(kTransitionSpeed);
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
      if (!hasBed(i)) continue;
      // 1 + c v there, 1 + 3/2 c v here.
      force.setBodyParameters(SimTK::ContactSurfaceIndex(static_cast<int>(i)),
                              scene_.normal().foundation_stiffness, 1.5 * scene_.material().dissipation,
                              scene_.material().static_friction * (scene_.friction() > 0.0 ? 1.0 : 0.0),
                              scene_.friction(), 0.0);
    }
  }

  void addRoundContact() {
    SimTK::HuntCrossleyForce force(forces_, contacts_, set_);
    force.setTransitionVelocity(kTransitionSpeed);
    // Two bodies of the plane-strain modulus K make K / 2^(3/2) there and E* = K / 2 here.
    const double modulus = scene_.material().contact_modulus * std::pow(2.0, 1.5);
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
      force.setBodyParameters(SimTK::ContactSurfaceIndex(static_cast<int>(i)), modulus,
                              scene_.material().dissipation, scene_.friction(), scene_.friction(), 0.0);
    }
  }

  void place(std::size_t i) {
    const SimulatedBodySettings& settings = scene_.stage.settings.bodies[i];
    if (settings.motion == BodyMotion::Fixed) return;
    const SimTK::Transform pose(vectorOf(Eigen::Vector3d(settings.pose.translation())));
    bodies_[i].setQToFitTransform(state_, pose);
    bodies_[i].setUToFitVelocity(
        state_, SimTK::SpatialVec(vectorOf(settings.angular_velocity), vectorOf(settings.velocity)));
  }

  const TableScene& scene_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::GeneralContactSubsystem contacts_;
  SimTK::Force::UniformGravity gravity_;
  SimTK::ContactSetIndex set_;
  std::deque<SimTK::MobilizedBody> bodies_;
  SimTK::State state_;
};

TableRun runWith(SimTK::Integrator& integrator, const SimbodyTable& table, const TableScene& scene) {
  // Also in free flight it may not step over a contact.
  integrator.setMaximumStepSize(scene.stage.settings.largest_step);
  SimTK::TimeStepper stepper(table.system(), integrator);
  stepper.initialize(table.state());
  TableRun run;
  run.bodies.resize(scene.shapes.size());
  const auto samples = std::lround(scene.duration * kTableRate);
  const auto start = std::chrono::steady_clock::now();
  for (long i = 0; i <= samples && run.seconds < kTableWall; ++i) {
    const double time = static_cast<double>(i) / kTableRate;
    if (i > 0) stepper.stepTo(time);
    run.seconds = 1e-6 * microsecondsSince(start);
    table.sample(stepper.getState(), time, run.bodies);
    run.complete = i == samples;
  }
  return run;
}

TableRun runAccurately(const TableScene& scene) {
  const SimbodyTable table(scene);
  SimTK::RungeKuttaMersonIntegrator integrator(table.system());
  integrator.setAccuracy(kAccuracy);
  return runWith(integrator, table, scene);
}

/// What Simbody recommends for stiff contact and low accuracy.
TableRun runSemiExplicitly(const TableScene& scene) {
  const SimbodyTable table(scene);
  SimTK::SemiExplicitEuler2Integrator integrator(table.system());
  integrator.setAccuracy(kLowAccuracy);
  return runWith(integrator, table, scene);
}

}  // namespace

std::vector<TableEngine> simbodyEngines() {
  return {{"simbody", runAccurately}, {"simbody semi-explicit", runSemiExplicitly}};
}

}  // namespace concave_distance::benchmark
