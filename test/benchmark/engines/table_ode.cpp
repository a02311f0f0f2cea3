#include <ode/ode.h>

#include <cstdint>
#include <memory>

#include "benchmark/engines/engine_table.h"

namespace concave_distance::benchmark {
namespace {

constexpr int kMostContacts = 64;
// Without some softness (m/s a newton second) the solver fails on flat faces' four corners.
constexpr double kConstraintForceMixing = 1e-8;
constexpr double kBounceThreshold = 0.01;  // m/s: slower impacts do not bounce

/// Vertices and corners as ODE keeps them.
struct OdeMesh {
  std::vector<double> vertices;
  std::vector<std::uint32_t> corners;
  dTriMeshDataID data = nullptr;
};

/// A world with all bodies of a scene; frees what it made.
class OdeTable {
 public:
  explicit OdeTable(const TableScene& scene) : scene_(scene) {
    dInitODE2(0);
    world_ = dWorldCreate();
    const Eigen::Vector3d& gravity = scene.stage.settings.gravity;
    dWorldSetGravity(world_, gravity.x(), gravity.y(), gravity.z());
    dWorldSetCFM(world_, kConstraintForceMixing);
    contacts_ = dJointGroupCreate(0);
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) addBody(i);
  }
  ~OdeTable() {
    for (const dGeomID shape : shapes_) dGeomDestroy(shape);
    for (const auto& mesh : meshes_) dGeomTriMeshDataDestroy(mesh->data);
    dJointGroupDestroy(contacts_);
    dWorldDestroy(world_);
    dCloseODE();
  }
  OdeTable(const OdeTable&) = delete;
  OdeTable& operator=(const OdeTable&) = delete;

  void step(double seconds) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) push(i);
    for (std::size_t i = 0; i < scene_.stage.scene.pairs.size(); ++i) {
      const ScenePair& pair = scene_.stage.scene.pairs[i];
      collide(pair.body_a, pair.body_b);
    }
    dWorldStep(world_, seconds);
    dJointGroupEmpty(contacts_);
  }

  void sample(double time, std::vector<Trajectory>& trajectories) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      EngineSample sample;
      sample.time = time;
      if (bodies_[i] != nullptr) {
        sample.centre = Eigen::Map<const Eigen::Vector3d>(dBodyGetPosition(bodies_[i]));
        sample.velocity = Eigen::Map<const Eigen::Vector3d>(dBodyGetLinearVel(bodies_[i]));
        sample.angular_velocity = Eigen::Map<const Eigen::Vector3d>(dBodyGetAngularVel(bodies_[i]));
      }
      trajectories[i].push_back(sample);
    }
  }

 private:
  const SimulatedBodySettings& settingsOf(std::size_t i) const { return scene_.stage.settings.bodies[i]; }
  const SurfaceMesh& surfaceOf(std::size_t i) const { return scene_.stage.scene.bodies[i].mesh->surface(); }

  void addBody(std::size_t i) {
    const SimulatedBodySettings& settings = settingsOf(i);
    const dGeomID shape = makeShape(i);
    shapes_.push_back(shape);
    bodies_.push_back(nullptr);
    const Eigen::Vector3d place = settings.pose.translation();
    if (settings.motion == BodyMotion::Fixed) {
      if (scene_.shapes[i] != TableShape::HalfSpace) dGeomSetPosition(shape, place.x(), place.y(), place.z());
      return;
    }
    const MassProperties mass = settings.inertia
                                    ? *settings.inertia
                                    : massPropertiesOfMass(surfaceOf(i), *settings.mass, settings.body);
    const Eigen::Matrix3d& m = mass.inertia;
    dMass given;
    dMassSetParameters(&given, mass.mass, 0.0, 0.0, 0.0, m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2),
                       m(1, 2));
    const dBodyID body = bodies_.back() = dBodyCreate(world_);
    dBodySetMass(body, &given);
    dBodySetPosition(body, place.x(), place.y(), place.z());
    dBodySetLinearVel(body, settings.velocity.x(), settings.velocity.y(), settings.velocity.z());
    const Eigen::Vector3d& turning = settings.angular_velocity;
    dBodySetAngularVel(body, turning.x(), turning.y(), turning.z());
    dGeomSetBody(shape, body);
  }

  dGeomID makeShape(std::size_t i) {
    const Eigen::Vector3d size = surfaceOf(i).boundingBox().sizes();
    switch (scene_.shapes[i]) {
      case TableShape::HalfSpace:
        return dCreatePlane(nullptr, 0.0, 0.0, 1.0, 0.0);
      case TableShape::Box:
        return dCreateBox(nullptr, size.x(), size.y(), size.z());
      case TableShape::Sphere:
        return dCreateSphere(nullptr, scene_.radius);
      case TableShape::Cylinder:
        return dCreateCylinder(nullptr, scene_.radius, size.z());
      case TableShape::Mesh:
        break;
    }
    return makeMesh(surfaceOf(i));
  }

  dGeomID makeMesh(const SurfaceMesh& surface) {
    meshes_.push_back(std::make_unique<OdeMesh>());
    OdeMesh& mesh = *meshes_.back();
    for (const Eigen::Vector3d& vertex : surface.vertices()) {
      mesh.vertices.insert(mesh.vertices.end(), {vertex.x(), vertex.y(), vertex.z()});
    }
    for (const TriangleNodes& triangle : surface.triangles()) {
      for (const NodeIndex node : triangle) mesh.corners.push_back(static_cast<std::uint32_t>(node.value));
    }
    mesh.data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(mesh.data, mesh.vertices.data(), 3 * sizeof(double),
                                static_cast<int>(surface.vertexCount()), mesh.corners.data(),
                                static_cast<int>(mesh.corners.size()), 3 * sizeof(std::uint32_t));
    return dCreateTriMesh(nullptr, mesh.data, nullptr, nullptr, nullptr);
  }

  void push(std::size_t i) {
    for (const AppliedLoad& load : settingsOf(i).loads) {
      dBodyAddForce(bodies_[i], load.force.x(), load.force.y(), load.force.z());
    }
  }

  void collide(std::size_t a, std::size_t b) {
    dContactGeom found[kMostContacts];
    const int count = dCollide(shapes_[a], shapes_[b], kMostContacts, found, sizeof(dContactGeom));
    for (int i = 0; i < count; ++i) {
      dContact contact = {};
      contact.surface.mode = dContactBounce | dContactApprox1;
      contact.surface.mu = scene_.friction();
      contact.surface.bounce = scene_.restitution;
      contact.surface.bounce_vel = kBounceThreshold;
      contact.geom = found[i];
      dJointAttach(dJointCreateContact(world_, contacts_, &contact), bodies_[a], bodies_[b]);
    }
  }

  const TableScene& scene_;
  dWorldID world_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  std::vector<dGeomID> shapes_;
  std::vector<dBodyID> bodies_;  ///< nullptr: fixed
  std::vector<std::unique_ptr<OdeMesh>> meshes_;
};

}  // namespace

std::vector<TableEngine> odeEngines() {
  return atBothSteps<OdeTable>("ode");
}

}  // namespace concave_distance::benchmark
